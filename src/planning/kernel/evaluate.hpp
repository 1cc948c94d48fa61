// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include "planning/kernel/field_lookup.hpp"

/// Legality and contact energy of sixteen states. First with a lane a state: posture, forward kinematics, a
/// few balls of each link, energy. Then, for the states that are left, with a lane a ball: the links near
/// something.
namespace eigengrasp::kernel {

template <class B>
class Evaluation {
  using F = Floats<B>;
  using V = Vector<B>;

 public:
  Evaluation(const Program& program, const Workspace& work) : p_(program), w_(work) {}

  void run() {
    embed();
    place_bodies();
    place_parts();
    alive_ = 0xffffu;
    for (int i = 0; i < n_lanes; ++i) w_.verdict[i] = legal;
    const std::uint32_t unsure_postures = consult_postures();
    add_up_energy();
    if (alive_ == 0) return;
    place_cores();
    for (int k = 0; k < p_.n_obstacles && alive_ != 0; ++k) meet_obstacle(p_.obstacles[k]);
    for (std::uint32_t left = alive_; left != 0; left &= left - 1) {
      const int lane = __builtin_ctz(left);
      if (touches_object(lane)) end(1u << lane, hits_object);
    }
    meet_itself(unsure_postures);
  }

  void run_clear_itself() {
    embed();
    place_bodies();
    place_parts();
    float least[n_lanes];
    for (float& x : least) x = most_clearance;
    for (int i = 0; i < p_.n_pairs; ++i) {
      const Part& a = p_.parts[p_.pairs[i].balls];
      const Part& b = p_.parts[p_.pairs[i].field];
      for (std::uint32_t left = near_each_other(p_.pairs[i], most_clearance); left != 0; left &= left - 1) {
        const int lane = __builtin_ctz(left);
        const Motion<B> X = splat_motion<B>(pose_in_link(a, b, lane));
        for (int core = a.first_core; core < a.first_core + a.n_cores; ++core)
          least[lane] = clearance<false>(core, X, b.field, least[lane]);
      }
    }
    for (int i = 0; i < n_lanes; ++i) w_.energy[i] = least[i];
  }

 private:
  /// p = p_m + sum a_i e_i, eq. (2), inside the limits.
  void embed() {
    for (int d = 0; d < p_.n_dofs; ++d) {
      F value(p_.origin[d]);
      for (int i = 0; i < p_.n_amplitudes; ++i)
        value = value + F(p_.basis[d * p_.n_amplitudes + i]) * load<B>(w_.amplitudes + i * n_lanes);
      store<B>(w_.dofs + d * n_lanes, clamp(value, F(p_.dof_min[d]), F(p_.dof_max[d])));
    }
  }

  float* pose(int body) const { return w_.poses + body * 12 * n_lanes; }

  void place_bodies() {
    store_motion<B>(pose(0), base());
    for (int b = 1; b < p_.n_bodies; ++b) {
      const Body& body = p_.bodies[b];
      Motion<B> X = times(load_motion<B>(pose(body.parent)), body.in_parent);
      const F value = F(body.ratio) * load<B>(w_.dofs + body.dof * n_lanes) + F(body.offset);
      if (body.slides) {
        X.p = X.p + value * X.ez;
      } else {
        const SineCosine<B> t = sine_cosine<B>(value);
        const V ex = t.cosine * X.ex + t.sine * X.ey;
        X.ey = t.cosine * X.ey - t.sine * X.ex;
        X.ex = ex;
      }
      store_motion<B>(pose(b), X);
    }
  }

  Motion<B> base() const {
    const F w = load<B>(w_.quaternion);
    const F x = load<B>(w_.quaternion + n_lanes);
    const F y = load<B>(w_.quaternion + 2 * n_lanes);
    const F z = load<B>(w_.quaternion + 3 * n_lanes);
    const F one(1.0f);
    const F two(2.0f);
    Motion<B> X;
    X.ex = {one - two * (y * y + z * z), two * (x * y + w * z), two * (x * z - w * y)};
    X.ey = {two * (x * y - w * z), one - two * (x * x + z * z), two * (y * z + w * x)};
    X.ez = {two * (x * z + w * y), two * (y * z - w * x), one - two * (x * x + y * y)};
    const V a{load<B>(w_.position), load<B>(w_.position + n_lanes), load<B>(w_.position + 2 * n_lanes)};
    X.p = a - turned(X, splat<B>(p_.approach_point));
    return X;
  }

  float* center(int part) const { return w_.centers + part * 3 * n_lanes; }
  V load_center(int part) const {
    return {load<B>(center(part)), load<B>(center(part) + n_lanes), load<B>(center(part) + 2 * n_lanes)};
  }

  void place_parts() {
    for (int i = 0; i < p_.n_parts; ++i) {
      const V c = moved(load_motion<B>(pose(p_.parts[i].body)), splat<B>(p_.parts[i].center));
      store<B>(center(i), c.x);
      store<B>(center(i) + n_lanes, c.y);
      store<B>(center(i) + 2 * n_lanes, c.z);
    }
  }

  void end(std::uint32_t lanes, Verdict verdict) {
    alive_ &= ~lanes;
    for (; lanes != 0; lanes &= lanes - 1) w_.verdict[__builtin_ctz(lanes)] = verdict;
  }

  /// Where the cores are, in every lane.
  void place_cores() {
    for (int k = 0; k < p_.n_cores; ++k) {
      const CoreBall& ball = p_.cores[k];
      const V c = moved(load_motion<B>(pose(ball.body)), splat<B>(ball.center));
      float* const to = w_.cores + k * 3 * n_lanes;
      store<B>(to, c.x);
      store<B>(to + n_lanes, c.y);
      store<B>(to + 2 * n_lanes, c.z);
    }
  }

  /// Mean over the virtual contacts of distance in millimetres + 1000 alpha (1 - n . o / |o|). No contact
  /// lowers the sum: it ends where all states that are left are above their thresholds.
  void add_up_energy() {
    constexpr int contacts_between_looks = 6;
    const F threshold = load<B>(w_.threshold);
    const F each(p_.n_contacts > 0 ? 1000.0f / static_cast<float>(p_.n_contacts) : 0.0f);
    F energy(0.0f);
    F distances(0.0f);
    F misfits(0.0f);
    for (int i = 0; i < p_.n_contacts; ++i) {
      add_contact(i, distances, misfits);
      if ((i + 1) % contacts_between_looks != 0 && i + 1 < p_.n_contacts) continue;
      energy = each * (distances + F(p_.alpha) * misfits);
      if ((bits(energy < threshold) & alive_) == 0) break;
    }
    store<B>(w_.energy, energy);
    end(bits(threshold <= energy) & alive_, energy_too_high);
  }

  EIGENGRASP_LANES_INLINE void add_contact(int i, F& distances, F& misfits) const {
    const Contact& contact = p_.contacts[i];
    const Motion<B> X = load_motion<B>(pose(contact.body));
    const V point = moved(X, splat<B>(contact.p));
    const PointSlope<B> at = look_up_slope<B>(p_.object.field, point);
    const V& g = at.gradient;
    const F slope = sqrt(max(dot(g, g), F(1.0f)));
    // -o: from the nearest point of the surface to the contact, for one beyond the grid by way of its border.
    const V away = at.beyond + (at.distance / slope) * g;
    const F length = sqrt(dot(away, away));
    const V normal = turned(X, splat<B>(contact.n));
    const F minus_cosine = dot(normal, away) / max(length, F(1e-9f));
    distances = distances + length;
    misfits = misfits + (F(1.0f) + minus_cosine);
    if (w_.approaches == nullptr) return;
    const F rows[n_approach_rows] = {point.x,  point.y,  point.z, normal.x,
                                     normal.y, normal.z, length,  F(0.0f) - minus_cosine};
    float* const kept = w_.approaches + i * n_approach_rows * n_lanes;
    for (int k = 0; k < n_approach_rows; ++k) store<B>(kept + k * n_lanes, rows[k]);
  }

  Transform pose_of_lane(int body, int lane) const {
    const float* x = pose(body) + lane;
    Transform t;
    for (int column = 0; column < 3; ++column)
      for (int row = 0; row < 3; ++row) t.R[3 * row + column] = x[(3 * column + row) * n_lanes];
    for (int row = 0; row < 3; ++row) t.p[row] = x[(9 + row) * n_lanes];
    return t;
  }

  /// Sixteen cores at once; then what the cores own that are near the object.
  bool touches_object(int lane) const {
    const F limit(-p_.refuse_depth);
    const int n_packs = (p_.n_cores + n_lanes - 1) / n_lanes;
    for (int i = 0; i < n_packs; ++i) {
      const CorePack& pack = p_.core_packs[i];
      const Ints<B> at = load_ints<B>(pack.place);
      const float* const centers = w_.cores + lane;
      const V center{gather<B>(centers, at), gather<B>(centers + n_lanes, at),
                     gather<B>(centers + 2 * n_lanes, at)};
      const PointDistance<B> d = look_up<B>(p_.object.field, center);
      if (bits(d.at_border + d.beyond - load<B>(pack.radius) < limit) != 0) return true;
      w_.near[i] = bits(lower_bound(d) - load<B>(pack.reach) < limit);
    }
    for (int i = 0; i < n_packs; ++i)
      for (std::uint32_t near = w_.near[i]; near != 0; near &= near - 1) {
        const int core = n_lanes * i + __builtin_ctz(near);
        const Motion<B> X = splat_lane<B>(pose(p_.cores[core].body) + lane);
        if (core_hits(core, X, p_.object.field)) return true;
      }
    return false;
  }

  /// A point beyond the grid by b, whose border's distance is d, is at least the root of d^2 + b^2 from the
  /// surface, since that lies within the grid's box; and at most d + b.
  static F lower_bound(const PointDistance<B>& d) {
    return select(F(0.0f) < d.beyond, sqrt(d.beyond * d.beyond + d.at_border * d.at_border), d.at_border);
  }

  /// The least distance minus radius over the balls that a core owns, where that is below the limit, else the
  /// limit. `enough`: may return as soon as something below the limit was found.
  /// @param X pose of the part's body in the field's frame
  template <bool enough>
  float clearance(int core, const Motion<B>& X, const FieldView& field, float limit) const {
    float least = limit;
    std::uint32_t near = near_clusters(p_.clusters[core], X, field, least);
    if (enough && least < limit) return least;
    const BallPack* const packs = p_.balls + n_lanes * core;
    for (; near != 0; near &= near - 1) {
      const F gap = ball_gaps(packs[__builtin_ctz(near)], X, field);
      if (bits(gap < F(least)) == 0) continue;
      least = lowest(gap, least);
      if (enough) return least;
    }
    return least;
  }

  /// The clusters that may have a ball nearer than `least`, which is lowered to the cores' least gap.
  std::uint32_t near_clusters(const ClusterPack& c, const Motion<B>& X, const FieldView& field,
                              float& least) const {
    const PointDistance<B> at = look_up<B>(field, moved(X, V{load<B>(c.x), load<B>(c.y), load<B>(c.z)}));
    const F core = at.at_border + at.beyond - load<B>(c.radius);
    if (bits(core < F(least)) != 0) least = lowest(core, least);
    const F slack = lower_bound(at) - load<B>(c.reach);
    return bits(slack < F(least));
  }

  F ball_gaps(const BallPack& pack, const Motion<B>& X, const FieldView& field) const {
    const PointDistance<B> at =
        look_up<B>(field, moved(X, V{load<B>(pack.x), load<B>(pack.y), load<B>(pack.z)}));
    return at.at_border + at.beyond - load<B>(pack.radius);
  }

  float lowest(const F& values, float least) const {
    store<B>(w_.row, values);
    for (int i = 0; i < n_lanes; ++i)
      if (w_.row[i] < least) least = w_.row[i];
    return least;
  }

  bool core_hits(int core, const Motion<B>& X_FB, const FieldView& field) const {
    return clearance<true>(core, X_FB, field, -p_.refuse_depth) < -p_.refuse_depth;
  }
  bool part_hits(const Part& part, const Motion<B>& X_FB, const FieldView& field) const {
    for (int core = part.first_core; core < part.first_core + part.n_cores; ++core)
      if (core_hits(core, X_FB, field)) return true;
    return false;
  }

  void meet_obstacle(const Solid& solid) {
    const Motion<B> X_BO = splat_motion<B>(solid.object_in_field);
    for (int i = 0; i < p_.n_parts; ++i) {
      const Part& part = p_.parts[i];
      const DistanceBounds<B> bounds = bound_distance<B>(solid.field, moved(X_BO, load_center(i)));
      for (std::uint32_t left = bits(bounds.lower < F(part.reach)) & alive_; left != 0; left &= left - 1) {
        const int lane = __builtin_ctz(left);
        const Transform X_FB = product(solid.object_in_field, pose_of_lane(part.body, lane));
        if (part_hits(part, splat_motion<B>(X_FB), solid.field)) end(1u << lane, hits_obstacle);
      }
    }
  }

  static Transform product(const Transform& a, const Transform& b) {
    Transform c;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j)
        c.R[3 * i + j] = a.R[3 * i] * b.R[j] + a.R[3 * i + 1] * b.R[3 + j] + a.R[3 * i + 2] * b.R[6 + j];
      c.p[i] = a.R[3 * i] * b.p[0] + a.R[3 * i + 1] * b.p[1] + a.R[3 * i + 2] * b.p[2] + a.p[i];
    }
    return c;
  }
  static Transform inverse(const Transform& a) {
    Transform c;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) c.R[3 * i + j] = a.R[3 * j + i];
      c.p[i] = -(a.R[i] * a.p[0] + a.R[3 + i] * a.p[1] + a.R[6 + i] * a.p[2]);
    }
    return c;
  }

  /// Sorts out the postures that surely collide, and returns the lanes of those that may.
  std::uint32_t consult_postures() {
    // How far the clearance may be from what is interpolated, see docs/theory/performance.md.
    constexpr float least_tolerance = 0.0001f;  // [m]
    constexpr float tolerance_per_spread = 0.3f;
    const PostureGrid& g = p_.postures;
    if (!g.clearance) return 0xffffu;
    const auto place = [&](int i) {
      const F u = F(g.per_amplitude[i]) * (load<B>(w_.amplitudes + i * n_lanes) - F(g.low[i]));
      return clamp(u, F(0.0f), F(static_cast<float>(g.nodes[i] - 1)));
    };
    const auto node = [&](const F& u, int i) {
      return truncate(min(u, F(static_cast<float>(g.nodes[i] - 2))));
    };
    const bool two = p_.n_amplitudes > 1;
    const F u0 = place(0);
    const F u1 = two ? place(1) : F(0.0f);
    const Ints<B> i0 = node(u0, 0);
    const Ints<B> i1 = two ? node(u1, 1) : Ints<B>(0);
    const Ints<B> at = i0 + i1 * Ints<B>(g.nodes[0]);
    const Ints<B> up(two ? g.nodes[0] : 0);
    const Ints<B> one(1);
    const F c00 = gather<B>(g.clearance, at);
    const F c10 = gather<B>(g.clearance, at + one);
    const F c01 = gather<B>(g.clearance, at + up);
    const F c11 = gather<B>(g.clearance, at + up + one);
    const F f0 = u0 - to_float(i0);
    const F clear = mix(mix(c00, c10, f0), mix(c01, c11, f0), u1 - to_float(i1));
    const F spread = max(max(c00, c10), max(c01, c11)) - min(min(c00, c10), min(c01, c11));
    const F tolerance = F(least_tolerance) + F(tolerance_per_spread) * spread;
    const F over = clear + F(p_.refuse_depth);
    end(bits(over < F(0.0f) - tolerance) & alive_, hits_itself);
    return bits(over < tolerance);
  }

  void meet_itself(std::uint32_t unsure) {
    for (int i = 0; i < p_.n_pairs; ++i) {
      const Part& a = p_.parts[p_.pairs[i].balls];
      const Part& b = p_.parts[p_.pairs[i].field];
      for (std::uint32_t left = near_each_other(p_.pairs[i], 0.0f) & unsure & alive_; left != 0;
           left &= left - 1) {
        const int lane = __builtin_ctz(left);
        if (part_hits(a, splat_motion<B>(pose_in_link(a, b, lane)), b.field)) end(1u << lane, hits_itself);
      }
      if ((alive_ & unsure) == 0) return;
    }
  }

  std::uint32_t near_each_other(const Pair& pair, float margin) const {
    const V gap = load_center(pair.balls) - load_center(pair.field);
    const float reach = p_.parts[pair.balls].reach + p_.parts[pair.field].reach + margin;
    return bits(dot(gap, gap) < F(reach * reach));
  }

  /// Pose of a's body in the frame of b's field.
  Transform pose_in_link(const Part& a, const Part& b, int lane) const {
    const Transform X_BO = inverse(pose_of_lane(b.body, lane));
    return product(b.body_in_link, product(X_BO, pose_of_lane(a.body, lane)));
  }

  const Program& p_;
  const Workspace& w_;
  std::uint32_t alive_ = 0;
};

template <class B>
void clear_itself(const Program& program, const Workspace& work) {
  Evaluation<B>(program, work).run_clear_itself();
}

template <class B>
void evaluate(const Program& program, const Workspace& work) {
  Evaluation<B>(program, work).run();
}

}  // namespace eigengrasp::kernel
