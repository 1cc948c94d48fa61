// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "database/grasp_blob.hpp"

#include <bit>
#include <cstring>

#include "eigengrasp/core/error.hpp"

namespace eigengrasp {

static_assert(std::endian::native == std::endian::little, "grasps are stored as they lie in memory");

namespace {

constexpr std::uint8_t kLayout = 1;
constexpr std::uint16_t kSpelledOut = 0xFFFF;

class Writer {
 public:
  explicit Writer(const StoredHand& hand) : hand_(hand) { bytes_.reserve(2048); }

  template <typename T>
  void plain(T value) {
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  void numbers(const double* data, Eigen::Index n) {
    bytes_.append(reinterpret_cast<const char*>(data), static_cast<std::size_t>(n) * sizeof(double));
  }
  void text(const std::string& s) {
    plain(static_cast<std::uint32_t>(s.size()));
    bytes_.append(s);
  }
  /// An index into the joints and then the links of the hand; guess is where the name is likely to stand.
  void name(const std::string& s, std::size_t guess) {
    const std::size_t n = hand_.joints.size() + hand_.links.size();
    if (guess < n && known(guess) == s) return plain(static_cast<std::uint16_t>(guess));
    for (std::size_t i = 0; i < n && i < kSpelledOut; ++i)
      if (known(i) == s) return plain(static_cast<std::uint16_t>(i));
    plain(kSpelledOut);
    text(s);
  }
  void pose(const Pose& X) {
    const Eigen::Matrix<double, 3, 4> m = X.matrix().topRows<3>();
    numbers(m.data(), m.size());
  }
  void vector(const VecX& v) {
    plain(static_cast<std::uint32_t>(v.size()));
    numbers(v.data(), v.size());
  }
  void values(const NamedValues& v) {
    plain(static_cast<std::uint32_t>(v.size()));
    for (std::size_t i = 0; i < v.size(); ++i) {
      name(v[i].first, i);
      plain(v[i].second);
    }
  }
  std::string take() { return std::move(bytes_); }

 private:
  const std::string& known(std::size_t i) const {
    return i < hand_.joints.size() ? hand_.joints[i] : hand_.links[i - hand_.joints.size()];
  }

  const StoredHand& hand_;
  std::string bytes_;
};

class Reader {
 public:
  Reader(std::string_view bytes, const StoredHand& hand, const std::string& where)
      : bytes_(bytes), hand_(hand), where_(where) {}

  [[noreturn]] void damaged() const {
    fail("{}: the stored bytes are damaged; expected a grasp of layout {}", where_, kLayout);
  }
  std::string_view take(std::size_t n) {
    if (n > bytes_.size()) damaged();
    const std::string_view part = bytes_.substr(0, n);
    bytes_.remove_prefix(n);
    return part;
  }
  template <typename T>
  T plain() {
    T value;
    std::memcpy(&value, take(sizeof value).data(), sizeof value);
    return value;
  }
  void numbers(double* data, std::size_t n) {
    const std::string_view part = take(n * sizeof(double));
    if (n > 0) std::memcpy(data, part.data(), part.size());
  }
  /// A count of things of at least some bytes each.
  std::size_t count(std::size_t least_bytes) {
    const auto n = plain<std::uint32_t>();
    if (n > bytes_.size() / least_bytes) damaged();
    return n;
  }
  std::string text() { return std::string(take(count(1))); }
  std::string name() {
    const std::size_t i = plain<std::uint16_t>();
    if (i == kSpelledOut) return text();
    if (i < hand_.joints.size()) return hand_.joints[i];
    if (i - hand_.joints.size() >= hand_.links.size()) damaged();
    return hand_.links[i - hand_.joints.size()];
  }
  Pose pose() {
    Eigen::Matrix<double, 3, 4> m;
    numbers(m.data(), static_cast<std::size_t>(m.size()));
    Pose X = Pose::Identity();
    X.matrix().topRows<3>() = m;
    return X;
  }
  VecX vector() {
    VecX v(static_cast<Eigen::Index>(count(sizeof(double))));
    numbers(v.data(), static_cast<std::size_t>(v.size()));
    return v;
  }
  NamedValues values() {
    NamedValues v(count(2 + sizeof(double)));
    for (auto& [joint, value] : v) {
      joint = name();
      value = plain<double>();
    }
    return v;
  }
  bool at_end() const { return bytes_.empty(); }

 private:
  std::string_view bytes_;
  const StoredHand& hand_;
  const std::string& where_;
};

void write_contacts(Writer& out, const std::vector<GraspContact>& contacts, std::size_t first_link) {
  out.plain(static_cast<std::uint32_t>(contacts.size()));
  for (const GraspContact& c : contacts) {
    out.name(c.link, first_link);
    out.plain(static_cast<std::int32_t>(c.patch));
    out.numbers(c.point.p_OC.data(), 3);
    out.numbers(c.point.n_OC.data(), 3);
    out.plain(c.point.mu);
    out.plain(c.point.torsion_length);
  }
}

std::vector<GraspContact> read_contacts(Reader& in) {
  std::vector<GraspContact> contacts(in.count(70));
  for (GraspContact& c : contacts) {
    c.link = in.name();
    c.patch = in.plain<std::int32_t>();
    in.numbers(c.point.p_OC.data(), 3);
    in.numbers(c.point.n_OC.data(), 3);
    c.point.mu = in.plain<double>();
    c.point.torsion_length = in.plain<double>();
  }
  return contacts;
}

}  // namespace

std::string encode_grasp(const Grasp& g, const StoredHand& hand) {
  Writer out(hand);
  out.plain(kLayout);
  out.plain(static_cast<std::uint8_t>(g.form_closure));
  out.pose(g.X_OH_pregrasp);
  out.pose(g.X_OH);
  out.values(g.pregrasp_joints);
  out.values(g.grasp_joints);
  out.vector(g.pregrasp_dofs);
  out.vector(g.grasp_dofs);
  out.vector(g.amplitudes);
  write_contacts(out, g.contacts, hand.joints.size());
  for (const double value : {g.energy, g.epsilon, g.volume, g.max_penetration}) out.plain(value);
  out.plain(g.provenance.seed);
  out.text(g.provenance.planner);
  out.text(g.provenance.options_digest);
  out.text(g.provenance.version);
  return out.take();
}

Grasp decode_grasp(std::string_view bytes, const StoredHand& hand, const std::string& where) {
  Reader in(bytes, hand, where);
  if (in.plain<std::uint8_t>() != kLayout) in.damaged();
  Grasp g;
  g.form_closure = in.plain<std::uint8_t>() != 0;
  g.X_OH_pregrasp = in.pose();
  g.X_OH = in.pose();
  g.pregrasp_joints = in.values();
  g.grasp_joints = in.values();
  g.pregrasp_dofs = in.vector();
  g.grasp_dofs = in.vector();
  g.amplitudes = in.vector();
  g.contacts = read_contacts(in);
  for (double* value : {&g.energy, &g.epsilon, &g.volume, &g.max_penetration}) *value = in.plain<double>();
  g.provenance.seed = in.plain<std::uint64_t>();
  g.provenance.planner = in.text();
  g.provenance.options_digest = in.text();
  g.provenance.version = in.text();
  if (!in.at_end()) in.damaged();
  return g;
}

}  // namespace eigengrasp
