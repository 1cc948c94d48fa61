// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <algorithm>
#include <span>

#include "geometry/box_pairs.hpp"

namespace eigengrasp::detail {

/// Nodes that wait to be looked at.
struct NodePair {
  int a;
  int b;
  double bound;  ///< what is known of their parents
};

/// Of bounded size: where it fills up, few are taken at a time, so that it grows no further than the
/// hierarchies are deep.
class NodeStack {
 public:
  bool empty() const { return top_ == 0; }
  void push(const NodePair& pair) { pairs_[top_++] = pair; }
  NodePair pop() { return pairs_[--top_]; }
  /// How many to take at a time.
  int batch() const { return top_ < crowded ? BoxPairs::most : 1; }

 private:
  static constexpr int crowded = 768;
  NodePair pairs_[1024];
  int top_ = 0;
};

inline float largest_half(const MeshBvh& bvh, int node) {
  const float* half = bvh.oriented_box(node).half;
  return std::max(std::max(half[0], half[1]), half[2]);
}

/// Puts the children of the larger node, each with the other node, on the stack. @pre not both are leaves
inline void push_children(const MeshBvh& a, const MeshBvh& b, const NodePair& pair, NodeStack& stack) {
  const MeshBvh::Node& na = a.nodes()[static_cast<std::size_t>(pair.a)];
  const MeshBvh::Node& nb = b.nodes()[static_cast<std::size_t>(pair.b)];
  const bool split_a = nb.count > 0 || (na.count == 0 && largest_half(a, pair.a) >= largest_half(b, pair.b));
  for (int child = 1; child >= 0; --child)
    stack.push(split_a ? NodePair{na.left + child, pair.b, pair.bound}
                       : NodePair{pair.a, nb.left + child, pair.bound});
}

/// Up to sixteen pairs that were looked at together, with what the look showed; the largest bounds first.
class SortedPairs {
 public:
  void add(const NodePair& pair) {
    int i = n_++;
    for (; i > 0 && pairs_[i - 1].bound < pair.bound; --i) pairs_[i] = pairs_[i - 1];
    pairs_[i] = pair;
  }
  void clear() { n_ = 0; }
  const NodePair* begin() const { return pairs_; }
  const NodePair* end() const { return pairs_ + n_; }

 private:
  NodePair pairs_[BoxPairs::most];
  int n_ = 0;
};

/// Simultaneous descent of two hierarchies from pairs of nodes, the nearer pairs first: calls visit(node of
/// a, node of b) for pairs of leaves of which, and of all above them up to the start, the boxes are no
/// farther apart than bound() [m], which may shrink meanwhile. Stops where visit returns true.
template <typename Bound, typename Visit>
void descend_from(std::span<const NodePair> starts, const MeshBvh& a, const MeshBvh& b, const Pose& X_AB,
                  Bound bound, Visit visit) {
  if (starts.empty()) return;
  BoxPairs boxes(a, b, X_AB);
  NodeStack stack;
  NodePair taken[BoxPairs::most];
  SortedPairs inner;
  std::size_t started = 0;
  while (!stack.empty() || started < starts.size()) {
    boxes.clear();
    for (int most = stack.batch(); boxes.size() < most && (!stack.empty() || started < starts.size());) {
      const NodePair pair = stack.empty() ? starts[started++] : stack.pop();
      if (pair.bound > bound()) continue;
      taken[boxes.size()] = pair;
      boxes.add(pair.a, pair.b);
    }
    if (boxes.size() == 0) continue;
    boxes.look_at_gaps();
    inner.clear();
    for (int i = 0; i < boxes.size(); ++i) {
      const double gap = boxes.gap(i);
      if (gap > bound()) continue;
      const MeshBvh::Node& na = a.nodes()[static_cast<std::size_t>(taken[i].a)];
      const MeshBvh::Node& nb = b.nodes()[static_cast<std::size_t>(taken[i].b)];
      if (na.count == 0 || nb.count == 0) {
        inner.add({taken[i].a, taken[i].b, gap});
      } else if (visit(na, nb)) {
        return;
      }
    }
    for (const NodePair& pair : inner) push_children(a, b, pair, stack);
  }
}

/// From the roots.
template <typename Bound, typename Visit>
void descend(const MeshBvh& a, const MeshBvh& b, const Pose& X_AB, Bound bound, Visit visit) {
  const NodePair whole{0, 0, 0.0};
  if (!a.empty() && !b.empty()) descend_from({&whole, 1}, a, b, X_AB, bound, visit);
}

}  // namespace eigengrasp::detail
