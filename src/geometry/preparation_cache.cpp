// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// A file: magic, version and mark of the byte order, size of the rest, checksum of the rest, then the key and
// the values.
#include "eigengrasp/geometry/preparation_cache.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <type_traits>

#include "eigengrasp/core/content_hash.hpp"
#include "eigengrasp/core/error.hpp"
#include "eigengrasp/core/files.hpp"
#include "eigengrasp/geometry/ball_cover.hpp"

namespace eigengrasp {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view magic = "eigengrasp cache";
// To be raised whenever the same mesh and options give other values, or the files another layout.
constexpr std::uint32_t version = 2;
constexpr std::uint32_t byte_order = 0x01020304;
constexpr const char* ending = ".cache";

template <typename T>
void put(std::string& bytes, const T& value) {
  static_assert(std::is_trivially_copyable_v<T>);
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

void put(std::string& bytes, const Vec3& v) {
  for (Eigen::Index k = 0; k < 3; ++k) put(bytes, v[k]);
}

/// Takes values off the front; false from the first one on that is not all there.
class Reader {
 public:
  explicit Reader(std::string_view bytes) : bytes_(bytes) {}

  template <typename T>
  bool take(T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    return take_bytes(reinterpret_cast<char*>(&value), sizeof value);
  }
  bool take(Vec3& v) { return take(v[0]) && take(v[1]) && take(v[2]) && v.allFinite(); }
  bool take_bytes(char* to, std::size_t size) {
    if (size > bytes_.size()) return false;
    std::memcpy(to, bytes_.data(), size);
    bytes_.remove_prefix(size);
    return true;
  }
  bool take_text(std::string_view expected) {
    if (!bytes_.starts_with(expected)) return false;
    bytes_.remove_prefix(expected.size());
    return true;
  }
  std::string_view rest() const { return bytes_; }

 private:
  std::string_view bytes_;
};

std::string pack(const std::string& key, const std::string& payload) {
  std::string rest;
  put(rest, static_cast<std::uint64_t>(key.size()));
  rest += key;
  rest += payload;
  std::string file(magic);
  put(file, version);
  put(file, byte_order);
  put(file, static_cast<std::uint64_t>(rest.size()));
  file += content_hash(rest);
  file += rest;
  return file;
}

std::optional<std::string> unpack(const std::string& key, const std::string& file) {
  Reader reader(file);
  std::uint32_t its_version = 0;
  std::uint32_t its_order = 0;
  std::uint64_t size = 0;
  if (!reader.take_text(magic) || !reader.take(its_version) || its_version != version ||
      !reader.take(its_order) || its_order != byte_order || !reader.take(size))
    return {};
  constexpr std::size_t digits = 32;
  if (reader.rest().size() < digits || reader.rest().size() - digits != size) return {};
  const std::string_view checksum = reader.rest().substr(0, digits);
  if (content_hash(reader.rest().substr(digits)) != checksum) return {};
  std::uint64_t key_size = 0;
  if (!reader.take_text(checksum) || !reader.take(key_size) || key_size != key.size() ||
      !reader.take_text(key))
    return {};
  return std::string(reader.rest());
}

void put_grid(std::string& bytes, const FieldGrid& grid) {
  put(bytes, grid.origin);
  put(bytes, grid.cell);
  for (Eigen::Index k = 0; k < 3; ++k) put(bytes, static_cast<std::int32_t>(grid.nodes[k]));
  bytes.append(reinterpret_cast<const char*>(grid.values.data()), grid.values.size() * sizeof(float));
}

bool take_grid(Reader& reader, FieldGrid& grid) {
  std::size_t count = 1;
  if (!reader.take(grid.origin) || !reader.take(grid.cell) || !(grid.cell > 0.0)) return false;
  for (Eigen::Index k = 0; k < 3; ++k) {
    std::int32_t nodes = 0;
    if (!reader.take(nodes) || nodes < 2 || nodes > 100000) return false;
    grid.nodes[k] = nodes;
    count *= static_cast<std::size_t>(nodes);
  }
  if (count > reader.rest().size() / sizeof(float)) return false;
  grid.values.resize(count);
  return reader.take_bytes(reinterpret_cast<char*>(grid.values.data()), count * sizeof(float));
}

std::optional<DistanceField::Grids> grids_of(const std::string& payload) {
  DistanceField::Grids grids;
  Reader reader(payload);
  if (!take_grid(reader, grids.fine) || !take_grid(reader, grids.coarse) || !reader.rest().empty()) return {};
  return grids;
}

std::optional<std::vector<Sphere>> unpacked_spheres(const std::string& payload) {
  Reader reader(payload);
  std::vector<Sphere> spheres(payload.size() / (4 * sizeof(double)));
  for (Sphere& s : spheres)
    if (!reader.take(s.center) || !reader.take(s.radius)) return {};
  if (!reader.rest().empty()) return {};
  return spheres;
}

}  // namespace

PreparationCache::PreparationCache(PreparationCacheOptions options) : options_(std::move(options)) {}

DistanceField PreparationCache::object_field(const ObjectModel& object, const DistanceFieldOptions& options) {
  if (object.content_key.empty()) return field(object.mesh, object.bvh, options);
  return field_of(object.content_key, object.unscaled_bvh(), options).scaled(object.scale);
}

DistanceField PreparationCache::field(const TriangleMesh& mesh, const MeshBvh& bvh,
                                      const DistanceFieldOptions& options) {
  return field_of(content_key_of(mesh), bvh, options);
}

DistanceField PreparationCache::field_of(const std::string& content_key, const MeshBvh& bvh,
                                         const DistanceFieldOptions& o) {
  if (bvh.empty()) return {};
  const std::string key =
      fmt::format("field {} cell {:a} margins {:a} {:a} region {:a} {:a} {:a} {:a} {:a} {:a}", content_key,
                  o.cell, o.margin, o.far_margin, o.region.min.x(), o.region.min.y(), o.region.min.z(),
                  o.region.max.x(), o.region.max.y(), o.region.max.z());
  {
    const std::scoped_lock lock(mutex_);
    if (const auto found = in_use_.find(key); found != in_use_.end())
      if (auto grids = found->second.lock()) return DistanceField(std::move(grids));
  }
  std::shared_ptr<const DistanceField::Grids> grids;
  if (const auto payload = read(key))
    if (auto found = grids_of(*payload))
      grids = std::make_shared<const DistanceField::Grids>(*std::move(found));
  if (!grids) {
    grids = DistanceField(bvh, o).grids();
    std::string payload;
    put_grid(payload, grids->fine);
    put_grid(payload, grids->coarse);
    write(key, payload);
  }
  const std::scoped_lock lock(mutex_);
  in_use_[key] = grids;
  return DistanceField(std::move(grids));
}

std::vector<Sphere> PreparationCache::inner_spheres(const TriangleMesh& mesh, const MeshBvh& bvh,
                                                    double tolerance) {
  return spheres_of(fmt::format("inner spheres {} tolerance {:a}", content_key_of(mesh), tolerance),
                    [&] { return cover_with_inner_spheres(mesh, bvh, tolerance); });
}

std::vector<Sphere> PreparationCache::holding_spheres(const TriangleMesh& mesh, const MeshBvh& bvh,
                                                      double tolerance) {
  return spheres_of(fmt::format("holding spheres {} tolerance {:a}", content_key_of(mesh), tolerance),
                    [&] { return grow_to_hold(bvh, inner_spheres(mesh, bvh, tolerance)); });
}

std::vector<Sphere> PreparationCache::spheres_of(const std::string& key,
                                                 const std::function<std::vector<Sphere>()>& make) {
  if (const auto payload = read(key))
    if (auto spheres = unpacked_spheres(*payload)) return *std::move(spheres);
  std::vector<Sphere> spheres = make();
  std::string payload;
  for (const Sphere& s : spheres) {
    put(payload, s.center);
    put(payload, s.radius);
  }
  write(key, payload);
  return spheres;
}

fs::path PreparationCache::file_of(const std::string& key) const {
  return options_.folder / (content_hash(key) + ending);
}

std::optional<std::string> PreparationCache::read(const std::string& key) const {
  if (options_.folder.empty()) return {};
  const fs::path file = file_of(key);
  std::error_code ec;
  if (!fs::is_regular_file(file, ec)) return {};
  try {
    std::optional<std::string> payload = unpack(key, read_text_file(file));
    if (payload) fs::last_write_time(file, fs::file_time_type::clock::now(), ec);  // used just now
    return payload;
  } catch (const Error&) {
    return {};  // not readable, or gone since
  }
}

void PreparationCache::write(const std::string& key, const std::string& payload) {
  if (options_.folder.empty()) return;
  const std::string content = pack(key, payload);
  if (content.size() > options_.max_bytes) return;
  try {
    write_file_atomically(file_of(key), content);
  } catch (const Error& error) {
    const std::scoped_lock lock(mutex_);
    if (!std::exchange(told_, true) && options_.log)
      options_.log(fmt::format("what was prepared is not kept for the next time: {}", error.what()));
    return;
  }
  remove_oldest();
}

void PreparationCache::remove_oldest() const {
  struct File {
    fs::path path;
    fs::file_time_type used;
    std::uintmax_t bytes = 0;
  };
  std::vector<File> files;
  std::uintmax_t total = 0;
  std::error_code ec;
  for (fs::directory_iterator entry(options_.folder, ec), end; !ec && entry != end; entry.increment(ec)) {
    const std::string name = entry->path().filename().string();
    if (name.find(ending) == std::string::npos) continue;  // with what an interrupted writer left
    std::error_code gone;
    const File file{entry->path(), entry->last_write_time(gone), entry->file_size(gone)};
    if (gone) continue;
    total += file.bytes;
    files.push_back(file);
  }
  std::sort(files.begin(), files.end(), [](const File& a, const File& b) { return a.used < b.used; });
  for (const File& file : files) {
    if (total <= options_.max_bytes) return;
    if (fs::remove(file.path, ec)) total -= file.bytes;
  }
}

fs::path user_cache_folder() {
  const auto variable = [](const char* name) {
    const char* value = std::getenv(name);
    return std::string(value != nullptr ? value : "");
  };
  const std::string own = variable("EIGENGRASP_CACHE");
  if (own == "off") return {};
  if (!own.empty()) return own;
  const fs::path xdg = variable("XDG_CACHE_HOME");
  if (xdg.is_absolute()) return xdg / "eigengrasp";
  const fs::path home = variable("HOME");
  return home.is_absolute() ? home / ".cache" / "eigengrasp" : fs::path();
}

DistanceField make_object_field(const ObjectModel& object, const DistanceFieldOptions& options,
                                PreparationCache* cache) {
  if (cache != nullptr) return cache->object_field(object, options);
  return DistanceField(object.unscaled_bvh(), options).scaled(object.scale);
}

}  // namespace eigengrasp
