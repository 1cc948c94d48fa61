// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "eigengrasp/grasp/grasp.hpp"
#include "eigengrasp/grasp/scene.hpp"
#include "eigengrasp/kinematics/hand_model.hpp"
#include "eigengrasp/render/image.hpp"
#include "eigengrasp/render/render_scene.hpp"

namespace eigengrasp {

/// Colours of the pictures.
struct Palette {
  Color hand{0.86F, 0.80F, 0.70F, 1.0F};
  Color base{0.62F, 0.64F, 0.67F, 1.0F};  ///< of the link that carries the fingers
  Color object{0.36F, 0.56F, 0.78F, 1.0F};
  Color obstacle{0.84F, 0.84F, 0.83F, 1.0F};
  Color contact{0.84F, 0.10F, 0.12F, 1.0F};
  Color cone{0.95F, 0.45F, 0.10F, 0.45F};
  Color arrow{0.12F, 0.45F, 0.25F, 1.0F};
};

struct PictureOptions {
  int tile = 400;   ///< side of a tile [pixel]
  int columns = 0;  ///< of a grid; 0: as suits the number of tiles
  int threads = 0;  ///< 0: all. Does not change the picture
  /// Direction of view (into the scene; frame of the object, or of the hand where there is none); none:
  /// picked.
  std::optional<Vec3> view;
  std::optional<Vec3> up;  ///< none: z of the object; of a hand alone the direction of its fingers
  bool friction_cones = false;
  std::string heading;  ///< none: one that suits the picture
  Palette palette;
};

/// A hand with its surfaces prepared, to be drawn many times.
class DrawnHand {
 public:
  explicit DrawnHand(std::shared_ptr<const HandModel> hand);
  const HandModel& hand() const { return *hand_; }
  /// Adds the links for joint values (n_joints). With ghost alpha below 1 the hand is translucent.
  void add_to(RenderScene& scene, const VecX& joints, const Pose& X_WH, const Palette& palette,
              float alpha = 1.0F) const;

 private:
  std::shared_ptr<const HandModel> hand_;
  std::vector<SurfacePtr> surfaces_;  ///< one a link; null for links without geometry
  std::vector<bool> is_base_;
};

/// From the palm to the fingertips in the rest posture, unit, in the hand frame; the approach direction
/// where they are within 45 degrees, or the hand has no fingers.
Vec3 finger_direction(const HandModel& hand);

/// A direction from which the palm side and most links of the hand are seen, in the hand frame.
Vec3 hand_view(const HandModel& hand);

/// One hand at joint values (n_joints).
Image hand_picture(const std::shared_ptr<const HandModel>& hand, const VecX& joints,
                   const PictureOptions& options = {});

/// The rest posture with every virtual contact and its normal, seen from the palm and obliquely (Fig. 1 of
/// the paper).
Image hand_contacts_picture(const std::shared_ptr<const HandModel>& hand, const PictureOptions& options = {});

/// A row for each eigengrasp (at most `rows`): the hand at the smallest amplitude, at the origin and at the
/// largest amplitude (Table I of the paper), inside the joint limits.
Image eigengrasp_picture(const std::shared_ptr<const HandModel>& hand, int rows = 2,
                         const PictureOptions& options = {});

/// Hands in their rest posture beside each other, each seen alike; captions may be empty.
Image hands_side_by_side(std::span<const std::shared_ptr<const HandModel>> hands,
                         std::vector<std::string> captions, const PictureOptions& options = {});

/// A tile for each grasp, in their order: hand, object, obstacles, contacts; captions with rank, epsilon and
/// energy.
/// @throws Error where a grasp names a joint that the hand does not have.
Image grasps_picture(const Scene& scene, std::span<const Grasp> grasps, const PictureOptions& options = {});

/// A grasp without text, for sheets of pictures, and the direction that it is seen in.
struct GraspTile {
  Image image;
  Vec3 view = Vec3::UnitX();  ///< into the scene, in the frame of the object
};
GraspTile grasp_tile(const Scene& scene, const Grasp& grasp, const PictureOptions& options = {});

/// Pre-grasp and grasp side by side from the same place, the grasp with contacts (and friction cones where
/// the options say so).
Image grasp_pair_picture(const Scene& scene, const Grasp& grasp, const PictureOptions& options = {});

}  // namespace eigengrasp
