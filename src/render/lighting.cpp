// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "lighting.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "eigengrasp/contact/contact_point.hpp"

namespace eigengrasp {

namespace {

constexpr int kAmbientRays = 10;     // the other lanes look for the key light
constexpr float kKeyRadius = 0.13F;  // tangent of the half angle under which the light is seen
constexpr float kPi = std::numbers::pi_v<float>;

/// Order in which the pixels of a 4 x 4 block take their share of the pattern: neighbours far apart.
constexpr std::array<int, 16> kBlockOrder = {0, 8, 2, 10, 12, 4, 14, 6, 3, 11, 1, 9, 15, 7, 13, 5};

/// Point i of the R2 sequence (Roberts 2018), in [0, 1)^2.
std::array<float, 2> r2_point(int i) {
  const double a = 0.7548776662466927 * (i + 1);
  const double b = 0.5698402909980532 * (i + 1);
  return {static_cast<float>(a - std::floor(a)), static_cast<float>(b - std::floor(b))};
}

using Pattern = std::array<Vec3f, 16 * kLanes>;

/// Directions for z up: cosine-weighted over the hemisphere in the ambient lanes of each pixel of the block,
/// discs of radius kKeyRadius in its other lanes.
Pattern make_pattern() {
  Pattern pattern;
  for (int block = 0; block < 16; ++block) {
    for (int lane = 0; lane < kLanes; ++lane) {
      const bool ambient = lane < kAmbientRays;
      const int order = kBlockOrder[static_cast<std::size_t>(block)];
      // Ambient point: of a sequence over the whole block, strided so that each pixel covers the sky.
      const auto [u, v] =
          ambient ? r2_point(lane * 16 + order) : r2_point(1000 + (lane - kAmbientRays) * 16 + order);
      const float r = std::sqrt(u);
      const float angle = 2.0F * kPi * v;
      const float z = ambient ? std::sqrt(std::max(0.0F, 1.0F - u)) : 1.0F;
      const float radius = ambient ? r : kKeyRadius * r;
      pattern[static_cast<std::size_t>(block * kLanes + lane)] =
          Vec3f(radius * std::cos(angle), radius * std::sin(angle), z);
    }
  }
  return pattern;
}

std::array<Vec3f, 2> tangents(const Vec3f& n) {
  const auto [t1, t2] = contact_tangents(n.cast<double>().normalized());
  return {t1.cast<float>(), t2.cast<float>()};
}

}  // namespace

Lighting::Lighting(const Camera& camera, const Vec3& sky_W, double reach_m)
    : sky_(sky_W.cast<float>()), reach_(static_cast<float>(reach_m)) {
  const Vec3 back = -camera.forward;
  key_ = (-0.55 * camera.right() + 0.75 * camera.up + 0.65 * back).normalized().cast<float>();
  fill_ = (0.85 * camera.right() + 0.15 * camera.up + 0.6 * back).normalized().cast<float>();
  key_tangents_ = tangents(key_);
}

Visibility Lighting::sample(const RayScene& scene, const Vec3f& p_W, const SurfaceHit& hit, int x,
                            int y) const {
  static const Pattern pattern = make_pattern();
  const auto block = static_cast<std::size_t>((y & 3) * 4 + (x & 3));
  const auto [t1, t2] = tangents(hit.normal);
  const Vec3f origin = p_W + 2e-4F * reach_ * hit.geometric;
  Rays rays;
  for (std::size_t i = 0; i < kLanes; ++i) {
    const Vec3f& d = pattern[block * kLanes + i];
    const bool ambient = i < kAmbientRays;
    rays.directions[i] = ambient ? Vec3f(d.x() * t1 + d.y() * t2 + d.z() * hit.normal)
                                 : Vec3f(key_ + d.x() * key_tangents_[0] + d.y() * key_tangents_[1]);
    rays.origins[i] = origin;
    if (ambient) rays.far[i] = reach_;
    rays.active[i] = rays.directions[i].dot(hit.geometric) > 0.0F;
  }
  const auto hidden = scene.occluded(rays);
  int open = 0;
  int lit = 0;
  for (std::size_t i = 0; i < kLanes; ++i) {
    const bool free = rays.active[i] && !hidden[i];
    if (i < kAmbientRays)
      open += free ? 1 : 0;
    else
      lit += free ? 1 : 0;
  }
  return {static_cast<float>(open) / kAmbientRays, static_cast<float>(lit) / (kLanes - kAmbientRays)};
}

Vec3f Lighting::shade(const Vec3f& albedo, const Vec3f& normal, const Vec3f& to_viewer,
                      const Visibility& seen) const {
  const float key = std::max(0.0F, normal.dot(key_)) * seen.key;
  const float fill = std::max(0.0F, 0.6F * normal.dot(fill_) + 0.4F);
  const float sky = 0.5F + 0.5F * normal.dot(sky_);
  const float ambient = (0.26F + 0.16F * sky + 0.18F * fill) * seen.ambient;
  const Vec3f half = (key_ + to_viewer).normalized();
  const float facing = normal.dot(half);
  const float gloss = facing > 0.8F ? 0.07F * std::pow(facing, 36.0F) * seen.key : 0.0F;
  // The key light is a little warm, the sky a little cool.
  const Vec3f light = 0.72F * key * Vec3f(1.02F, 1.0F, 0.97F) + ambient * Vec3f(0.98F, 1.0F, 1.03F);
  return albedo.cwiseProduct(light) + Vec3f::Constant(gloss);
}

Vec3f Lighting::shade_marker(const Vec3f& albedo, const Vec3f& normal, const Vec3f& to_viewer) const {
  const float facing = std::max(0.0F, normal.dot(to_viewer));
  const float key = std::max(0.0F, normal.dot(key_));
  return albedo * (0.45F + 0.25F * facing + 0.35F * key);
}

}  // namespace eigengrasp
