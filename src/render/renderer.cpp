// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <algorithm>
#include <array>
#include <cmath>

#include "eigengrasp/core/error.hpp"
#include "eigengrasp/core/parallel.hpp"
#include "lighting.hpp"

namespace eigengrasp {

namespace {

constexpr int kGrid = 4;        // samples along each side of a pixel
constexpr int kMostLayers = 8;  // translucent surfaces behind each other

Vec3f linear(const Color& color) {
  return {srgb_to_linear(color.r), srgb_to_linear(color.g), srgb_to_linear(color.b)};
}

/// What the centre of a pixel shows.
struct Texel {
  int item = -1;
  float depth = 0.0F;
  Vec3f p_W = Vec3f::Zero();
  Vec3f normal = Vec3f::UnitZ();
  Visibility raw;       ///< as sampled
  Visibility smoothed;  ///< mean of like neighbours
};

/// What a ray sees in front of or through the solids.
struct Layer {
  Vec3f color;
  float opacity;
  int group;
};
struct LayerStack {
  std::array<Layer, kMostLayers> layers;
  int count = 0;
};

/// A pixel's samples.
struct Samples {
  Rays rays;
  std::array<SurfaceHit, kLanes> hits;
  std::array<Vec3f, kLanes> colors;
};

class Renderer {
 public:
  Renderer(const RenderScene& scene, const Camera& camera, const RenderOptions& options)
      : camera_(camera),
        options_(options),
        scene_(scene),
        reach_(0.3 * std::max(1e-6, scene.framed_box().diagonal())),
        lighting_(camera, camera.up, reach_),
        texels_(static_cast<std::size_t>(options.width) * static_cast<std::size_t>(options.height)),
        background_(linear(options.background)) {
    for (const RenderItem& item : scene.items()) albedos_.push_back(linear(item.color));
    const Box box = scene.framed_box();
    if (!box.empty()) {
      const double middle = (box.center() - camera.position).dot(camera.forward);
      nearest_ = static_cast<float>(middle - 0.5 * box.diagonal());
      furthest_ = static_cast<float>(middle + 0.5 * box.diagonal());
    }
    pixel_ = static_cast<float>(2.0 * std::tan(0.5 * camera.fov) / options.height);
    const Vec3 corner = camera.ray_direction(-1.0, 1.0);
    corner_direction_ = corner.cast<float>();
    column_step_ = ((camera.ray_direction(1.0, 1.0) - corner) / options.width).cast<float>();
    row_step_ = ((camera.ray_direction(-1.0, -1.0) - corner) / options.height).cast<float>();
  }

  Image run() {
    const auto rows = static_cast<std::size_t>(options_.height);
    parallel_for(rows, options_.threads, [&](std::size_t y, int) { look(static_cast<int>(y)); });
    parallel_for(rows, options_.threads, [&](std::size_t y, int) { smooth(static_cast<int>(y)); });
    Image image(options_.width, options_.height, options_.background);
    parallel_for(rows, options_.threads, [&](std::size_t y, int) {
      for (int x = 0; x < options_.width; ++x) shade_pixel(x, static_cast<int>(y), image);
    });
    return image;
  }

 private:
  Texel& texel(int x, int y) {
    return texels_[static_cast<std::size_t>(y) * static_cast<std::size_t>(options_.width) +
                   static_cast<std::size_t>(x)];
  }
  bool inside(int x, int y) const { return x >= 0 && y >= 0 && x < options_.width && y < options_.height; }

  /// Unit direction of the ray through a place of the picture [pixel].
  Vec3f direction(float x, float y) const {
    return (corner_direction_ + x * column_step_ + y * row_step_).normalized();
  }

  void look(int y);
  void smooth(int y);
  bool alike(const Texel& a, const Vec3f& p_W, const Vec3f& normal, int item) const;
  Visibility visibility_at(int x, int y, const Vec3f& p_W, const SurfaceHit& hit);
  Vec3f solid_color(int x, int y, const Vec3f& direction, const SurfaceHit& hit);
  void add_layers(Samples& samples) const;
  bool push_layer(LayerStack& stack, const SurfaceHit& hit, const SurfaceHit& solid,
                  const Vec3f& direction) const;
  float outline(const Samples& samples) const;
  void shade_pixel(int x, int y, Image& image);

  const Camera& camera_;
  const RenderOptions& options_;
  RayScene scene_;
  double reach_;
  Lighting lighting_;
  std::vector<Texel> texels_;
  std::vector<Vec3f> albedos_;
  Vec3f background_;
  float nearest_ = 0.0F;
  float furthest_ = 1.0F;
  float pixel_ = 0.0F;      ///< side of a pixel at distance 1
  Vec3f corner_direction_;  ///< of the ray through the upper left corner of the picture
  Vec3f column_step_;       ///< its change from pixel to pixel
  Vec3f row_step_;
};

/// First hits and their visibility in a row.
void Renderer::look(int y) {
  const Vec3f eye = camera_.position.cast<float>();
  for (int x0 = 0; x0 < options_.width; x0 += kLanes) {
    Rays rays;
    std::array<SurfaceHit, kLanes> hits;
    for (int i = 0; i < kLanes; ++i) {
      const auto lane = static_cast<std::size_t>(i);
      rays.origins[lane] = eye;
      rays.directions[lane] = direction(static_cast<float>(x0 + i) + 0.5F, static_cast<float>(y) + 0.5F);
      rays.active[lane] = x0 + i < options_.width;
    }
    scene_.trace_solids(rays, hits);
    for (int i = 0; i < kLanes && x0 + i < options_.width; ++i) {
      const auto lane = static_cast<std::size_t>(i);
      const SurfaceHit& hit = hits[lane];
      if (hit.item < 0) continue;
      Texel& t = texel(x0 + i, y);
      t.item = hit.item;
      t.depth = hit.distance;
      t.p_W = eye + hit.distance * rays.directions[lane];
      t.normal = hit.normal;
      t.raw = lighting_.sample(scene_, t.p_W, hit, x0 + i, y);
    }
  }
}

/// The same smooth piece of surface, seen in a neighbouring pixel.
bool Renderer::alike(const Texel& a, const Vec3f& p_W, const Vec3f& normal, int item) const {
  if (a.item != item || a.normal.dot(normal) < 0.85F) return false;
  return std::abs((a.p_W - p_W).dot(normal)) < 3.0F * pixel_ * a.depth;
}

/// Mean over 5 x 5 pixels with weights (1, 2, 2, 2, 1): each pixel of the pattern's block counts alike.
void Renderer::smooth(int y) {
  constexpr std::array<float, 5> weights = {1.0F, 2.0F, 2.0F, 2.0F, 1.0F};
  for (int x = 0; x < options_.width; ++x) {
    Texel& t = texel(x, y);
    if (t.item < 0) continue;
    float sum = 0.0F;
    Visibility mean{0.0F, 0.0F};
    for (int dy = -2; dy <= 2; ++dy) {
      for (int dx = -2; dx <= 2; ++dx) {
        if (!inside(x + dx, y + dy)) continue;
        const Texel& other = texel(x + dx, y + dy);
        if (!alike(other, t.p_W, t.normal, t.item)) continue;
        const float w = weights[static_cast<std::size_t>(dx + 2)] * weights[static_cast<std::size_t>(dy + 2)];
        sum += w;
        mean.ambient += w * other.raw.ambient;
        mean.key += w * other.raw.key;
      }
    }
    t.smoothed = {mean.ambient / sum, mean.key / sum};
  }
}

/// From the pixel itself or a like neighbour, else sampled anew.
Visibility Renderer::visibility_at(int x, int y, const Vec3f& p_W, const SurfaceHit& hit) {
  constexpr std::array<std::array<int, 2>, 9> places = {
      {{0, 0}, {-1, 0}, {1, 0}, {0, -1}, {0, 1}, {-1, -1}, {1, -1}, {-1, 1}, {1, 1}}};
  for (const auto& [dx, dy] : places) {
    if (!inside(x + dx, y + dy)) continue;
    const Texel& t = texel(x + dx, y + dy);
    if (alike(t, p_W, hit.normal, hit.item)) return t.smoothed;
  }
  return lighting_.sample(scene_, p_W, hit, x, y);
}

Vec3f Renderer::solid_color(int x, int y, const Vec3f& direction, const SurfaceHit& hit) {
  const RenderItem& item = scene_.item(hit.item);
  const Vec3f p_W = camera_.position.cast<float>() + hit.distance * direction;
  const Visibility seen = visibility_at(x, y, p_W, hit);
  if (item.shadow_only) return background_ * (0.35F + 0.65F * (0.6F * seen.ambient + 0.4F * seen.key));
  const Vec3f& albedo = albedos_[static_cast<std::size_t>(hit.item)];
  Vec3f color = lighting_.shade(albedo, hit.normal, -direction, seen);
  const float depth = std::clamp((hit.distance - nearest_) / (furthest_ - nearest_), 0.0F, 1.0F);
  color += static_cast<float>(options_.depth_cue) * depth * (background_ - color);
  if (item.fade_radius > 0.0) {
    const double r = (p_W.cast<double>() - item.fade_center_W).norm() / item.fade_radius;
    const auto s = static_cast<float>(std::clamp(2.0 * r - 1.0, 0.0, 1.0));
    color += s * s * (3.0F - 2.0F * s) * (background_ - color);
  }
  return color;
}

/// Lays translucent surfaces and markers over the solid colours.
void Renderer::add_layers(Samples& samples) const {
  Rays rays = samples.rays;
  std::array<SurfaceHit, kLanes> hits;
  scene_.trace_layers(rays, hits);
  if (std::none_of(hits.begin(), hits.end(), [](const SurfaceHit& hit) { return hit.item >= 0; })) return;
  std::array<LayerStack, kLanes> stacks;
  for (bool any = true; any; scene_.trace_layers(rays, hits)) {
    any = false;
    for (std::size_t i = 0; i < kLanes; ++i) {
      if (!rays.active[i]) continue;
      rays.active[i] =
          hits[i].item >= 0 && push_layer(stacks[i], hits[i], samples.hits[i], rays.directions[i]);
      rays.near[i] = hits[i].distance * (1.0F + 1e-5F);
      any = any || rays.active[i];
    }
    if (!any) break;
  }
  for (std::size_t i = 0; i < kLanes; ++i)
    for (int k = stacks[i].count - 1; k >= 0; --k) {
      const Layer& layer = stacks[i].layers[static_cast<std::size_t>(k)];
      samples.colors[i] += layer.opacity * (layer.color - samples.colors[i]);
    }
}

/// Adds a hit to the layers before it, nearest first; returns whether anything may be seen behind it.
bool Renderer::push_layer(LayerStack& stack, const SurfaceHit& hit, const SurfaceHit& solid,
                          const Vec3f& direction) const {
  const RenderItem& item = scene_.item(hit.item);
  const bool behind = solid.item >= 0 && hit.distance > solid.distance;
  const float opacity = item.color.a * (behind ? static_cast<float>(item.see_through) : 1.0F);
  for (int k = 0; k < stack.count; ++k)
    if (item.group >= 0 && stack.layers[static_cast<std::size_t>(k)].group == item.group) return true;
  if (opacity <= 0.0F) return true;
  const Vec3f& albedo = albedos_[static_cast<std::size_t>(hit.item)];
  stack.layers[static_cast<std::size_t>(stack.count++)] = {
      lighting_.shade_marker(albedo, hit.normal, -direction), opacity, item.group};
  return opacity < 1.0F && stack.count < kMostLayers;
}

/// Largest where half of the pixel's samples see another surface than the first one: a line along
/// silhouettes. What fades into the background counts as background.
float Renderer::outline(const Samples& samples) const {
  std::array<int, kLanes> items;
  for (std::size_t i = 0; i < kLanes; ++i) {
    items[i] = samples.hits[i].item;
    if (items[i] < 0) continue;
    const RenderItem& item = scene_.item(items[i]);
    if (item.fade_radius > 0.0 || item.shadow_only) items[i] = -1;
  }
  const float first = samples.hits[0].distance;
  int same = 0;
  for (std::size_t i = 0; i < kLanes; ++i) {
    const bool near = std::abs(samples.hits[i].distance - first) < 12.0F * pixel_ * first;
    same += items[i] == items[0] && (items[i] < 0 || near) ? 1 : 0;
  }
  const float share = static_cast<float>(same) / kLanes;
  return 4.0F * share * (1.0F - share);
}

void Renderer::shade_pixel(int x, int y, Image& image) {
  Samples samples;
  const Vec3f eye = camera_.position.cast<float>();
  for (int i = 0; i < kLanes; ++i) {
    const auto lane = static_cast<std::size_t>(i);
    samples.rays.origins[lane] = eye;
    const int row = i / kGrid;
    const float dx = (static_cast<float>(i % kGrid) + 0.5F) / kGrid;
    const float dy = (static_cast<float>(row) + 0.5F) / kGrid;
    samples.rays.directions[lane] = direction(static_cast<float>(x) + dx, static_cast<float>(y) + dy);
  }
  scene_.trace_solids(samples.rays, samples.hits);
  const auto n_hits = std::count_if(samples.hits.begin(), samples.hits.end(),
                                    [](const SurfaceHit& hit) { return hit.item >= 0; });
  if (n_hits == 0 && !scene_.has_layers()) return;
  const auto lines = static_cast<float>(options_.outline);
  const float tone = n_hits > 0 && lines > 0.0F ? 1.0F - lines * outline(samples) : 1.0F;
  for (std::size_t i = 0; i < kLanes; ++i) {
    const SurfaceHit& hit = samples.hits[i];
    samples.colors[i] =
        hit.item < 0 ? background_ : tone * solid_color(x, y, samples.rays.directions[i], hit);
  }
  if (scene_.has_layers()) add_layers(samples);
  Vec3f mean = Vec3f::Zero();
  for (const Vec3f& color : samples.colors) mean += color.cwiseMin(1.0F);
  float* out = image.pixel(x, y);
  for (int k = 0; k < 3; ++k) out[k] = mean[k] / kLanes;
  out[3] = 1.0F;
}

}  // namespace

Image render(const RenderScene& scene, const Camera& camera, const RenderOptions& options) {
  constexpr int kLargest = 16384;
  if (options.width < 1 || options.height < 1 || options.width > kLargest || options.height > kLargest)
    fail("a picture of {} x {} pixels, expected sides of 1 to {}", options.width, options.height, kLargest);
  return Renderer(scene, camera, options).run();
}

}  // namespace eigengrasp
