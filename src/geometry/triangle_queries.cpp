// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/geometry/triangle_queries.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace eigengrasp {

namespace {

Vec3 closest_point_on_segment(const Vec3& a, const Vec3& b, const Vec3& p) {
  const Vec3 d = b - a;
  const double length2 = d.squaredNorm();
  if (length2 <= 0.0) return a;
  return a + std::clamp((p - a).dot(d) / length2, 0.0, 1.0) * d;
}

/// For triangles without area: the nearest point of the three edges.
Vec3 closest_point_on_edges(const TriangleCorners& t, const Vec3& p) {
  Vec3 best = closest_point_on_segment(t.a, t.b, p);
  for (const Vec3& q : {closest_point_on_segment(t.b, t.c, p), closest_point_on_segment(t.c, t.a, p)})
    if ((q - p).squaredNorm() < (best - p).squaredNorm()) best = q;
  return best;
}

}  // namespace

// The plane is cut into the seven Voronoi regions of the corners, edges and the face (Ericson 2005,
// ch. 5.1.5).
Vec3 closest_point_on_triangle(const TriangleCorners& t, const Vec3& p) {
  const Vec3 ab = t.b - t.a;
  const Vec3 ac = t.c - t.a;
  const Vec3 ap = p - t.a;
  const double d1 = ab.dot(ap);
  const double d2 = ac.dot(ap);
  if (d1 <= 0.0 && d2 <= 0.0) return t.a;
  const Vec3 bp = p - t.b;
  const double d3 = ab.dot(bp);
  const double d4 = ac.dot(bp);
  if (d3 >= 0.0 && d4 <= d3) return t.b;
  const Vec3 cp = p - t.c;
  const double d5 = ab.dot(cp);
  const double d6 = ac.dot(cp);
  if (d6 >= 0.0 && d5 <= d6) return t.c;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return d1 > d3 ? Vec3(t.a + d1 / (d1 - d3) * ab) : t.a;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return d2 > d6 ? Vec3(t.a + d2 / (d2 - d6) * ac) : t.a;
  const double va = d3 * d6 - d5 * d4;
  const double e = (d4 - d3) + (d5 - d6);
  if (va <= 0.0 && d4 >= d3 && d5 >= d6) return e > 0.0 ? Vec3(t.b + (d4 - d3) / e * (t.c - t.b)) : t.b;
  const double sum = va + vb + vc;
  // Of needles the differences above are rounding: 1e-5 as wide as long and less.
  if (!(sum > 1e-10 * ab.squaredNorm() * ac.squaredNorm())) return closest_point_on_edges(t, p);
  return t.a + vb / sum * ab + vc / sum * ac;
}

namespace {

struct Segment {
  Vec3 from;
  Vec3 to_end;
  double length2;  ///< squared length

  Segment(const Vec3& p0, const Vec3& p1) : from(p0), to_end(p1 - p0), length2(to_end.squaredNorm()) {}
};

inline void closest_between_segments(const Segment& p, const Segment& q, Vec3& on_p, Vec3& on_q) {
  const Vec3& u = p.to_end;
  const Vec3& v = q.to_end;
  const Vec3 w = p.from - q.from;
  const double a = p.length2;
  const double e = q.length2;
  const double f = v.dot(w);
  double s = 0.0;
  double t = 0.0;
  if (a > 0.0 && e > 0.0) {
    const double b = u.dot(v);
    const double c = u.dot(w);
    const double denominator = a * e - b * b;
    if (denominator > 1e-14 * a * e) s = std::clamp((b * f - c * e) / denominator, 0.0, 1.0);
    t = (b * s + f) / e;
    if (t < 0.0) {
      t = 0.0;
      s = std::clamp(-c / a, 0.0, 1.0);
    } else if (t > 1.0) {
      t = 1.0;
      s = std::clamp((b - c) / a, 0.0, 1.0);
    }
  } else if (a > 0.0) {
    s = std::clamp(-u.dot(w) / a, 0.0, 1.0);
  } else if (e > 0.0) {
    t = std::clamp(f / e, 0.0, 1.0);
  }
  on_p = p.from + s * u;
  on_q = q.from + t * v;
}

}  // namespace

double closest_points_of_segments(const Vec3& p0, const Vec3& p1, const Vec3& q0, const Vec3& q1, Vec3& on_p,
                                  Vec3& on_q) {
  closest_between_segments({p0, p1}, {q0, q1}, on_p, on_q);
  return (on_p - on_q).norm();
}

// Moeller and Trumbore 1997, with the parameter bounded by the segment.
bool segment_hits_triangle(const Vec3& p0, const Vec3& p1, const TriangleCorners& t, Vec3& hit) {
  constexpr double slack = 1e-12;  // a segment through a shared edge must not slip between two triangles
  const Vec3 d = p1 - p0;
  const Vec3 e1 = t.b - t.a;
  const Vec3 e2 = t.c - t.a;
  const Vec3 h = d.cross(e2);
  const double det = e1.dot(h);
  if (det == 0.0) return false;
  const double inverse = 1.0 / det;
  const Vec3 s = p0 - t.a;
  const double u = inverse * s.dot(h);
  if (!(u >= -slack && u <= 1.0 + slack)) return false;
  const Vec3 q = s.cross(e1);
  const double v = inverse * d.dot(q);
  if (!(v >= -slack && u + v <= 1.0 + slack)) return false;
  const double r = inverse * e2.dot(q);
  if (!(r >= 0.0 && r <= 1.0)) return false;
  hit = p0 + r * d;
  return true;
}

namespace {

/// Signs of the distances of t's corners to the plane of s: +1 or -1 where all lie strictly on one side, else
/// 0.
int side_of_plane(const TriangleCorners& s, const TriangleCorners& t) {
  const Vec3 n = (s.b - s.a).cross(s.c - s.a);
  const double da = n.dot(t.a - s.a);
  const double db = n.dot(t.b - s.a);
  const double dc = n.dot(t.c - s.a);
  if (da > 0 && db > 0 && dc > 0) return 1;
  if (da < 0 && db < 0 && dc < 0) return -1;
  return 0;
}

bool find_crossing(const TriangleCorners& s, const TriangleCorners& t, Vec3& hit) {
  if (side_of_plane(s, t) != 0 || side_of_plane(t, s) != 0) return false;
  return segment_hits_triangle(s.a, s.b, t, hit) || segment_hits_triangle(s.b, s.c, t, hit) ||
         segment_hits_triangle(s.c, s.a, t, hit) || segment_hits_triangle(t.a, t.b, s, hit) ||
         segment_hits_triangle(t.b, t.c, s, hit) || segment_hits_triangle(t.c, t.a, s, hit);
}

}  // namespace

bool plane_separates(const TriangleCorners& s, const TriangleCorners& t, double distance) {
  const auto keeps = [distance](const TriangleCorners& plane, const TriangleCorners& other) {
    const Vec3 ab = plane.b - plane.a;
    const Vec3 ac = plane.c - plane.a;
    const Vec3 n = ab.cross(ac);
    if (!(n.squaredNorm() > 1e-16 * ab.squaredNorm() * ac.squaredNorm()))
      return false;  // a needle has no plane
    const double da = n.dot(other.a - plane.a);
    const double db = n.dot(other.b - plane.a);
    const double dc = n.dot(other.c - plane.a);
    const double nearest = da > 0.0 ? std::min({da, db, dc}) : -std::max({da, db, dc});
    return nearest > 0.0 && nearest * nearest > distance * distance * n.squaredNorm();
  };
  return keeps(s, t) || keeps(t, s);
}

bool triangles_cross(const TriangleCorners& s, const TriangleCorners& t) {
  Vec3 hit;
  return find_crossing(s, t, hit);
}

double closest_points_of_triangles(const TriangleCorners& s, const TriangleCorners& t, Vec3& on_s,
                                   Vec3& on_t) {
  Vec3 hit;
  if (find_crossing(s, t, hit)) {
    on_s = on_t = hit;
    return 0.0;
  }
  double best2 = std::numeric_limits<double>::infinity();
  const auto take = [&](const Vec3& p, const Vec3& q) {
    const double d2 = (q - p).squaredNorm();
    if (d2 < best2) best2 = d2, on_s = p, on_t = q;
  };
  for (const Vec3* p : {&s.a, &s.b, &s.c}) take(*p, closest_point_on_triangle(t, *p));
  for (const Vec3* p : {&t.a, &t.b, &t.c}) take(closest_point_on_triangle(s, *p), *p);
  const Segment of_s[3] = {{s.a, s.b}, {s.b, s.c}, {s.c, s.a}};
  const Segment of_t[3] = {{t.a, t.b}, {t.b, t.c}, {t.c, t.a}};
  for (const Segment& i : of_s)
    for (const Segment& j : of_t) {
      Vec3 p;
      Vec3 q;
      closest_between_segments(i, j, p, q);
      take(p, q);
    }
  return std::sqrt(best2);
}

}  // namespace eigengrasp
