// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <fcntl.h>
#include <fmt/format.h>
#include <sqlite3.h>
#include <unistd.h>

#include <array>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <unordered_map>

#include "database/sql_connection.hpp"
#include "database/sqlite_schema.hpp"
#include "eigengrasp/core/error.hpp"

namespace eigengrasp {

namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kApplicationId = 0x65676772;  // "eggr", in the file's header

const SqlDialect& sqlite_dialect() {
  static const SqlDialect dialect = {
      .migrations = {kSqliteSchema1, kSqliteSchema2},
      .count_tables = "SELECT count(*) FROM sqlite_master WHERE type = 'table' AND name = $1",
      .lock_schema = "",
      .clock = "((julianday('now') - 2440587.5) * 86400.0)",
      .skip_locked = "",
      .light_commit = "",
      .next_rank =
          "SELECT coalesce(max(grasp_rank) + 1, 0) FROM grasp WHERE scaled_model_id = $1 AND "
          "hand_id = $2",
      .texts_in = "{}",
      .texts_out = "{}",
      .numbers_in = "{}",
      .numbers_out = "{}"};
  return dialect;
}

struct CloseDatabase {
  void operator()(sqlite3* db) const { sqlite3_close(db); }
};
struct Finalize {
  void operator()(sqlite3_stmt* s) const { sqlite3_finalize(s); }
};
using Statement = std::unique_ptr<sqlite3_stmt, Finalize>;

class SqliteRow : public SqlRow {
 public:
  explicit SqliteRow(sqlite3_stmt* s) : s_(s) {}
  bool is_null(int c) const override { return sqlite3_column_type(s_, c) == SQLITE_NULL; }
  std::int64_t integer(int c) const override { return sqlite3_column_int64(s_, c); }
  double number(int c) const override { return sqlite3_column_double(s_, c); }
  std::string_view text(int c) const override {
    const void* data = sqlite3_column_blob(s_, c);
    return {static_cast<const char*>(data), static_cast<std::size_t>(sqlite3_column_bytes(s_, c))};
  }

 private:
  sqlite3_stmt* s_;
};

/// Resets a statement when its rows were read, or reading ended early.
struct ResetGuard {
  sqlite3_stmt* s;
  ~ResetGuard() {
    sqlite3_reset(s);
    sqlite3_clear_bindings(s);
  }
};

std::uint32_t big_endian(const char* bytes) {
  std::uint32_t value = 0;
  for (int i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(bytes[i]);
  return value;
}

/// What the first 100 bytes tell before SQLite touches the file: foreign, or shorter than it says it is.
void check_header(const fs::path& file) {
  std::error_code ec;
  const auto size = fs::file_size(file, ec);
  if (ec || size == 0) return;
  std::array<char, 100> head{};
  std::ifstream in(file, std::ios::binary);
  in.read(head.data(), head.size());
  if (std::memcmp(head.data(), "SQLite format 3", 16) != 0)
    fail("sqlite:{}: is no grasp store (the file does not begin as an SQLite file does)", file.string());
  if (in.gcount() < static_cast<std::streamsize>(head.size()))
    fail("sqlite:{}: is cut short; restore it from a copy", file.string());
  const std::uint32_t id = big_endian(head.data() + 68);
  if (id != kApplicationId && id != 0)
    fail("sqlite:{}: is an SQLite file of another program, not a grasp store", file.string());
  const std::uint64_t page = static_cast<std::uint64_t>(static_cast<unsigned char>(head[16])) << 8 |
                             static_cast<unsigned char>(head[17]);
  const std::uint64_t expected = (page == 1 ? 65536 : page) * big_endian(head.data() + 28);
  const fs::path log = file.string() + "-wal";  // holds pages that are not in the file yet
  if (size < expected && (!fs::exists(log, ec) || fs::file_size(log, ec) == 0))
    fail("sqlite:{}: is cut short ({} bytes of {}); restore it from a copy", file.string(), size, expected);
}

/// Nobody can write beside the file, so that SQLite could not make its log there, and there is no log to
/// read.
bool is_frozen(const fs::path& file) {
  std::error_code ec;
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  return ::faccessat(AT_FDCWD, folder.c_str(), W_OK, AT_EACCESS) != 0 &&
         !fs::exists(file.string() + "-wal", ec);
}

std::string frozen_uri(const std::string& file) {
  std::string uri = file.starts_with('/') ? "file://" : "file:";
  for (const char c : file)
    uri += c == '%' || c == '?' || c == '#' ? fmt::format("%{:02X}", c) : std::string(1, c);
  return uri + "?immutable=1";
}

class SqliteConnection : public SqlConnection {
 public:
  SqliteConnection(std::string file, const StoreOptions& options)
      : file_(std::move(file)), options_(options) {
    check_header(file_);
    open();
    sqlite3_busy_timeout(db_.get(), static_cast<int>(1000.0 * options.lock_seconds));
    check_owner();
    script("PRAGMA cache_size = -65536;");
    const bool reading = options.access == StoreAccess::read;
    script(reading ? "PRAGMA query_only = ON;"
                   : "PRAGMA journal_mode = WAL; PRAGMA synchronous = NORMAL; PRAGMA foreign_keys = ON;");
  }

  std::string place() const override { return "sqlite:" + file_; }
  const SqlDialect& dialect() const override { return sqlite_dialect(); }

  void run(const std::string& sql, const std::vector<SqlValue>& values, const SqlRowReader& each) override {
    sqlite3_stmt* s = prepare(sql);
    const ResetGuard guard{s};
    for (std::size_t i = 0; i < values.size(); ++i) bind(s, static_cast<int>(i) + 1, values[i]);
    step(s, each);
  }

  void script(const std::string& sql) override {
    if (const int rc = sqlite3_exec(db_.get(), sql.c_str(), nullptr, nullptr, nullptr)) complain(rc);
  }
  void begin() override { script("BEGIN IMMEDIATE"); }
  void commit() override { script("COMMIT"); }
  void rollback() noexcept override { sqlite3_exec(db_.get(), "ROLLBACK", nullptr, nullptr, nullptr); }

  void insert_grasps(const std::vector<GraspRow>& rows) override {
    sqlite3_stmt* s = prepare(
        "INSERT INTO grasp (scaled_model_id, hand_id, grasp_source_id, grasp_rank, grasp_energy, "
        "grasp_epsilon_quality, grasp_volume_quality, grasp_exact) VALUES ($1, $2, $3, $4, $5, $6, $7, $8)");
    for (const GraspRow& row : rows) {
      const ResetGuard guard{s};
      int i = 1;
      for (const std::int64_t id : {row.scaled_model, row.hand, row.source, row.rank})
        sqlite3_bind_int64(s, i++, id);
      for (const double value : {row.grasp->energy, row.grasp->epsilon, row.grasp->volume})
        sqlite3_bind_double(s, i++, value);
      sqlite3_bind_blob64(s, i, row.exact.data(), row.exact.size(), SQLITE_STATIC);
      step(s, [](const SqlRow&) {});
    }
  }

 private:
  void open() {
    const bool reading = options_.access == StoreAccess::read;
    std::error_code ec;
    if (fs::is_directory(file_, ec)) fail("sqlite:{}: is a folder, expected a file", file_);
    if (options_.access != StoreAccess::write && !fs::exists(file_, ec))
      fail("sqlite:{}: there is no such file", file_);
    const bool frozen = reading && is_frozen(file_);
    const std::string name = frozen ? frozen_uri(file_) : file_;
    // A reader opens for writing as well, so that it can take away the log's files when it is the last; that
    // it writes nothing else is seen to by query_only.
    const int flags = frozen    ? SQLITE_OPEN_READONLY | SQLITE_OPEN_URI
                      : reading ? SQLITE_OPEN_READWRITE
                                : SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE;
    sqlite3* db = nullptr;
    const int rc = sqlite3_open_v2(name.c_str(), &db, flags, nullptr);
    db_.reset(db);
    if (rc != SQLITE_OK) complain(rc);
    if (!reading && sqlite3_db_readonly(db, "main") == 1)
      fail("sqlite:{}: the file cannot be written to; mend its permissions or name another file", file_);
  }

  /// A new file gets our mark; one of another program is left alone.
  void check_owner() {
    std::int64_t id = 0, tables = 0;
    // Tables first: another program that makes the store right now sets the mark before it makes tables.
    run("SELECT count(*) FROM sqlite_master", {}, [&](const SqlRow& row) { tables = row.integer(0); });
    run("PRAGMA application_id", {}, [&](const SqlRow& row) { id = row.integer(0); });
    if (id == kApplicationId) return;
    if (id != 0 || tables > 0)
      fail("sqlite:{}: is an SQLite file of another program, not a grasp store", file_);
    if (options_.access == StoreAccess::write)
      script(fmt::format("PRAGMA application_id = {}", kApplicationId));
  }

  [[noreturn]] void complain(int rc) const {
    switch (rc & 0xFF) {
      case SQLITE_BUSY:
      case SQLITE_LOCKED:
        fail("{}: is locked by another program (waited {} s); try again when it has ended", place(),
             options_.lock_seconds);
      case SQLITE_CORRUPT:
      case SQLITE_NOTADB:
        fail("{}: is damaged ({}); restore it from a copy", place(), sqlite3_errstr(rc));
      case SQLITE_FULL:
        fail("{}: the disk is full; nothing of this step was stored", place());
      case SQLITE_READONLY:
        if (options_.access == StoreAccess::read && db_)
          fail("{}: was opened for reading and cannot be written", place());
        [[fallthrough]];
      case SQLITE_CANTOPEN:
      case SQLITE_PERM:
        fail("{}: cannot be opened or written; is its folder there, and may you write to it?", place());
      default:
        fail("{}: {}", place(), db_ ? sqlite3_errmsg(db_.get()) : sqlite3_errstr(rc));
    }
  }

  sqlite3_stmt* prepare(const std::string& sql) {
    Statement& s = statements_[sql];
    if (!s) {
      sqlite3_stmt* made = nullptr;
      const int rc =
          sqlite3_prepare_v3(db_.get(), sql.c_str(), -1, SQLITE_PREPARE_PERSISTENT, &made, nullptr);
      s.reset(made);
      if (rc != SQLITE_OK) complain(rc);
    }
    return s.get();
  }

  static void bind(sqlite3_stmt* s, int i, const SqlValue& value) {
    if (const auto* n = std::get_if<std::int64_t>(&value)) {
      sqlite3_bind_int64(s, i, *n);
    } else if (const auto* x = std::get_if<double>(&value)) {
      sqlite3_bind_double(s, i, *x);
    } else if (const auto* text = std::get_if<std::string>(&value)) {
      sqlite3_bind_text64(s, i, text->data(), text->size(), SQLITE_STATIC, SQLITE_UTF8);
    } else {
      const std::string& bytes = std::get<SqlBytes>(value).bytes;
      sqlite3_bind_blob64(s, i, bytes.data(), bytes.size(), SQLITE_STATIC);
    }
  }

  void step(sqlite3_stmt* s, const SqlRowReader& each) {
    int rc;
    while ((rc = sqlite3_step(s)) == SQLITE_ROW) each(SqliteRow(s));
    if (rc != SQLITE_DONE) complain(rc);
  }

  std::string file_;
  StoreOptions options_;
  std::unique_ptr<sqlite3, CloseDatabase> db_;
  std::unordered_map<std::string, Statement> statements_;  // go before the database does
};

}  // namespace

std::unique_ptr<SqlConnection> open_sqlite(const std::string& file, const StoreOptions& options) {
  return std::make_unique<SqliteConnection>(file, options);
}

}  // namespace eigengrasp
