// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Models, hands and sources, and the ids of all of them.
#include "database/sql_store.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "database/record_checks.hpp"
#include "database/text_list.hpp"
#include "eigengrasp/core/error.hpp"

namespace eigengrasp {

SqlStore::SqlStore(std::unique_ptr<SqlConnection> connection, StoreAccess access)
    : db_(std::move(connection)) {
  prepare_schema(*db_, access);
}

/// Fills in what the databases write differently: {clock}, {texts_in:X}, ... stand as @clock, @texts_in(X),
/// ...
std::string SqlStore::sql(const std::string& text) const {
  const SqlDialect& d = db_->dialect();
  std::string out = text;
  const auto replace_calls = [&](const std::string& name, const std::string& form) {
    for (auto at = out.find(name + "("); at != std::string::npos; at = out.find(name + "(", at)) {
      const auto begin = at + name.size() + 1;
      const auto end = out.find(')', begin);
      out.replace(at, end + 1 - at, fmt::format(fmt::runtime(form), out.substr(begin, end - begin)));
    }
  };
  replace_calls("@texts_in", d.texts_in);
  replace_calls("@texts_out", d.texts_out);
  replace_calls("@numbers_in", d.numbers_in);
  replace_calls("@numbers_out", d.numbers_out);
  for (auto at = out.find("@clock"); at != std::string::npos; at = out.find("@clock"))
    out.replace(at, 6, d.clock);
  return out;
}

std::int64_t SqlStore::count(const std::string& query, const std::vector<SqlValue>& values) {
  std::int64_t n = 0;
  db_->run(query, values, [&](const SqlRow& row) { n = row.integer(0); });
  return n;
}

bool SqlStore::affects(const std::string& statement, const std::vector<SqlValue>& values) {
  bool any = false;
  db_->run(sql(statement), values, [&](const SqlRow&) { any = true; });
  return any;
}

StoreCounts SqlStore::counts() {
  const std::lock_guard lock(mutex_);
  StoreCounts c;
  c.models = count("SELECT count(*) FROM original_model");
  c.scaled_models = count("SELECT count(*) FROM scaled_model");
  c.hands = count("SELECT count(*) FROM hand");
  c.sources = count("SELECT count(*) FROM grasp_source");
  c.descriptors = count("SELECT count(*) FROM descriptor");
  c.neighbors = count("SELECT count(*) FROM neighbor");
  c.alignments = count("SELECT count(*) FROM alignment");
  db_->run("SELECT work_unit_state, count(*) FROM work_unit GROUP BY work_unit_state", {},
           [&](const SqlRow& row) {
             const std::string_view state = row.text(0);
             (state == "waiting"   ? c.waiting
              : state == "claimed" ? c.claimed
              : state == "done"    ? c.done
                                   : c.failed) = row.integer(1);
           });
  db_->run(
      "SELECT h.hand_name, count(g.grasp_id) FROM hand h LEFT JOIN grasp g ON g.hand_id = h.hand_id "
      "GROUP BY h.hand_id, h.hand_name ORDER BY h.hand_id",
      {}, [&](const SqlRow& row) {
        c.grasps_by_hand.emplace_back(row.string(0), row.integer(1));
        c.grasps += row.integer(1);
      });
  return c;
}

std::vector<StoredModel> SqlStore::models_where(const std::string& condition,
                                                const std::vector<SqlValue>& values) {
  std::vector<StoredModel> models;
  std::int64_t last = -1;
  const std::string query = sql(
      "SELECT o.original_model_id, o.original_model_name, o.original_model_geometry_path, "
      "o.original_model_thumbnail_path, @texts_out(o.original_model_tags), o.original_model_content_hash, "
      "o.original_model_rescale, o.original_model_radius, s.scaled_model_scale FROM original_model o "
      "JOIN scaled_model s ON s.original_model_id = o.original_model_id " +
      condition + " ORDER BY o.original_model_id, s.scaled_model_scale");
  db_->run(query, values, [&](const SqlRow& row) {
    if (row.integer(0) != last) {
      last = row.integer(0);
      StoredModel& m = models.emplace_back();
      m.name = row.string(1);
      m.geometry_path = row.string(2);
      m.thumbnail_path = row.string(3);
      m.tags = parse_texts(row.text(4), place());
      m.content_hash = row.string(5);
      m.rescale = row.number(6);
      m.approximate_radius = row.number(7);
      m.scales.clear();
    }
    models.back().scales.push_back(row.number(8));
  });
  return models;
}

std::vector<StoredModel> SqlStore::models() {
  const std::lock_guard lock(mutex_);
  return models_where("", {});
}

bool SqlStore::add_scales(const std::string& model, const std::vector<double>& scales) {
  bool any = false;
  const std::int64_t id =
      count("SELECT original_model_id FROM original_model WHERE original_model_name = $1", {model});
  for (const double scale : scales) {
    const bool added = affects(
        "INSERT INTO scaled_model (scaled_model_name, scaled_model_scale, original_model_id) VALUES "
        "($1, $2, $3) ON CONFLICT (original_model_id, scaled_model_scale) DO NOTHING RETURNING "
        "scaled_model_id",
        {scaled_model_name(model, scale), scale, id});
    any = any || added;
  }
  return any;
}

bool SqlStore::add_model(const StoredModel& model) {
  require_sound(model);
  const std::lock_guard lock(mutex_);
  SqlTransaction transaction(*db_);
  bool added = affects(
      "INSERT INTO original_model (original_model_name, original_model_geometry_path, "
      "original_model_thumbnail_path, original_model_tags, original_model_content_hash, "
      "original_model_rescale, original_model_radius) VALUES ($1, $2, $3, @texts_in($4), $5, $6, $7) "
      "ON CONFLICT (original_model_name) DO NOTHING RETURNING original_model_id",
      {model.name, model.geometry_path, model.thumbnail_path, format_texts(model.tags), model.content_hash,
       model.rescale, model.approximate_radius});
  if (!added) require_same(models_where("WHERE o.original_model_name = $1", {model.name}).front(), model);
  added = add_scales(model.name, model.scales) || added;
  transaction.commit();
  return added;
}

std::vector<StoredHand> SqlStore::hands_where(const std::string& condition,
                                              const std::vector<SqlValue>& values) {
  std::vector<StoredHand> hands;
  db_->run(
      "SELECT hand_name, hand_joints, hand_dofs, hand_links FROM hand " + condition + " ORDER BY hand_id",
      values, [&](const SqlRow& row) {
        hands.push_back({row.string(0), parse_texts(row.text(1), place()), parse_texts(row.text(2), place()),
                         parse_texts(row.text(3), place())});
      });
  return hands;
}

std::vector<StoredHand> SqlStore::hands() {
  const std::lock_guard lock(mutex_);
  return hands_where("", {});
}

bool SqlStore::add_hand(const StoredHand& hand) {
  require_sound(hand);
  const std::lock_guard lock(mutex_);
  const bool added = affects(
      "INSERT INTO hand (hand_name, hand_joints, hand_dofs, hand_links) VALUES ($1, $2, $3, $4) "
      "ON CONFLICT (hand_name) DO NOTHING RETURNING hand_id",
      {hand.name, format_texts(hand.joints), format_texts(hand.dofs), format_texts(hand.links)});
  if (!added) require_same(hands_where("WHERE hand_name = $1", {hand.name}).front(), hand);
  return added;
}

std::vector<GraspSource> SqlStore::sources() {
  const std::lock_guard lock(mutex_);
  std::vector<GraspSource> sources;
  db_->run("SELECT grasp_source_name, grasp_source_description FROM grasp_source ORDER BY grasp_source_id",
           {}, [&](const SqlRow& row) {
             sources.push_back({row.string(0), row.string(1)});
           });
  return sources;
}

bool SqlStore::add_source(const GraspSource& source) {
  require_name(source.name, "a source");
  const std::lock_guard lock(mutex_);
  const bool added = affects(
      "INSERT INTO grasp_source (grasp_source_name, grasp_source_description) VALUES ($1, $2) "
      "ON CONFLICT (grasp_source_name) DO NOTHING RETURNING grasp_source_id",
      {source.name, source.description});
  if (added) return true;
  db_->run("SELECT grasp_source_description FROM grasp_source WHERE grasp_source_name = $1", {source.name},
           [&](const SqlRow& row) {
             require_same(GraspSource{source.name, row.string(0)}, source);
           });
  return false;
}

std::int64_t SqlStore::model_id(const std::string& name) {
  if (const auto known = model_ids_.find(name); known != model_ids_.end()) return known->second;
  const std::int64_t id =
      count("SELECT original_model_id FROM original_model WHERE original_model_name = $1", {name});
  if (id == 0) fail("{}: holds no object '{}'; 'eigengrasp db list' names those it holds", place(), name);
  return model_ids_[name] = id;
}

std::int64_t SqlStore::source_id(const std::string& name) {
  if (const auto known = source_ids_.find(name); known != source_ids_.end()) return known->second;
  const std::int64_t id =
      count("SELECT grasp_source_id FROM grasp_source WHERE grasp_source_name = $1", {name});
  if (id == 0) fail("{}: holds no grasp source '{}'; add it first", place(), name);
  return source_ids_[name] = id;
}

const std::string& SqlStore::source_name(std::int64_t id) {
  std::string& name = source_names_[id];
  if (name.empty())
    db_->run("SELECT grasp_source_name FROM grasp_source WHERE grasp_source_id = $1", {id},
             [&](const SqlRow& row) { name = row.string(0); });
  return name;
}

const SqlStore::KnownHand& SqlStore::known_hand(const std::string& name) {
  if (const auto known = hands_.find(name); known != hands_.end()) return known->second;
  const auto found = hands_where("WHERE hand_name = $1", {name});
  if (found.empty()) fail("{}: holds no hand '{}'; 'eigengrasp db info' names those it holds", place(), name);
  const std::int64_t id = count("SELECT hand_id FROM hand WHERE hand_name = $1", {name});
  return hands_[name] = KnownHand{id, found.front()};
}

SqlStore::Slot SqlStore::slot_of(const UnitKey& key) {
  const std::int64_t hand = known_hand(key.hand).id;
  const auto known = scaled_ids_.find({key.object, key.scale});
  if (known != scaled_ids_.end()) return {known->second, hand};
  const std::int64_t id = count(
      "SELECT scaled_model_id FROM scaled_model WHERE original_model_id = $1 AND scaled_model_scale = $2",
      {model_id(key.object), key.scale});
  if (id == 0)
    fail("{}: holds object '{}', but not at scale {}; add the scale first", place(), key.object, key.scale);
  scaled_ids_[{key.object, key.scale}] = id;
  return {id, hand};
}

}  // namespace eigengrasp
