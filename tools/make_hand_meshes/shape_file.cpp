// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "shape_file.hpp"

#include <yaml-cpp/yaml.h>

#include <set>

#include "eigengrasp/core/error.hpp"
#include "eigengrasp/modeling/loft.hpp"
#include "eigengrasp/modeling/operations.hpp"
#include "eigengrasp/modeling/primitives.hpp"

namespace eigengrasp::shapes {
namespace {

using modeling::LoftSection;
using modeling::Solid;

double radians(double degrees) {
  return degrees * std::acos(-1.0) / 180;
}

/// The body with a part added to it, taken off it, or the two where they overlap.
Solid joined(const Solid& body, const Solid& part, const std::string& op, double blend) {
  const bool sharp = blend <= 0;
  if (op == "add") return sharp ? modeling::unite(body, part) : modeling::smooth_unite(body, part, blend);
  if (op == "subtract")
    return sharp ? modeling::subtract(body, part) : modeling::smooth_subtract(body, part, blend);
  return sharp ? modeling::intersect(body, part) : modeling::smooth_intersect(body, part, blend);
}

/// Reads one file; every complaint names the file and the line.
class Reader {
 public:
  explicit Reader(const std::filesystem::path& file) : file_(file) {}

  std::vector<ShapeRecipe> read() {
    YAML::Node root;
    try {
      root = YAML::LoadFile(file_.string());
    } catch (const YAML::BadFile&) {
      fail("{}: cannot be read", file_.string());
    } catch (const YAML::ParserException& e) {
      fail_at(file_, e.mark.line + 1, "{}", e.msg);
    }
    if (!root["format"] || root["format"].as<std::string>() != "eigengrasp-shapes") {
      fail_at(file_, 1, "'format' must be eigengrasp-shapes");
    }
    if (!root["meshes"] || !root["meshes"].IsMap()) fail_at(file_, 1, "'meshes' is missing");
    std::vector<ShapeRecipe> recipes;
    for (const auto& entry : root["meshes"]) recipes.push_back(recipe(entry.first, entry.second));
    return recipes;
  }

 private:
  template <typename... Args>
  [[noreturn]] void complain(const YAML::Node& node, fmt::format_string<Args...> format,
                             Args&&... args) const {
    fail_at(file_, node.Mark().line + 1, format, std::forward<Args>(args)...);
  }

  void allow(const YAML::Node& node, const std::set<std::string>& keys) const {
    if (!node.IsMap()) complain(node, "expected keys and values");
    for (const auto& entry : node) {
      const auto key = entry.first.as<std::string>();
      if (!keys.contains(key)) complain(entry.first, "unknown key '{}'", key);
    }
  }

  double number(const YAML::Node& node) const {
    double value = 0.0;
    if (!node.IsScalar() || !YAML::convert<double>::decode(node, value)) complain(node, "expected a number");
    return value;
  }

  double number(const YAML::Node& parent, const char* key, double fallback) const {
    return parent[key] ? number(parent[key]) : fallback;
  }

  double required(const YAML::Node& parent, const char* key) const {
    if (!parent[key]) complain(parent, "'{}' is missing", key);
    return number(parent[key]);
  }

  std::vector<double> numbers(const YAML::Node& parent, const char* key, std::size_t count) const {
    if (!parent[key]) complain(parent, "'{}' is missing", key);
    const YAML::Node node = parent[key];
    if (!node.IsSequence() || node.size() != count) complain(node, "'{}' needs {} numbers", key, count);
    std::vector<double> values;
    for (const auto& n : node) values.push_back(number(n));
    return values;
  }

  Vec3 vec3(const YAML::Node& parent, const char* key) const {
    const std::vector<double> v = numbers(parent, key, 3);
    return {v[0], v[1], v[2]};
  }

  Pose pose(const YAML::Node& part) const {
    Pose X = Pose::Identity();
    if (part["xyz"]) X.translation() = vec3(part, "xyz");
    if (part["rpy_deg"]) {
      const Vec3 rpy = vec3(part, "rpy_deg").unaryExpr(&radians);
      X.linear() = (Eigen::AngleAxisd(rpy.z(), Vec3::UnitZ()) * Eigen::AngleAxisd(rpy.y(), Vec3::UnitY()) *
                    Eigen::AngleAxisd(rpy.x(), Vec3::UnitX()))
                       .toRotationMatrix();
    }
    return X;
  }

  LoftSection section(const YAML::Node& node) const {
    allow(node, {"at", "y", "z", "center", "power", "roll_deg"});
    const std::vector<double> y = numbers(node, "y", 2);
    const std::vector<double> z = numbers(node, "z", 2);
    LoftSection s;
    s.at = required(node, "at");
    s.lo = {y[0], z[0]};
    s.hi = {y[1], z[1]};
    s.center = 0.5 * (s.lo + s.hi);
    if (node["center"]) {
      const std::vector<double> c = numbers(node, "center", 2);
      s.center = {c[0], c[1]};
    }
    s.power = number(node, "power", 2.0);
    s.roll = radians(number(node, "roll_deg", 0.0));
    if ((s.lo.array() >= s.center.array()).any() || (s.center.array() >= s.hi.array()).any() || s.power < 1) {
      complain(node, "a section needs lower < centre < upper and a power of at least 1");
    }
    return s;
  }

  Solid loft(const YAML::Node& node) const {
    allow(node, {"sections", "caps"});
    if (!node["sections"] || node["sections"].size() < 2) complain(node, "a loft needs two sections or more");
    std::vector<LoftSection> sections;
    for (const auto& n : node["sections"]) {
      sections.push_back(section(n));
      if (sections.size() > 1 && sections.back().at <= sections[sections.size() - 2].at) {
        complain(n, "'at' must ascend");
      }
    }
    const std::vector<double> caps = numbers(node, "caps", 2);
    if (caps[0] <= 0 || caps[1] <= 0) complain(node["caps"], "'caps' must be positive");
    return modeling::loft(sections, {caps[0], caps[1]});
  }

  Solid plate(const YAML::Node& node) const {
    allow(node, {"outline", "height", "round"});
    modeling::Polyline outline;
    for (const auto& p : node["outline"]) {
      if (!p.IsSequence() || p.size() != 2) complain(p, "a corner needs 2 numbers");
      outline.push_back({number(p[0]), number(p[1])});
    }
    if (outline.size() < 3) complain(node, "'outline' needs three corners or more");
    const double half = 0.5 * required(node, "height");
    return modeling::extrude(outline, -half, half, number(node, "round", 0.0));
  }

  Solid capsule(const YAML::Node& node) const {
    allow(node, {"from", "to", "radius", "radii"});
    const Vec3 from = vec3(node, "from");
    const Vec3 to = vec3(node, "to");
    if ((from - to).norm() < 1e-9) complain(node, "'from' and 'to' are the same point");
    if (!node["radii"]) return modeling::capsule(from, to, required(node, "radius"));
    const std::vector<double> radii = numbers(node, "radii", 2);
    return modeling::round_cone(from, radii[0], to, radii[1]);
  }

  Solid primitive(const YAML::Node& part) const {
    allow(part, {"box", "cylinder", "capsule", "ellipsoid", "plate", "loft", "group", "xyz", "rpy_deg", "op",
                 "blend"});
    if (const YAML::Node n = part["box"]) {
      allow(n, {"size", "round"});
      return modeling::rounded_box(Vec3::Zero(), vec3(n, "size"), number(n, "round", 0.0));
    }
    if (const YAML::Node n = part["cylinder"]) {
      allow(n, {"radius", "height", "round"});
      const Vec3 top = 0.5 * required(n, "height") * Vec3::UnitZ();
      return modeling::cylinder(-top, top, required(n, "radius"), number(n, "round", 0.0));
    }
    if (const YAML::Node n = part["ellipsoid"]) {
      allow(n, {"radii"});
      return modeling::ellipsoid(Vec3::Zero(), vec3(n, "radii"));
    }
    if (part["capsule"]) return capsule(part["capsule"]);
    if (part["plate"]) return plate(part["plate"]);
    if (part["loft"]) return loft(part["loft"]);
    if (part["group"]) return parts(part["group"]);
    complain(part, "a part needs one of box, cylinder, capsule, ellipsoid, plate, loft, group");
  }

  /// The parts from top to bottom, each joined to what stands before it.
  Solid parts(const YAML::Node& node) const {
    if (!node.IsSequence() || node.size() == 0) complain(node, "expected a list of parts");
    Solid body;
    for (const auto& part : node) {
      const Solid piece = modeling::move(primitive(part), pose(part));
      const auto op = part["op"] ? part["op"].as<std::string>() : std::string("add");
      if (op != "add" && op != "subtract" && op != "intersect")
        complain(part["op"], "'op' is {}, must be add, subtract or intersect", op);
      body = body.distance ? joined(body, piece, op, number(part, "blend", 0.0)) : piece;
    }
    return body;
  }

  ShapeRecipe recipe(const YAML::Node& name, const YAML::Node& node) const {
    allow(node, {"cell", "triangles", "parts"});
    ShapeRecipe r;
    r.name = name.as<std::string>();
    r.cell = number(node, "cell", r.cell);
    r.triangles = static_cast<std::size_t>(number(node, "triangles", static_cast<double>(r.triangles)));
    if (!node["parts"]) complain(name, "'parts' is missing");
    r.solid = parts(node["parts"]);
    if (r.cell < 1e-4) complain(node, "'cell' is {} m, must be at least 0.0001", r.cell);
    return r;
  }

  std::filesystem::path file_;
};

}  // namespace

std::vector<ShapeRecipe> load_shapes(const std::filesystem::path& file) {
  return Reader(file).read();
}

}  // namespace eigengrasp::shapes
