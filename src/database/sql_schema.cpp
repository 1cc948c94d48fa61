// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "database/sql_connection.hpp"
#include "eigengrasp/core/error.hpp"

namespace eigengrasp {

namespace {

bool has_table(SqlConnection& connection, const std::string& name) {
  bool found = false;
  connection.run(connection.dialect().count_tables, {name},
                 [&](const SqlRow& row) { found = row.integer(0) > 0; });
  return found;
}

/// 0: there is no store yet.
std::int64_t schema_version(SqlConnection& connection) {
  if (!has_table(connection, "eigengrasp_schema")) {
    if (has_table(connection, "original_model") || has_table(connection, "grasp"))
      fail("{}: holds tables of another program (original_model or grasp); name another database",
           connection.place());
    return 0;
  }
  std::int64_t version = 0;
  connection.run("SELECT schema_version FROM eigengrasp_schema", {},
                 [&](const SqlRow& row) { version = row.integer(0); });
  return version;
}

void migrate(SqlConnection& connection) {
  SqlTransaction transaction(connection);
  if (!connection.dialect().lock_schema.empty()) connection.run(connection.dialect().lock_schema);
  const auto& migrations = connection.dialect().migrations;
  std::int64_t version = schema_version(connection);  // another program may have been faster
  const bool fresh = version == 0;
  for (; version < static_cast<std::int64_t>(migrations.size()); ++version)
    connection.script(migrations[static_cast<std::size_t>(version)]);
  if (fresh) connection.script("CREATE TABLE eigengrasp_schema (schema_version INTEGER NOT NULL)");
  connection.run(fresh ? "INSERT INTO eigengrasp_schema (schema_version) VALUES ($1)"
                       : "UPDATE eigengrasp_schema SET schema_version = $1",
                 {version});
  transaction.commit();
}

}  // namespace

void prepare_schema(SqlConnection& connection, StoreAccess access) {
  const auto known = static_cast<std::int64_t>(connection.dialect().migrations.size());
  const std::int64_t version = schema_version(connection);
  if (version > known)
    fail("{}: is of version {}, and this program knows {} and older; use a newer eigengrasp",
         connection.place(), version, known);
  if (version == known) return;
  if (access != StoreAccess::write && version == 0)
    fail("{}: holds no grasp store; 'eigengrasp db add-objects' makes one", connection.place());
  if (access == StoreAccess::read)
    fail(
        "{}: is of the older version {}; any command that writes, such as 'eigengrasp db describe', updates "
        "it",
        connection.place(), version);
  migrate(connection);
}

}  // namespace eigengrasp
