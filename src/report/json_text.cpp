// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "json_text.hpp"

#include <algorithm>
#include <stdexcept>
#include <tuple>

namespace eigengrasp {

namespace {

bool is_plain(const OrderedJson& json) {
  return !json.is_array() && !json.is_object();
}

bool on_one_line(const OrderedJson& json) {
  return is_plain(json) || json.empty() ||
         (json.is_array() &&
          std::all_of(json.begin(), json.end(), [](const auto& e) { return is_plain(e); }));
}

std::string scalar_text(const OrderedJson& json) {
  if (json.is_number_float() && !std::isfinite(json.get<double>()))
    throw std::logic_error("a number that is not finite cannot be written");
  return json.dump(-1, ' ', false, OrderedJson::error_handler_t::replace);
}

void append_text(const OrderedJson& json, int depth, std::string& out) {
  if (is_plain(json)) {
    out += scalar_text(json);
    return;
  }
  const bool flat = on_one_line(json);
  const bool object = json.is_object();
  const std::string indent(static_cast<std::size_t>(2 * (depth + 1)), ' ');
  out += object ? '{' : '[';
  bool first = true;
  for (const auto& [key, value] : json.items()) {
    if (!first) out += flat ? ", " : ",";
    first = false;
    if (!flat) out += '\n' + indent;
    if (object) out += OrderedJson(key).dump(-1, ' ', false, OrderedJson::error_handler_t::replace) + ": ";
    append_text(value, depth + 1, out);
  }
  if (!flat) out += '\n' + indent.substr(2);
  out += object ? '}' : ']';
}

/// A value as it is shown in an error.
std::string shown(const OrderedJson& json) {
  if (json.is_object()) return "an object";
  if (json.is_array()) return fmt::format("an array of {}", json.size());
  std::string text = json.dump(-1, ' ', false, OrderedJson::error_handler_t::replace);
  if (text.size() > 60) text = text.substr(0, 57) + "...";
  return text;
}

/// Through a matrix and back a quaternion may change its last digits, for some hundred times at most, until
/// it stays or goes around a small circle. This is the least one (w, x, y, z) of where that ends.
Eigen::Quaterniond lasting_orientation(const Pose& X) {
  constexpr int kLongestWay = 4096;
  constexpr int kLongestCircle = 64;
  const auto next = [](const Eigen::Quaterniond& q) { return orientation(make_pose(q, Vec3::Zero())); };
  const auto less = [](const Eigen::Quaterniond& a, const Eigen::Quaterniond& b) {
    return std::tuple(a.w(), a.x(), a.y(), a.z()) < std::tuple(b.w(), b.x(), b.y(), b.z());
  };
  Eigen::Quaterniond q = orientation(X);
  for (int i = 0; i < kLongestWay; ++i) {
    const Eigen::Quaterniond before = q;
    q = next(q);
    if (q.coeffs() == before.coeffs()) return q;
  }
  Eigen::Quaterniond least = q;
  for (int i = 0; i < kLongestCircle; ++i) {
    q = next(q);
    if (less(q, least)) least = q;
  }
  return least;
}

}  // namespace

std::string pretty_text(const OrderedJson& json) {
  std::string out;
  append_text(json, 0, out);
  return out + '\n';
}

OrderedJson parse_json(std::string_view text, const std::string& name) {
  try {
    return OrderedJson::parse(text);
  } catch (const OrderedJson::parse_error& e) {
    const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(e.byte, text.size()));
    const auto line = 1 + std::count(text.begin(), end, '\n');
    fail("{}:{}: is not JSON from byte {} on; write the file again", name, line, e.byte);
  }
}

void JsonView::refuse(const std::string& expected) const {
  fail("{}: {}: found {}, expected {}", name_, path_.empty() ? "the text" : path_, shown(*json_), expected);
}

bool JsonView::has(const std::string& key) const {
  return json_->is_object() && json_->contains(key);
}

JsonView JsonView::at(const std::string& key) const {
  if (!json_->is_object()) refuse("an object");
  const std::string path = path_.empty() ? key : path_ + '.' + key;
  const auto member = json_->find(key);
  if (member == json_->end()) fail("{}: {}: is missing", name_, path);
  return {*member, name_, path};
}

std::vector<JsonView> JsonView::elements() const {
  if (!json_->is_array()) refuse("an array");
  std::vector<JsonView> views;
  for (std::size_t i = 0; i < json_->size(); ++i)
    views.push_back(JsonView((*json_)[i], name_, fmt::format("{}[{}]", path_, i)));
  return views;
}

std::vector<std::pair<std::string, JsonView>> JsonView::members() const {
  if (!json_->is_object()) refuse("an object");
  std::vector<std::pair<std::string, JsonView>> views;
  for (auto it = json_->begin(); it != json_->end(); ++it)
    views.emplace_back(it.key(), JsonView(it.value(), name_, path_ + '.' + it.key()));
  return views;
}

std::string JsonView::text() const {
  if (!json_->is_string()) refuse("a text");
  return json_->get<std::string>();
}

bool JsonView::boolean() const {
  if (!json_->is_boolean()) refuse("true or false");
  return json_->get<bool>();
}

double JsonView::number() const {
  if (!json_->is_number()) refuse("a number");
  const double value = json_->get<double>();
  if (!std::isfinite(value)) refuse("a finite number");
  return value;
}

double JsonView::number_at_least(double low) const {
  const double value = number();
  if (value < low) refuse(fmt::format("a number of at least {}", low));
  return value;
}

std::int64_t JsonView::integer(std::int64_t low, std::int64_t high) const {
  const auto expected = [&] { return fmt::format("an integer from {} to {}", low, high); };
  if (!json_->is_number_integer()) refuse(expected());
  if (json_->is_number_unsigned() && json_->get<std::uint64_t>() > static_cast<std::uint64_t>(INT64_MAX))
    refuse(expected());
  const auto value = json_->get<std::int64_t>();
  if (value < low || value > high) refuse(expected());
  return value;
}

std::uint64_t JsonView::natural() const {
  if (!json_->is_number_unsigned()) refuse("an integer of at least 0");
  return json_->get<std::uint64_t>();
}

std::vector<std::string> JsonView::texts() const {
  std::vector<std::string> texts;
  for (const JsonView& view : elements()) texts.push_back(view.text());
  return texts;
}

VecX JsonView::numbers(int length) const {
  const std::vector<JsonView> views = elements();
  if (length >= 0 && views.size() != static_cast<std::size_t>(length))
    refuse(fmt::format("an array of {} numbers", length));
  VecX values(static_cast<Eigen::Index>(views.size()));
  for (std::size_t i = 0; i < views.size(); ++i) values[static_cast<Eigen::Index>(i)] = views[i].number();
  return values;
}

Vec3 JsonView::unit_vec3() const {
  const Vec3 v = vec3();
  if (std::abs(v.norm() - 1.0) > 1e-6) refuse("a vector of length 1");
  return v;
}

Pose JsonView::pose() const {
  const JsonView turn = at("orientation");
  const VecX q = turn.numbers(4);
  if (std::abs(q.norm() - 1.0) > 1e-6) turn.refuse("a quaternion [w, x, y, z] of length 1");
  return make_pose({q[0], q[1], q[2], q[3]}, at("position").vec3());
}

OrderedJson pose_json(const Pose& X) {
  const Eigen::Quaterniond q = lasting_orientation(X);
  const Eigen::Vector4d wxyz(q.w(), q.x(), q.y(), q.z());
  return {{"position", numbers_json(X.translation())}, {"orientation", numbers_json(wxyz)}};
}

}  // namespace eigengrasp
