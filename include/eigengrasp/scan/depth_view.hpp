// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <vector>

#include "eigengrasp/core/pose.hpp"

namespace eigengrasp {

/// What one view says of space: in front of the surface that it sees, and beside its outline, there is
/// nothing; behind the surface it does not know. A picture of depths, made again from the cloud: pixels of
/// one and a half spacings of its points, gaps of up to 4 pixels closed. Immutable, any number of threads.
class DepthView {
 public:
  /// @param points of one view [m]; @param viewpoint of the sensor, in their frame [m]
  /// @param spacing of the points [m] @pre at least one point, all finite and none nearer than a spacing to
  /// the viewpoint, spacing > 0. Cost: about 10 ms.
  DepthView(const std::vector<Vec3>& points, const Vec3& viewpoint, double spacing);

  const Vec3& viewpoint() const { return viewpoint_; }
  /// Unit, from the viewpoint into the scene.
  Vec3 direction() const { return R_.row(2); }

  /// About the distance [m] of p from the largest solid that the view allows: positive where p is seen to be
  /// free, negative within the surface seen and its shadow. Continuous. Cost: 30 ns.
  double outside(const Vec3& p) const;

  /// About the distance [m] of p behind the surface seen, along the surface's normal; negative in front.
  double behind(const Vec3& p) const;

  /// Of p along direction() [m].
  double depth(const Vec3& p) const { return R_.row(2).dot(p - viewpoint_); }
  double nearest_depth() const { return nearest_depth_; }
  double deepest_depth() const { return deepest_depth_; }
  /// Root of the area of the outline at the depth of its middle [m].
  double width() const { return width_; }

 private:
  struct Pixel {
    float depth = 0.0F;   ///< of the surface, beside the outline of its nearest pixel [m]
    float edge = 0.0F;    ///< signed distance from the outline, negative inside [pixels]
    float cosine = 1.0F;  ///< between the ray and the surface's normal
  };
  struct Sample {
    double depth, edge, cosine, beyond;
  };

  void place_points(const std::vector<Vec3>& points, double spacing);
  void close_gaps(std::vector<char>& seen);
  void measure_edges(const std::vector<char>& seen);
  void measure_slopes();
  void smooth(float Pixel::*field);  ///< mean of each pixel and its eight neighbours
  Sample sample(double u, double v) const;
  Pixel& at(int x, int y) { return pixels_[static_cast<std::size_t>(y * columns_ + x)]; }
  const Pixel& at(int x, int y) const { return pixels_[static_cast<std::size_t>(y * columns_ + x)]; }

  Vec3 viewpoint_ = Vec3::Zero();
  Mat3 R_ = Mat3::Identity();  ///< rows: right, down, into the scene
  double pitch_ = 1.0;         ///< of a pixel at depth 1 m
  double left_ = 0.0, top_ = 0.0;
  int columns_ = 0, rows_ = 0;
  double nearest_depth_ = 0.0, deepest_depth_ = 0.0, width_ = 0.0;
  std::vector<Pixel> pixels_;
};

}  // namespace eigengrasp
