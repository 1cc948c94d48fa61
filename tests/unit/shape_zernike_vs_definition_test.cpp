// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Moments of meshes against closed forms, and against the definition, written once more and integrated
// otherwise.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "eigengrasp/core/instruction_set.hpp"
#include "eigengrasp/shape/zernike_moments.hpp"
#include "shape/kernel/moment_tables.hpp"
#include "shape/moment_sum.hpp"
#include "shape/triangle_rule.hpp"
#include "unit/shape_test_shapes.hpp"

namespace eigengrasp::testing {
namespace {

using std::numbers::pi;

double binomial(double n, int k) {
  double b = 1.0;
  for (int i = 1; i <= k; ++i) b *= (n - k + i) / i;
  return b;
}

/// P_k^(0,beta)(2 s - 1) as a sum of powers.
double jacobi(int k, double beta, double s) {
  double sum = 0.0;
  for (int j = 0; j <= k; ++j)
    sum += ((k - j) % 2 == 0 ? 1.0 : -1.0) * binomial(k, j) * binomial(k + beta + j, k) * std::pow(s, j);
  return sum;
}

/// Z_nlm in spherical coordinates, with 3/(4 pi) * integral of Z^2 = 1.
double zernike(int n, int l, int m, const Vec3& p) {
  const double r = p.norm(), theta = r > 0.0 ? std::acos(p.z() / r) : 0.0, phi = std::atan2(p.y(), p.x());
  const auto a = static_cast<unsigned>(std::abs(m));
  const double sign = a % 2 == 0 ? 1.0 : -1.0;  // of Condon and Shortley, taken out again
  double y = sign * std::sph_legendre(static_cast<unsigned>(l), a, theta);
  if (m > 0) y *= std::sqrt(2.0) * std::cos(m * phi);
  if (m < 0) y *= std::sqrt(2.0) * std::sin(-m * phi);
  const double radial = std::sqrt(2.0 * n + 3.0) * std::pow(r, l) * jacobi((n - l) / 2, l + 0.5, r * r);
  return std::sqrt(4.0 * pi / 3.0) * radial * y;
}

/// Calls visit(p, weight) for nodes that integrate polynomials of degree 9 in each coordinate over a box.
template <class Visit>
void for_each_box_node(const Vec3& low, const Vec3& size, const Visit& visit) {
  const double a = std::sqrt(5.0 - 2.0 * std::sqrt(10.0 / 7.0)) / 3.0;
  const double b = std::sqrt(5.0 + 2.0 * std::sqrt(10.0 / 7.0)) / 3.0;
  const double wa = (322.0 + 13.0 * std::sqrt(70.0)) / 1800.0, wb = (322.0 - 13.0 * std::sqrt(70.0)) / 1800.0;
  const double x[5] = {-b, -a, 0.0, a, b}, w[5] = {wb, wa, 64.0 / 225.0, wa, wb};
  for (int i = 0; i < 5; ++i)
    for (int j = 0; j < 5; ++j)
      for (int k = 0; k < 5; ++k)
        visit(low + 0.5 * (Vec3(x[i], x[j], x[k]) + Vec3::Ones()).cwiseProduct(size),
              w[i] * w[j] * w[k] * size.prod());
}

TEST(ZernikeMoments, BoxVsQuadratureOfTheDefinition) {
  const Vec3 size(0.9, 0.6, 0.4), middle(0.1, -0.05, 0.2);
  const ZernikeMoments moments = compute_solid_moments(box_about(size, middle), {}, 8);
  for (int n = 0; n <= 8; ++n)
    for (int l = n % 2; l <= n; l += 2)
      for (int m = -l; m <= l; ++m) {
        double sum = 0.0;
        for_each_box_node(middle - 0.5 * size, size,
                          [&](const Vec3& p, double weight) { sum += weight * zernike(n, l, m, p); });
        EXPECT_NEAR(moments(n, l, m), 3.0 / (4.0 * pi) * sum, 1e-9) << n << ' ' << l << ' ' << m;
      }
}

TEST(ZernikeMoments, BoxVsClosedForm) {
  const Vec3 size(1.0, 0.7, 0.5);
  const ZernikeMoments moments = compute_solid_moments(box_about(size, Vec3::Zero()), {}, 20);
  const double share = 3.0 / (4.0 * pi) * size.prod();
  const Vec3 second = size.cwiseProduct(size) / 12.0;
  EXPECT_NEAR(moments(0, 0, 0), share, 1e-9);
  EXPECT_NEAR(moments(2, 0, 0), share * std::sqrt(7.0 / 3.0) * 0.5 * (5.0 * second.sum() - 3.0), 1e-9);
  EXPECT_NEAR(moments(2, 2, 0), share * std::sqrt(35.0 / 12.0) * (2.0 * second.z() - second.x() - second.y()),
              1e-9);
  for (int m = -1; m <= 1; ++m) EXPECT_NEAR(moments(1, 1, m), 0.0, 1e-9);
}

/// R_n0(r) is sqrt(2 n + 3) P_(n+1)(r) / r.
double ball_moment(int n, double radius) {
  constexpr int steps = 2000;  // Simpson
  double sum = 0.0;
  for (int i = 0; i <= steps; ++i) {
    const double r = radius * i / steps;
    sum += (i == 0 || i == steps ? 1.0
            : i % 2 == 1         ? 4.0
                                 : 2.0) *
           r * std::legendre(static_cast<unsigned>(n) + 1U, r);
  }
  return std::sqrt(3.0 * (2.0 * n + 3.0)) * sum * radius / (3.0 * steps);
}

TEST(ZernikeMoments, BallVsClosedForm) {
  const double radius = 0.8;
  double last = 0.0;
  for (const int levels : {3, 4}) {
    TriangleMesh mesh = sphere_shape(levels);
    for (Vec3& v : mesh.vertices) v *= radius;
    const ZernikeMoments moments = compute_solid_moments(mesh, {}, 20);
    double error = 0.0;
    for (int n = 0; n <= 20; n += 2)
      error = std::max(error, std::abs(moments(n, 0, 0) - ball_moment(n, radius)));
    if (last > 0.0) {  // the mesh's own: falls with the square of the edge
      EXPECT_NEAR(last / error, 4.0, 0.6);
    }
    last = error;
    for (int l = 1; l <= 20; ++l) EXPECT_NEAR(moments(l, l, 0), 0.0, 5e-3) << l;
  }
  EXPECT_LT(last, 0.02);
}

TEST(ZernikeMoments, OfAnyOrderDoNotDependOnHowTrianglesAreCut) {
  const TriangleMesh coarse = box_about({1.1, 0.9, 0.7}, {0.05, 0.0, -0.1});
  TriangleMesh fine;
  for (std::size_t t = 0; t < coarse.triangles.size(); ++t) {  // in 36
    const Vec3 a = coarse.corner(t, 0), u = (coarse.corner(t, 1) - a) / 6.0,
               v = (coarse.corner(t, 2) - a) / 6.0;
    const auto add = [&](const Vec3& p, const Vec3& q, const Vec3& r) {
      const auto first = static_cast<std::int32_t>(fine.vertices.size());
      fine.vertices.insert(fine.vertices.end(), {p, q, r});
      fine.triangles.push_back({first, first + 1, first + 2});
    };
    for (int i = 0; i < 6; ++i)
      for (int j = 0; i + j < 6; ++j) {
        const Vec3 p = a + i * u + j * v;
        add(p, p + u, p + v);
        if (i + j < 5) add(p + u, p + u + v, p + v);
      }
  }
  const ZernikeMoments low = compute_solid_moments(coarse, {}, 10);
  for (const int order : {10, 20, 30, 40}) {
    const ZernikeMoments a = compute_solid_moments(coarse, {}, order),
                         b = compute_solid_moments(fine, {}, order);
    for (std::size_t i = 0; i < a.values().size(); ++i)
      ASSERT_NEAR(a.values()[i], b.values()[i], 1e-6) << order;
    for (int n = 0; n <= 10; ++n)
      for (int l = n % 2; l <= n; l += 2) EXPECT_NEAR(a(n, l, l), low(n, l, l), 1e-6);
  }
}

TEST(ZernikeMoments, SurfaceOfASphereVsClosedForm) {
  TriangleMesh mesh = sphere_shape(4);
  for (Vec3& v : mesh.vertices) v *= 0.7;
  const ZernikeMoments moments = compute_surface_moments(mesh, {}, 12);
  for (int n = 0; n <= 12; n += 2)
    EXPECT_NEAR(moments(n, 0, 0),
                std::sqrt((2.0 * n + 3.0) / 3.0) * std::legendre(static_cast<unsigned>(n) + 1U, 0.7) / 0.7,
                0.03)
        << n;
}

TEST(TriangleRule, IsExactForPolynomialsVsClosedForm) {
  for (const int side : {1, 2, 5, 11, 21})
    for (int i = 0; i <= 2 * side - 1; ++i) {
      const int j = 2 * side - 1 - i;
      double sum = 0.0, exact = 2.0;  // 2 i! j! / (i + j + 2)!
      for (const auto& node : triangle_rule(side, side).nodes)
        sum += node.weight * std::pow(node.u, i) * std::pow(node.v, j);
      for (int k = 1; k <= j; ++k) exact *= static_cast<double>(k) / (i + k);
      exact /= (i + j + 1.0) * (i + j + 2.0);
      EXPECT_NEAR(sum / exact, 1.0, 1e-10) << side << ' ' << i;
    }
}

TEST(MomentKernel, EveryInstructionSetGivesTheSameBits) {
  using namespace moment_kernel;
  RandomStream stream{7};
  MomentSum usual(20);
  std::vector<Vec3> points;
  for (int i = 0; i < 100; ++i)
    points.emplace_back(stream.uniform(-0.5, 0.5), stream.uniform(-0.5, 0.5), stream.uniform(-0.5, 0.5));
  for (const Vec3& p : points) usual.add(p, 0.3 + p.x());
  const ZernikeMoments expected = usual.moments();
  for (const InstructionSet set : available_instruction_sets()) {
    MomentSum sum(20, set);
    for (const Vec3& p : points) sum.add(p, 0.3 + p.x());
    EXPECT_EQ(sum.moments().values(), expected.values()) << name_of(set);
  }
}

}  // namespace
}  // namespace eigengrasp::testing
