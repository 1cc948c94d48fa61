// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/scan/depth_view.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "scan/nearest_pixels.hpp"

namespace eigengrasp {

namespace {

constexpr int kFrame = 4;             // free pixels around the picture
constexpr double kClosed = 2.0;       // gaps of up to twice this are closed [pixels]
constexpr double kLargestSide = 400;  // [pixels]
constexpr double kLeastCosine = 0.15;

/// Rows: right, down, into the scene.
Mat3 camera_axes(const Vec3& into) {
  Mat3 R;
  R.row(2) = into.normalized();
  R.row(0) = into.unitOrthogonal();
  R.row(1) = Vec3(R.row(2)).cross(Vec3(R.row(0)));
  return R;
}

}  // namespace

DepthView::DepthView(const std::vector<Vec3>& points, const Vec3& viewpoint, double spacing)
    : viewpoint_(viewpoint) {
  Vec3 middle = Vec3::Zero();
  for (const Vec3& p : points) middle += p / static_cast<double>(points.size());
  R_ = camera_axes(middle - viewpoint);
  place_points(points, spacing);
}

void DepthView::place_points(const std::vector<Vec3>& points, double spacing) {
  constexpr double none = std::numeric_limits<double>::infinity();
  double right = -none, bottom = -none, middle_depth = 0.0;
  left_ = top_ = nearest_depth_ = none;
  deepest_depth_ = 0.0;
  std::vector<Vec3> seen_points;  // u, v at depth 1, depth
  for (const Vec3& p : points) {
    const Vec3 q = R_ * (p - viewpoint_);
    if (!(q.z() > 0.5 * spacing)) continue;
    seen_points.emplace_back(q.x() / q.z(), q.y() / q.z(), q.z());
    const Vec3& s = seen_points.back();
    left_ = std::min(left_, s.x());
    right = std::max(right, s.x());
    top_ = std::min(top_, s.y());
    bottom = std::max(bottom, s.y());
    nearest_depth_ = std::min(nearest_depth_, s.z());
    deepest_depth_ = std::max(deepest_depth_, s.z());
    middle_depth += s.z();
  }
  middle_depth /= static_cast<double>(seen_points.size());
  pitch_ = std::max(
      {1.5 * spacing / middle_depth, (right - left_) / kLargestSide, (bottom - top_) / kLargestSide});
  columns_ = static_cast<int>((right - left_) / pitch_) + 1 + 2 * kFrame;
  rows_ = static_cast<int>((bottom - top_) / pitch_) + 1 + 2 * kFrame;
  left_ -= (kFrame + 0.5) * pitch_;  // the outermost points lie in the middle of their pixels
  top_ -= (kFrame + 0.5) * pitch_;
  pixels_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));

  const auto pixel_of = [&](const Vec3& s) {
    const int x = std::clamp(static_cast<int>((s.x() - left_) / pitch_), 0, columns_ - 1);
    const int y = std::clamp(static_cast<int>((s.y() - top_) / pitch_), 0, rows_ - 1);
    return static_cast<std::size_t>(y * columns_ + x);
  };
  std::vector<double> nearest(pixels_.size(), none), sum(pixels_.size(), 0.0);
  std::vector<int> count(pixels_.size(), 0);
  for (const Vec3& s : seen_points) nearest[pixel_of(s)] = std::min(nearest[pixel_of(s)], s.z());
  for (const Vec3& s : seen_points) {  // the mean of what is seen, without what it hides
    if (s.z() > nearest[pixel_of(s)] + 3.0 * spacing) continue;
    sum[pixel_of(s)] += s.z();
    ++count[pixel_of(s)];
  }
  std::vector<char> seen(pixels_.size(), 0);
  int area = 0;
  for (std::size_t i = 0; i < pixels_.size(); ++i) {
    if (count[i] == 0) continue;
    seen[i] = 1;
    pixels_[i].depth = static_cast<float>(sum[i] / count[i]);
  }
  close_gaps(seen);
  for (const char s : seen) area += s;
  width_ = std::sqrt(static_cast<double>(area)) * pitch_ * middle_depth;
  measure_edges(seen);
  measure_slopes();
}

void DepthView::close_gaps(std::vector<char>& seen) {
  const std::vector<int> to_seen = nearest_pixels(seen, columns_);
  std::vector<char> far(seen.size());
  for (std::size_t i = 0; i < seen.size(); ++i)
    far[i] = pixel_distance(static_cast<int>(i), to_seen[i], columns_) > kClosed;
  const std::vector<int> to_far = nearest_pixels(far, columns_);
  std::vector<char> closed = seen;
  for (std::size_t i = 0; i < seen.size(); ++i)
    if (to_far[i] < 0 || pixel_distance(static_cast<int>(i), to_far[i], columns_) > kClosed) closed[i] = 1;
  // What is new gets the mean of the neighbours that have a depth, from the rim of a gap inwards.
  std::vector<char> known = seen;
  for (bool more = true; more;) {
    more = false;
    std::vector<char> next = known;
    for (int y = 1; y + 1 < rows_; ++y) {
      for (int x = 1; x + 1 < columns_; ++x) {
        const auto i = static_cast<std::size_t>(y * columns_ + x);
        if (known[i] != 0 || closed[i] == 0) continue;
        float sum = 0.0F;
        int count = 0;
        for (int k = 0; k < 9; ++k) {
          const auto j = static_cast<std::size_t>((y + k / 3 - 1) * columns_ + x + k % 3 - 1);
          if (known[j] == 0) continue;
          sum += pixels_[j].depth;
          ++count;
        }
        if (count == 0) continue;
        pixels_[i].depth = sum / static_cast<float>(count);
        next[i] = 1;
        more = true;
      }
    }
    known = std::move(next);
  }
  seen = std::move(known);
}

void DepthView::measure_edges(const std::vector<char>& seen) {
  std::vector<char> unseen(seen.size());
  for (std::size_t i = 0; i < seen.size(); ++i) unseen[i] = seen[i] == 0;
  const std::vector<int> to_seen = nearest_pixels(seen, columns_),
                         to_unseen = nearest_pixels(unseen, columns_);
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const int other = seen[i] != 0 ? to_unseen[i] : to_seen[i];
    const double distance = pixel_distance(static_cast<int>(i), other, columns_) - 0.5;
    pixels_[i].edge = static_cast<float>(seen[i] != 0 ? -distance : distance);
  }
  for (std::size_t i = 0; i < seen.size(); ++i)
    if (seen[i] == 0) pixels_[i].depth = pixels_[static_cast<std::size_t>(to_seen[i])].depth;
  smooth(&Pixel::edge);  // of the steps between pixels
  smooth(&Pixel::edge);
  smooth(&Pixel::depth);
}

void DepthView::smooth(float Pixel::*field) {
  std::vector<float> means(pixels_.size());
  for (int y = 0; y < rows_; ++y) {
    for (int x = 0; x < columns_; ++x) {
      float sum = 0.0F;
      for (int k = 0; k < 9; ++k)
        sum += at(std::clamp(x + k % 3 - 1, 0, columns_ - 1), std::clamp(y + k / 3 - 1, 0, rows_ - 1)).*field;
      means[static_cast<std::size_t>(y * columns_ + x)] = sum / 9.0F;
    }
  }
  for (std::size_t i = 0; i < pixels_.size(); ++i) pixels_[i].*field = means[i];
}

void DepthView::measure_slopes() {
  for (int y = 1; y + 1 < rows_; ++y) {
    for (int x = 1; x + 1 < columns_; ++x) {
      const double step = 2.0 * pitch_ * static_cast<double>(at(x, y).depth);
      const double dx = static_cast<double>(at(x + 1, y).depth - at(x - 1, y).depth) / step;
      const double dy = static_cast<double>(at(x, y + 1).depth - at(x, y - 1).depth) / step;
      at(x, y).cosine = static_cast<float>(std::max(1.0 / std::sqrt(1.0 + dx * dx + dy * dy), kLeastCosine));
    }
  }
}

DepthView::Sample DepthView::sample(double u, double v) const {
  const double x = (u - left_) / pitch_ - 0.5, y = (v - top_) / pitch_ - 0.5;
  const double cx = std::clamp(x, 0.0, columns_ - 1.001), cy = std::clamp(y, 0.0, rows_ - 1.001);
  const int i = static_cast<int>(cx), j = static_cast<int>(cy);
  const double a = cx - i, b = cy - j;
  const Pixel &p = at(i, j), &q = at(i + 1, j), &r = at(i, j + 1), &s = at(i + 1, j + 1);
  const auto mix = [&](float Pixel::*field) {
    return (1.0 - b) * ((1.0 - a) * static_cast<double>(p.*field) + a * static_cast<double>(q.*field)) +
           b * ((1.0 - a) * static_cast<double>(r.*field) + a * static_cast<double>(s.*field));
  };
  return {mix(&Pixel::depth), mix(&Pixel::edge), mix(&Pixel::cosine), std::hypot(x - cx, y - cy)};
}

double DepthView::outside(const Vec3& p) const {
  const Vec3 q = R_ * (p - viewpoint_);
  if (q.z() <= 0.0) return (p - viewpoint_).norm() + nearest_depth_;
  const Sample s = sample(q.x() / q.z(), q.y() / q.z());
  const double beside = (s.edge + s.beyond) * pitch_ * q.z();
  return std::max(beside, (s.depth - q.z()) * s.cosine);
}

double DepthView::behind(const Vec3& p) const {
  const Vec3 q = R_ * (p - viewpoint_);
  if (q.z() <= 0.0) return -nearest_depth_;
  const Sample s = sample(q.x() / q.z(), q.y() / q.z());
  return (q.z() - s.depth) * s.cosine;
}

}  // namespace eigengrasp
