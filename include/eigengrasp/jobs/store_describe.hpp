// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "eigengrasp/core/parallel.hpp"
#include "eigengrasp/database/grasp_store.hpp"

namespace eigengrasp {

struct DescribeOptions {
  int neighbors = 5;               ///< of each object, >= 0
  bool views = true;               ///< of each object as well, for scans
  bool align = true;               ///< each neighbour to its object, by both methods: half of the time
  int threads = 0;                 ///< 0: all. Does not change what is stored
  const StopFlag* stop = nullptr;  ///< what is done is stored; the next call goes on
  std::function<void(double share, const std::string& what)> progress = {};  ///< by one thread at a time

  /// All violations as sentences: name, value, bound.
  std::vector<std::string> validate() const;
};

struct DescribeReport {
  std::size_t described = 0;     ///< by this call
  std::size_t there = 0;         ///< descriptors that were there
  std::size_t viewed = 0;        ///< objects whose views this call described
  std::size_t neighbors = 0;     ///< pairs that are new
  std::size_t alignments = 0;    ///< that are new, of both methods
  std::vector<std::string> bad;  ///< sentences about objects that were left out, in the store's order
  bool stopped = false;
};

/// Stores what transfer needs of every object at scale 1: its surface descriptor; its views
/// (describe_views); its nearest neighbours by the distance kZernikeDistance; and the alignments of each
/// neighbour to the object (model: the neighbour, target: the object), by kPcaAlignment and kIcpAlignment,
/// their scale included. What is there already is kept; a neighbour that no longer is among the nearest, as
/// objects were added, stays with its distance. Cost: 30 ms of a core for a descriptor of 5,000 triangles,
/// 0.3 s for an object's views and for its five alignments each.
/// @throws Error where the options are not sound, or the store cannot be written
DescribeReport describe_store(GraspStore& store, const DescribeOptions& options);

}  // namespace eigengrasp
