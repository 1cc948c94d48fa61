// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <map>
#include <string>
#include <vector>

#include "eigengrasp/planning/pregrasp_rating.hpp"
#include "eigengrasp/shape/shape_alignment.hpp"
#include "eigengrasp/transfer/neighbor_ranking.hpp"

namespace eigengrasp {

/// The scales of a neighbour that are used (section VI-A): the largest at which it is not larger than the
/// object, and the smallest at which it is larger, by approximate radius; one, where it is smaller or larger
/// at all of them. Those that differ from the object by more than kMostSizeRatio are left out.
/// @param radius of the object @param neighbor_radius at scale 1 @param scales ascending
std::vector<double> bracketing_scales(double radius, double neighbor_radius,
                                      const std::vector<double>& scales);

/// What is still alike in size: pre-grasps keep their size, so that those of much smaller or larger objects
/// mean nothing.
inline constexpr double kMostSizeRatio = 4.0;

/// The pose of a neighbour at a scale in the object's frame, X_ON: aligned, its centre on the object's.
Pose neighbor_pose(const Alignment& alignment, double scale);

/// Whose pre-grasps are taken. With one hand, from == to.
struct HandPair {
  std::shared_ptr<const HandModel> from;  ///< of the stored grasps
  std::shared_ptr<const HandModel> to;    ///< that shall grasp
};

/// The posture (n_dof) that another hand's amplitudes mean: the amplitude of each eigengrasp that both hands
/// have keeps its share of the range on its side of 0; the hand's others stay 0. Clamped to the limits.
VecX posture_of_other_hand(const HandModel& from, const VecX& amplitudes, const HandModel& to);

struct CandidateOptions {
  int neighbors = 5;  ///< >= 1
  int most = 0;       ///< pre-grasps of a neighbour at a scale, those of the highest epsilon; 0: all
  std::string alignment = kPcaAlignment;
  int threads = 1;  ///< 0: all. Does not change the result
};

/// A neighbour that was used.
struct UsedNeighbor {
  std::string object;
  double distance = 0.0;       ///< see RankedNeighbor
  double radius = 0.0;         ///< approximate, at scale 1 [m]
  std::vector<double> scales;  ///< none: all differ too much in size
  Alignment alignment;         ///< of the neighbour at scale 1 to the object
  int candidates = 0;          ///< pre-grasps
};

struct CandidateOrigin {
  std::size_t neighbor = 0;  ///< in Candidates::neighbors
  Grasp grasp;               ///< as it is stored, in the neighbour's frame at grasp.object_scale
};

/// Pre-grasps of neighbours, the best neighbour's first, each neighbour's best first.
struct Candidates {
  std::vector<UsedNeighbor> neighbors;  ///< the most alike first
  std::vector<GivenPreGrasp> given;     ///< in the object's frame
  std::vector<CandidateOrigin> origins;
};

/// An object to which grasps are brought. For one thread.
class TransferTarget {
 public:
  /// @throws as make_alignment_shape
  TransferTarget(const TransferStore& store, const ObjectModel& object);

  /// The form-closed stored pre-grasps of the first neighbours that have some with the hand. Each neighbour
  /// is aligned once an object, whatever it is asked for. Neighbours whose geometry cannot be read are passed
  /// over. Cost: 10-20 ms a neighbour.
  /// @throws Error where none of the ranked ones has grasps with the hand
  Candidates find_candidates(const std::vector<RankedNeighbor>& ranked, const HandPair& hands,
                             const CandidateOptions& options);

 private:
  struct Chosen {
    RankedNeighbor neighbor;
    std::vector<StoredGrasp> grasps;
  };
  std::vector<Chosen> choose(const std::vector<RankedNeighbor>& ranked, const HandPair& hands,
                             std::size_t count) const;
  void align(const std::vector<Chosen>& chosen, const CandidateOptions& options);
  void add(const Chosen& chosen, const HandPair& hands, const CandidateOptions& options,
           Candidates& candidates) const;

  const TransferStore& store_;
  AlignmentShape shape_;
  double radius_;
  /// By method and neighbour; none where the neighbour could not be read.
  std::map<std::pair<std::string, std::string>, std::optional<Alignment>> alignments_;
};

}  // namespace eigengrasp
