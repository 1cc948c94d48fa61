// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// What is known of objects' shapes: descriptors, neighbours, alignments.
#include <fmt/format.h>

#include <array>

#include "database/number_list.hpp"
#include "database/record_checks.hpp"
#include "database/sql_store.hpp"
#include "eigengrasp/core/error.hpp"

namespace eigengrasp {

void SqlStore::set_descriptors(const std::vector<StoredDescriptor>& descriptors) {
  for (const StoredDescriptor& d : descriptors) require_sound(d);
  const std::lock_guard lock(mutex_);
  SqlTransaction transaction(*db_);
  for (const StoredDescriptor& d : descriptors) {
    const std::array<double, 4> ball = {d.center.x(), d.center.y(), d.center.z(), d.radius};
    db_->run(sql("INSERT INTO descriptor (original_model_id, descriptor_function, descriptor_route, "
                 "descriptor_ball, descriptor_invariants) VALUES ($1, $2, $3, @numbers_in($4), "
                 "@numbers_in($5)) ON CONFLICT (original_model_id, descriptor_function) DO UPDATE SET "
                 "descriptor_route = excluded.descriptor_route, descriptor_ball = excluded.descriptor_ball, "
                 "descriptor_invariants = excluded.descriptor_invariants"),
             {model_id(d.model), d.function, d.route, format_numbers(ball), format_numbers(d.invariants)});
  }
  transaction.commit();
}

std::vector<StoredDescriptor> SqlStore::descriptors(const std::string& function) {
  const std::lock_guard lock(mutex_);
  std::vector<StoredDescriptor> descriptors;
  db_->run(sql("SELECT o.original_model_name, d.descriptor_function, d.descriptor_route, "
               "@numbers_out(d.descriptor_ball), @numbers_out(d.descriptor_invariants) FROM descriptor d "
               "JOIN original_model o ON o.original_model_id = d.original_model_id "
               "WHERE $1 = '' OR d.descriptor_function = $1 ORDER BY d.descriptor_id"),
           {function}, [&](const SqlRow& row) {
             const auto ball = parse_numbers(row.text(3), place());
             StoredDescriptor& d = descriptors.emplace_back();
             d.model = row.string(0);
             d.function = row.string(1);
             d.route = row.string(2);
             if (ball.size() != 4)
               fail("{}: the descriptor of '{}' has a ball of {} numbers, expected 4", place(), d.model,
                    ball.size());
             d.center = {ball[0], ball[1], ball[2]};
             d.radius = ball[3];
             d.invariants = parse_numbers(row.text(4), place());
           });
  return descriptors;
}

std::vector<std::string> SqlStore::described(const std::string& function) {
  const std::lock_guard lock(mutex_);
  std::vector<std::string> names;
  db_->run(
      "SELECT o.original_model_name FROM descriptor d JOIN original_model o ON o.original_model_id = "
      "d.original_model_id WHERE d.descriptor_function = $1 ORDER BY d.descriptor_id",
      {function}, [&](const SqlRow& row) { names.push_back(row.string(0)); });
  return names;
}

/// The id of a distance function or an alignment method, which is made where it is missing.
std::int64_t SqlStore::id_of_method(const std::string& table, const std::string& name) {
  const std::string find = fmt::format("SELECT {0}_id FROM {0} WHERE {0}_name = $1", table);
  if (const std::int64_t id = count(find, {name})) return id;
  db_->run(fmt::format("INSERT INTO {0} ({0}_name) VALUES ($1) ON CONFLICT ({0}_name) DO NOTHING", table),
           {name});
  return count(find, {name});
}

void SqlStore::set_neighbors(const std::vector<StoredNeighbor>& neighbors) {
  for (const StoredNeighbor& n : neighbors) require_sound(n);
  const std::lock_guard lock(mutex_);
  SqlTransaction transaction(*db_);
  for (const StoredNeighbor& n : neighbors)
    db_->run(
        "INSERT INTO neighbor (original_model_id, neighbor_original_model_id, distance_function_id, "
        "neighbor_distance) VALUES ($1, $2, $3, $4) ON CONFLICT (original_model_id, distance_function_id, "
        "neighbor_original_model_id) DO UPDATE SET neighbor_distance = excluded.neighbor_distance",
        {model_id(n.model), model_id(n.neighbor), id_of_method("distance_function", n.distance_function),
         n.distance});
  transaction.commit();
}

std::vector<StoredNeighbor> SqlStore::neighbors() {
  const std::lock_guard lock(mutex_);
  std::vector<StoredNeighbor> neighbors;
  db_->run(
      "SELECT a.original_model_name, b.original_model_name, f.distance_function_name, n.neighbor_distance "
      "FROM neighbor n JOIN original_model a ON a.original_model_id = n.original_model_id "
      "JOIN original_model b ON b.original_model_id = n.neighbor_original_model_id "
      "JOIN distance_function f ON f.distance_function_id = n.distance_function_id ORDER BY n.neighbor_id",
      {}, [&](const SqlRow& row) {
        neighbors.push_back({row.string(0), row.string(1), row.string(2), row.number(3)});
      });
  return neighbors;
}

void SqlStore::set_alignments(const std::vector<StoredAlignment>& alignments) {
  for (const StoredAlignment& a : alignments) require_sound(a);
  const std::lock_guard lock(mutex_);
  SqlTransaction transaction(*db_);
  for (const StoredAlignment& a : alignments) {
    const Eigen::Matrix<double, 4, 4, Eigen::RowMajor> rows = a.X_target_model;
    db_->run(
        sql("INSERT INTO alignment (original_model_id, alignment_original_model_id, alignment_method_id, "
            "alignment_matrix) VALUES ($1, $2, $3, @numbers_in($4)) ON CONFLICT (original_model_id, "
            "alignment_original_model_id, alignment_method_id) DO UPDATE SET "
            "alignment_matrix = excluded.alignment_matrix"),
        {model_id(a.model), model_id(a.target), id_of_method("alignment_method", a.method),
         format_numbers({rows.data(), 16})});
  }
  transaction.commit();
}

std::vector<StoredAlignment> SqlStore::alignments() {
  const std::lock_guard lock(mutex_);
  std::vector<StoredAlignment> alignments;
  db_->run(
      sql("SELECT a.original_model_name, b.original_model_name, m.alignment_method_name, "
          "@numbers_out(x.alignment_matrix) "
          "FROM alignment x JOIN original_model a ON a.original_model_id = x.original_model_id "
          "JOIN original_model b ON b.original_model_id = x.alignment_original_model_id "
          "JOIN alignment_method m ON m.alignment_method_id = x.alignment_method_id ORDER BY x.alignment_id"),
      {}, [&](const SqlRow& row) {
        const auto numbers = parse_numbers(row.text(3), place());
        StoredAlignment& a = alignments.emplace_back();
        a.model = row.string(0);
        a.target = row.string(1);
        a.method = row.string(2);
        if (numbers.size() == 16)
          a.X_target_model = Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(numbers.data());
      });
  return alignments;
}

}  // namespace eigengrasp
