// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "eigengrasp/database/grasp_store.hpp"

namespace eigengrasp {

/// Bytes, beside texts.
struct SqlBytes {
  std::string bytes;
};
using SqlValue = std::variant<std::int64_t, double, std::string, SqlBytes>;

/// A row of a result, while it is looked at. Columns count from 0.
class SqlRow {
 public:
  virtual ~SqlRow() = default;
  virtual bool is_null(int column) const = 0;
  virtual std::int64_t integer(int column) const = 0;
  virtual double number(int column) const = 0;
  virtual std::string_view text(int column) const = 0;  ///< or bytes
  std::string string(int column) const { return std::string(text(column)); }
};
using SqlRowReader = std::function<void(const SqlRow&)>;

/// What SQLite and PostgreSQL write differently. Both know parameters $1, $2, ..., which stand in a statement
/// in this order.
struct SqlDialect {
  std::vector<const char*> migrations;  ///< the first makes version 1 of the schema, and so on
  std::string count_tables;             ///< how many tables of the name $1 there are
  std::string lock_schema;              ///< first statement of a migration; empty: none
  std::string clock;                    ///< seconds since 1970
  std::string skip_locked;              ///< ending of a SELECT that takes a row which no one else has
  std::string light_commit;             ///< the transaction need not outlive a power cut; empty: none
  std::string next_rank;                ///< query for the rank of a grasp: scaled model $1, hand $2
  // A list of texts is JSON and a list of numbers {1,2} on our side.
  std::string texts_in, texts_out, numbers_in, numbers_out;  ///< with {} for the parameter or column
};

/// A grasp on its way into the table.
struct GraspRow {
  std::int64_t scaled_model = 0, hand = 0, source = 0, rank = 0;
  const Grasp* grasp = nullptr;
  std::string exact;  ///< encode_grasp
};

/// A connection to a database, for one thread at a time. Everything throws Error.
class SqlConnection {
 public:
  virtual ~SqlConnection() = default;
  virtual std::string place() const = 0;
  virtual const SqlDialect& dialect() const = 0;
  /// Runs one statement, which is prepared once.
  virtual void run(const std::string& sql, const std::vector<SqlValue>& values, const SqlRowReader& each) = 0;
  void run(const std::string& sql, const std::vector<SqlValue>& values = {}) {
    run(sql, values, [](const SqlRow&) {});
  }
  /// Runs several statements without parameters.
  virtual void script(const std::string& sql) = 0;
  virtual void begin() = 0;
  virtual void commit() = 0;
  virtual void rollback() noexcept = 0;
  /// The fast way for many rows. @pre in a transaction
  virtual void insert_grasps(const std::vector<GraspRow>& rows) = 0;
};

/// Rolls back at its end unless it was committed.
class SqlTransaction {
 public:
  explicit SqlTransaction(SqlConnection& connection) : connection_(connection) { connection_.begin(); }
  ~SqlTransaction() {
    if (!committed_) connection_.rollback();
  }
  SqlTransaction(const SqlTransaction&) = delete;
  SqlTransaction& operator=(const SqlTransaction&) = delete;
  void commit() {
    connection_.commit();
    committed_ = true;
  }

 private:
  SqlConnection& connection_;
  bool committed_ = false;
};

/// @param file after "sqlite:"
std::unique_ptr<SqlConnection> open_sqlite(const std::string& file, const StoreOptions& options);
/// @param url the whole address
std::unique_ptr<SqlConnection> open_postgres(const std::string& url, const StoreOptions& options);

/// Brings the schema up to date, or makes it, where access is write. @throws Error where the schema is of
/// another program, missing or older (reading), or newer than the last migration.
void prepare_schema(SqlConnection& connection, StoreAccess access);

}  // namespace eigengrasp
