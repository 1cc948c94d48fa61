// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "model_io/yaml_file.hpp"

#include <algorithm>
#include <set>

#include "eigengrasp/core/files.hpp"
#include "model_io/text_values.hpp"

namespace eigengrasp {

YamlValue YamlValue::load(const std::filesystem::path& file) {
  const std::string content = read_text_file(file);
  try {
    const YAML::Node node = YAML::Load(content);
    return YamlValue(std::make_shared<const std::filesystem::path>(file), node, "the file");
  } catch (const YAML::Exception& e) {
    fail_at(file, e.mark.line + 1, "is not well-formed YAML ({})", e.msg);
  }
}

int YamlValue::line() const {
  return node_.Mark().line + 1;
}

std::string YamlValue::written() const {
  if (node_.IsScalar()) return shown(node_.Scalar());
  if (node_.IsMap()) return "a map";
  if (!node_.IsSequence()) return "";
  std::string all;
  for (const YAML::Node& item : node_) {
    all += (all.empty() ? "" : ", ") + (item.IsScalar() ? item.Scalar() : std::string("..."));
    if (all.size() > 60) break;
  }
  return shown("[" + all + "]");
}

std::vector<std::pair<std::string, YamlValue>> YamlValue::fields() const {
  if (!node_.IsMap()) fail("{} is \"{}\", expected a map of keys and values", name_, written());
  std::vector<std::pair<std::string, YamlValue>> result;
  std::set<std::string> seen;
  for (const auto& entry : node_) {
    if (!entry.first.IsScalar()) fail("{} has a key that is not text, expected a name", name_);
    const std::string key = entry.first.Scalar();
    YamlValue value(file_, entry.second, shown(key));
    if (!seen.insert(key).second) value.fail("{} comes twice, expected it once", value.name_);
    result.emplace_back(key, std::move(value));
  }
  return result;
}

std::vector<std::pair<std::string, YamlValue>> YamlValue::fields(
    const std::vector<std::string>& known) const {
  auto result = fields();
  for (const auto& [key, value] : result) {
    if (std::find(known.begin(), known.end(), key) != known.end()) continue;
    value.fail("unknown key \"{}\" in {}, expected one of {}{}", shown(key), name_, join(known),
               did_you_mean(key, known));
  }
  return result;
}

std::optional<YamlValue> YamlValue::find(const std::string& key) const {
  for (auto& [name, value] : fields())
    if (name == key) return value;
  return std::nullopt;
}

YamlValue YamlValue::require(const std::string& key) const {
  auto value = find(key);
  if (!value) fail("{} has no key \"{}\", expected one", name_, key);
  return *value;
}

std::vector<YamlValue> YamlValue::items() const {
  if (!node_.IsSequence()) fail("{} is \"{}\", expected a list", name_, written());
  std::vector<YamlValue> result;
  for (const YAML::Node& item : node_) {
    result.push_back(YamlValue(file_, item, fmt::format("item {} of {}", result.size() + 1, name_)));
  }
  return result;
}

std::string YamlValue::text() const {
  if (!node_.IsScalar() || node_.Scalar().empty()) fail("{} is \"{}\", expected text", name_, written());
  return node_.Scalar();
}

double YamlValue::number() const {
  const auto value = node_.IsScalar() ? parse_number(node_.Scalar()) : std::nullopt;
  if (!value) fail("{} is \"{}\", expected a number", name_, written());
  return *value;
}

std::vector<double> YamlValue::numbers(std::size_t count) const {
  std::vector<double> values;
  if (node_.IsSequence() && node_.size() == count) {
    for (const YAML::Node& item : node_) {
      const auto value = item.IsScalar() ? parse_number(item.Scalar()) : std::nullopt;
      if (value) values.push_back(*value);
    }
  }
  if (values.size() != count) fail("{} is \"{}\", expected a list of {} numbers", name_, written(), count);
  return values;
}

Vec3 YamlValue::vector() const {
  const auto v = numbers(3);
  return Vec3(v[0], v[1], v[2]);
}

Vec3 YamlValue::direction() const {
  const Vec3 v = vector();
  if (v.norm() < 1e-9) fail("{} is \"{}\", expected a direction that is not zero", name_, written());
  return v.normalized();
}

}  // namespace eigengrasp
