// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <arpa/inet.h>
#include <fmt/format.h>
#include <libpq-fe.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "eigengrasp/core/temporary_folder.hpp"

namespace eigengrasp::testing {

/// A PostgreSQL server of its own: in a scratch folder, on a free port of the loopback, gone at the end. Runs
/// as the user postgres where the tests run as root, because the server refuses to be root.
class PostgresServer {
 public:
  /// The one of this program, started when it is asked for first. None where PostgreSQL is not installed.
  static PostgresServer* instance() {
    static const std::unique_ptr<PostgresServer> server =
        find_programs().empty() ? nullptr : std::make_unique<PostgresServer>();
    return server.get();
  }
  static const char* why_none() {
    return "SKIPPED: PostgreSQL is not installed (apt-get install postgresql): initdb was not found";
  }

  PostgresServer() {
    std::ofstream(folder_ / "password") << "secret\n";
    if (::geteuid() == 0) run_here("chown -R postgres " + folder_.string());
    run(
        fmt::format("initdb -D {0}/data -U grasp --pwfile={0}/password -A scram-sha-256 -E UTF8 --locale=C "
                    "--no-sync",
                    folder_.string()));
    port_ = free_port();
    start();
  }
  ~PostgresServer() {
    try {
      stop();
    } catch (const std::exception& e) {
      fmt::print(stderr, "{}\n", e.what());
    }
  }
  PostgresServer(const PostgresServer&) = delete;
  PostgresServer& operator=(const PostgresServer&) = delete;

  void start() {
    run(fmt::format(
        "pg_ctl -D {0}/data -l {0}/log -w -o '-p {1} -k {0} -c listen_addresses=127.0.0.1 {2}' start",
        folder_.string(), port_, getenv_or("EIGENGRASP_TEST_PG_OPTIONS", "-c fsync=off")));
  }
  void stop() { run(fmt::format("pg_ctl -D {}/data -m fast -w stop", folder_.string())); }

  std::string address(const std::string& database, const std::string& password = "secret") const {
    return fmt::format("postgresql://grasp:{}@127.0.0.1:{}/{}", password, port_, database);
  }
  /// A new empty database. @returns its address
  std::string make_database() {
    const std::string name = fmt::format("store_{}", count_++);
    query(address("postgres"), "CREATE DATABASE " + name);
    return address(name);
  }
  std::string log() const {
    std::ifstream in(folder_ / "log");
    return {std::istreambuf_iterator<char>(in), {}};
  }

  /// What a statement answers: texts row by row, with the names of the columns first.
  static std::vector<std::vector<std::string>> query(const std::string& address, const std::string& sql) {
    const std::unique_ptr<PGconn, void (*)(PGconn*)> db(PQconnectdb(address.c_str()), PQfinish);
    const std::unique_ptr<PGresult, void (*)(PGresult*)> r(PQexec(db.get(), sql.c_str()), PQclear);
    const auto status = PQresultStatus(r.get());
    if (status != PGRES_TUPLES_OK && status != PGRES_COMMAND_OK)
      throw std::runtime_error(PQerrorMessage(db.get()));
    std::vector<std::vector<std::string>> rows(1);
    const int columns = PQnfields(r.get());
    for (int c = 0; c < columns; ++c) rows[0].emplace_back(PQfname(r.get(), c));
    for (int i = 0; i < PQntuples(r.get()); ++i) {
      auto& row = rows.emplace_back();
      for (int c = 0; c < columns; ++c) row.emplace_back(PQgetvalue(r.get(), i, c));
    }
    return rows;
  }

 private:
  static std::string getenv_or(const char* name, const char* otherwise) {
    const char* value = std::getenv(name);
    return value ? value : otherwise;
  }

  /// The folder of initdb and pg_ctl; Debian keeps them out of the search path. Empty: none.
  static std::string find_programs() {
    std::error_code ec;
    for (int version = 30; version >= 15; --version) {
      const std::string folder = fmt::format("/usr/lib/postgresql/{}/bin", version);
      if (std::filesystem::exists(folder + "/initdb", ec)) return folder;
    }
    return {};
  }

  static int free_port() {
    const int s = ::socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in a{};
    a.sin_family = AF_INET;
    a.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof a;
    const bool bound = ::bind(s, reinterpret_cast<sockaddr*>(&a), size) == 0 &&
                       ::getsockname(s, reinterpret_cast<sockaddr*>(&a), &size) == 0;
    ::close(s);
    if (!bound) throw std::runtime_error("no free port for PostgreSQL");
    return ntohs(a.sin_port);
  }

  void run_here(const std::string& command) const {
    const std::string quiet =
        fmt::format("cd / && {} >>{}/commands 2>&1 </dev/null", command, folder_.string());
    if (std::system(quiet.c_str()) != 0) throw std::runtime_error("failed: " + command);
  }
  void run(const std::string& command) const {
    run_here((::geteuid() == 0 ? "runuser -u postgres -- " : "") + find_programs() + "/" + command);
  }

  TemporaryFolder scratch_{"pg"};
  std::filesystem::path folder_ = scratch_.path();
  int port_ = 0;
  int count_ = 0;
};

}  // namespace eigengrasp::testing
