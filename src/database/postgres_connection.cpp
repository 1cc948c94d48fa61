// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <fmt/format.h>
#include <libpq-fe.h>

#include <algorithm>
#include <unordered_map>

#include "database/cgdb_grasp.hpp"
#include "database/postgres_address.hpp"
#include "database/postgres_schema.hpp"
#include "database/postgres_values.hpp"
#include "database/transient_error.hpp"

namespace eigengrasp {

namespace {

const SqlDialect& postgres_dialect() {
  static const std::string first = std::string(kPostgresSchema1) + kPostgresClientFunctions1;
  static const SqlDialect dialect = {
      .migrations = {first.c_str(), kPostgresSchema2},
      .count_tables =
          "SELECT count(*) FROM information_schema.tables WHERE table_schema = current_schema() AND "
          "table_name = $1",
      .lock_schema = "SELECT pg_advisory_xact_lock(73183491)",
      .clock = "CAST(extract(epoch FROM clock_timestamp()) AS DOUBLE PRECISION)",
      .skip_locked = " FOR UPDATE SKIP LOCKED",
      .light_commit = "SET LOCAL synchronous_commit = off",
      .next_rank = "SELECT next_grasp_rank($1, $2)",
      .texts_in = "ARRAY(SELECT jsonb_array_elements_text(CAST({} AS JSONB)))",
      .texts_out = "CAST(array_to_json({}) AS TEXT)",
      .numbers_in = "CAST({} AS DOUBLE PRECISION[])",
      .numbers_out = "CAST({} AS TEXT)"};
  return dialect;
}

struct Finish {
  void operator()(PGconn* c) const { PQfinish(c); }
};
struct Clear {
  void operator()(PGresult* r) const { PQclear(r); }
};
using Result = std::unique_ptr<PGresult, Clear>;

/// A row of a result in binary form.
class PostgresRow : public SqlRow {
 public:
  PostgresRow(const PGresult* r, int row) : r_(r), row_(row) {}
  bool is_null(int c) const override { return PQgetisnull(r_, row_, c) == 1; }
  std::int64_t integer(int c) const override {
    const std::string_view bytes = text(c);
    const std::uint64_t v = read_big_endian(bytes);
    return bytes.size() == 4 ? static_cast<std::int32_t>(v) : static_cast<std::int64_t>(v);
  }
  double number(int c) const override { return std::bit_cast<double>(read_big_endian(text(c))); }
  std::string_view text(int c) const override {
    return {PQgetvalue(r_, row_, c), static_cast<std::size_t>(PQgetlength(r_, row_, c))};
  }

 private:
  const PGresult* r_;
  int row_;
};

/// Parameters as libpq takes them: numbers as text, bytes as they are.
struct Parameters {
  std::vector<std::string> texts;
  std::vector<const char*> data;
  std::vector<int> lengths, formats;

  explicit Parameters(const std::vector<SqlValue>& values) : texts(values.size()) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      const auto* bytes = std::get_if<SqlBytes>(&values[i]);
      const auto* text = std::get_if<std::string>(&values[i]);
      if (const auto* n = std::get_if<std::int64_t>(&values[i])) texts[i] = fmt::to_string(*n);
      if (const auto* x = std::get_if<double>(&values[i])) texts[i] = fmt::to_string(*x);
      const std::string& shown = bytes ? bytes->bytes : text ? *text : texts[i];
      data.push_back(shown.data());
      lengths.push_back(static_cast<int>(shown.size()));
      formats.push_back(bytes ? 1 : 0);
    }
  }
};

class PostgresConnection : public SqlConnection {
 public:
  PostgresConnection(const std::string& url, const StoreOptions& options)
      : place_(without_password(url)), options_(options) {
    const char* keywords[] = {"connect_timeout", "application_name", "client_encoding", "dbname", nullptr};
    const char* values[] = {"10", "eigengrasp", "UTF8", url.c_str(), nullptr};
    db_.reset(PQconnectdbParams(keywords, values, 1));
    if (PQstatus(db_.get()) != CONNECTION_OK)
      complain_of_connection(place_, PQerrorMessage(db_.get()), options.await_server);
    if (PQserverVersion(db_.get()) < 150000)
      fail("{}: the server is PostgreSQL {}, expected 15 or newer", place_,
           PQserverVersion(db_.get()) / 10000);
    set_up_session();
  }

  std::string place() const override { return place_; }
  const SqlDialect& dialect() const override { return postgres_dialect(); }

  void run(const std::string& sql, const std::vector<SqlValue>& values, const SqlRowReader& each) override {
    if (!in_transaction_) revive();
    const std::string name = prepare(sql);
    const Parameters p(values);
    const Result r(PQexecPrepared(db_.get(), name.c_str(), static_cast<int>(values.size()), p.data.data(),
                                  p.lengths.data(), p.formats.data(), 1));
    require(r.get());
    const int n = PQntuples(r.get());
    for (int i = 0; i < n; ++i) each(PostgresRow(r.get(), i));
  }

  void script(const std::string& sql) override {
    const Result r(PQexec(db_.get(), sql.c_str()));
    require(r.get());
  }
  void begin() override {
    in_transaction_ = true;  // also of a connection that is lost here nothing is stored
    try {
      revive();
      script("BEGIN");
    } catch (...) {
      in_transaction_ = false;
      throw;
    }
  }
  void commit() override {
    in_transaction_ = false;
    script("COMMIT");
  }
  void rollback() noexcept override {
    in_transaction_ = false;
    const Result ignored(PQexec(db_.get(), "ROLLBACK"));
  }

  void insert_grasps(const std::vector<GraspRow>& rows) override {
    if (rows.empty()) return;
    const Result start(PQexec(
        db_.get(),
        "COPY grasp (scaled_model_id, hand_id, grasp_source_id, grasp_rank, grasp_pregrasp_joints, "
        "grasp_pregrasp_position, grasp_grasp_joints, grasp_grasp_position, grasp_contacts, grasp_energy, "
        "grasp_epsilon_quality, grasp_volume_quality, grasp_exact) FROM STDIN BINARY"));
    require(start.get());
    PostgresWriter out;
    out.raw(std::string_view("PGCOPY\n\377\r\n\0", 11));
    out.int32(0);  // flags
    out.int32(0);  // no extension of the header
    for (const GraspRow& row : rows) write(out, row);
    out.int16(-1);
    const auto size = static_cast<int>(out.bytes().size());
    if (PQputCopyData(db_.get(), out.bytes().data(), size) != 1 || PQputCopyEnd(db_.get(), nullptr) != 1)
      complain(nullptr);
    const Result end(PQgetResult(db_.get()));
    require(end.get());
    while (const Result more{PQgetResult(db_.get())}) continue;
  }

 private:
  void set_up_session() {
    PQsetNoticeProcessor(
        db_.get(), [](void*, const char*) {}, nullptr);
    script(fmt::format("SET lock_timeout = '{}ms'", static_cast<long>(1000.0 * options_.lock_seconds)));
    if (options_.access == StoreAccess::read) script("SET default_transaction_read_only = on");
  }

  /// A server that was started again is asked again.
  void revive() {
    if (PQstatus(db_.get()) == CONNECTION_OK) return;
    PQreset(db_.get());
    names_.clear();
    if (PQstatus(db_.get()) != CONNECTION_OK) complain_of_connection(place_, PQerrorMessage(db_.get()), true);
    set_up_session();
  }

  static void write(PostgresWriter& out, const GraspRow& row) {
    const CgdbGrasp g = to_cgdb(*row.grasp);
    out.int16(13);  // columns
    for (const std::int64_t id : {row.scaled_model, row.hand, row.source, row.rank}) out.int32_field(id);
    for (const auto* numbers :
         {&g.pregrasp_joints, &g.pregrasp_position, &g.grasp_joints, &g.grasp_position, &g.contacts})
      out.numbers_field(*numbers);
    for (const double value : {row.grasp->energy, row.grasp->epsilon, row.grasp->volume})
      out.number_field(value);
    out.bytes_field(row.exact);
  }

  std::string prepare(const std::string& sql) {
    if (const auto known = names_.find(sql); known != names_.end()) return known->second;
    std::string name = fmt::format("s{}", names_.size());
    const Result r(PQprepare(db_.get(), name.c_str(), sql.c_str(), 0, nullptr));
    require(r.get());
    return names_[sql] = name;
  }

  void require(const PGresult* r) const {
    const ExecStatusType status = PQresultStatus(r);
    if (status != PGRES_COMMAND_OK && status != PGRES_TUPLES_OK && status != PGRES_COPY_IN) complain(r);
  }

  [[noreturn]] void complain(const PGresult* r) const {
    const char* code = r ? PQresultErrorField(r, PG_DIAG_SQLSTATE) : nullptr;
    const std::string_view state = code ? code : "";
    const bool shut_down = state == "57P01" || state == "57P02" || state == "57P03";
    if (PQstatus(db_.get()) != CONNECTION_OK || shut_down || state.starts_with("08"))
      throw TransientError(fmt::format("{}: the connection to the server was lost", place_),
                           !in_transaction_);
    if (state == "40P01" || state == "40001")
      throw TransientError(fmt::format("{}: the server ended the transaction because of another one", place_),
                           false);
    if (state == "55P03")
      fail("{}: is locked by another program (waited {} s); try again when it has ended", place_,
           options_.lock_seconds);
    if (state == "53100") fail("{}: the server's disk is full; nothing of this step was stored", place_);
    if (state == "42501") fail("{}: this user may not do that; ask the database's owner to GRANT it", place_);
    if (state == "25006") fail("{}: was opened for reading and cannot be written", place_);
    const char* message = r ? PQresultErrorField(r, PG_DIAG_MESSAGE_PRIMARY) : nullptr;
    fail("{}: {}", place_, message ? message : first_line(PQerrorMessage(db_.get())));
  }

  std::string place_;
  StoreOptions options_;
  std::unique_ptr<PGconn, Finish> db_;
  std::unordered_map<std::string, std::string> names_;  // of prepared statements
  bool in_transaction_ = false;  // before its commit, so that a lost connection undoes it
};

}  // namespace

std::unique_ptr<SqlConnection> open_postgres(const std::string& url, const StoreOptions& options) {
  return std::make_unique<PostgresConnection>(url, options);
}

}  // namespace eigengrasp
