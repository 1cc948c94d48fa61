// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Bad input to stores: one clear sentence, and the store as it was.
#include <sqlite3.h>
#include <sys/stat.h>

#include <fstream>

#include "eigengrasp/core/files.hpp"
#include "store/store_fixture.hpp"

namespace eigengrasp {
namespace {

namespace fs = std::filesystem;
using testing::expect_sentence;
using testing::PostgresServer;

/// Not root while one lives: root may write everywhere.
class PlainUser {
 public:
  PlainUser() : root_(::geteuid() == 0) {
    if (root_ && ::seteuid(65534) != 0) throw std::runtime_error("seteuid");
  }
  ~PlainUser() {
    if (root_ && ::seteuid(0) != 0) std::abort();
  }

 private:
  bool root_;
};

class BadStores : public testing::StoreFixture {
 protected:
  std::string open_error(const std::string& address, StoreAccess access = StoreAccess::write) {
    return error_of([&] { open_store(address, {.access = access, .lock_seconds = 0.1}); });
  }
  /// A store of some grasps. @returns its address
  std::string filled(const std::string& kind) {
    const std::string address = new_address(kind);
    const auto store = open_store(address);
    fill_tables(*store);
    store->finish_unit(done({"glass", 1.0, "human"}, 40, 1));
    return address;
  }
  static std::string path_of(const std::string& address) { return address.substr(address.find(':') + 1); }
  static void run_sqlite(const std::string& file, const std::string& sql) {
    sqlite3* db = nullptr;
    ASSERT_EQ(sqlite3_open(file.c_str(), &db), SQLITE_OK);
    ASSERT_EQ(sqlite3_exec(db, sql.c_str(), nullptr, nullptr, nullptr), SQLITE_OK);
    sqlite3_close(db);
  }
  void expect_intact(const std::string& address) {
    EXPECT_EQ(open_store(address, {.access = StoreAccess::read})->grasps("glass", "human").size(), 40u);
  }
};

TEST_F(BadStores, addresses_of_no_known_form) {
  for (const char* address : {"", "grasps.db", "sqlite:", "mysql://host/db", "text:"})
    expect_sentence(open_error(address), {"sqlite:FILE", "text:FOLDER", "postgresql://"});
}

TEST_F(BadStores, a_missing_store_is_not_made_by_reading) {
  const std::string file = (folder_ / "none.db").string(), folder = (folder_ / "none").string();
  expect_sentence(open_error("sqlite:" + file, StoreAccess::read), {file, "no such file"});
  expect_sentence(open_error("text:" + folder, StoreAccess::read), {folder, "no grasp store"});
  expect_sentence(open_error("sqlite:/no/such/folder/g.db"), {"/no/such/folder", "cannot be opened"});
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(BadStores, foreign_files_and_folders_stay_as_they_are) {
  write_file_atomically(folder_ / "notes.txt", "The quick brown fox jumps over the lazy dog.\n");
  expect_sentence(open_error("sqlite:" + (folder_ / "notes.txt").string()), {"notes.txt", "no grasp store"});
  EXPECT_EQ(read_text_file(folder_ / "notes.txt"), "The quick brown fox jumps over the lazy dog.\n");
  expect_sentence(open_error("text:" + folder_.string()), {"other files", "empty or a new folder"});
  expect_sentence(open_error("text:" + (folder_ / "notes.txt").string()), {"notes.txt", "folder"});
  expect_sentence(open_error("sqlite:" + folder_.string()), {"is a folder"});
  run_sqlite((folder_ / "other.db").string(), "CREATE TABLE grasp (x)");
  const std::string before = read_text_file(folder_ / "other.db");
  expect_sentence(open_error("sqlite:" + (folder_ / "other.db").string()), {"another program"});
  EXPECT_EQ(read_text_file(folder_ / "other.db"), before);
}

TEST_F(BadStores, truncated_sqlite_files) {
  const std::string address = filled("sqlite"), file = path_of(address);
  const std::string whole = read_text_file(file);
  for (const double share : {0.9, 0.5, 0.1, 0.0001}) {
    fs::resize_file(file, static_cast<std::uintmax_t>(share * static_cast<double>(whole.size())));
    if (share > 0.001) expect_sentence(open_error(address), {file, "cut short"});
    if (share < 0.001) expect_sentence(open_error(address), {file});
  }
  write_file_atomically(file, whole);
  expect_intact(address);
  std::string garbled = whole;
  for (std::size_t i = 4096; i < garbled.size(); ++i) garbled[i] = static_cast<char>(i * 7);
  write_file_atomically(file, garbled);
  const std::string sentence = error_of([&] { open_store(address)->grasps("glass", "human"); });
  expect_sentence(sentence, {file, "damaged", "copy"});
}

TEST_F(BadStores, a_locked_sqlite_file) {
  const std::string address = filled("sqlite");
  sqlite3* other = nullptr;
  ASSERT_EQ(sqlite3_open(path_of(address).c_str(), &other), SQLITE_OK);
  ASSERT_EQ(sqlite3_exec(other, "BEGIN IMMEDIATE", nullptr, nullptr, nullptr), SQLITE_OK);
  const auto store = open_store(address, {.lock_seconds = 0.1});
  EXPECT_EQ(store->grasps("glass", "human").size(), 40u);  // reading goes on
  expect_sentence(error_of([&] {
                    store->finish_unit(done({"psb_12", 1.0, "human"}, 1, 2));
                  }),
                  {"locked by another program", "0.1 s"});
  sqlite3_close(other);
  EXPECT_TRUE(store->finish_unit(done({"psb_12", 1.0, "human"}, 1, 2)));
}

TEST_F(BadStores, a_read_only_folder) {
  const std::string sqlite = filled("sqlite"), text = filled("text");
  fs::permissions(folder_, fs::perms(0555));
  for (const auto& entry : fs::recursive_directory_iterator(folder_))
    fs::permissions(entry.path(), entry.is_directory() ? fs::perms(0555) : fs::perms(0444));
  {
    const PlainUser user;
    expect_sentence(open_error("sqlite:" + (folder_ / "new.db").string()), {"new.db", "may you write"});
    expect_sentence(open_error("text:" + (folder_ / "new").string()), {"new", "cannot be made"});
    expect_sentence(open_error(sqlite), {path_of(sqlite), "cannot be"});
    expect_sentence(open_error(text), {path_of(text), "cannot be written"});
    expect_intact(sqlite);
    expect_intact(text);
  }
  fs::permissions(folder_, fs::perms(0755));
}

TEST_F(BadStores, a_newer_schema) {
  const std::string sqlite = filled("sqlite"), text = filled("text");
  run_sqlite(path_of(sqlite), "UPDATE eigengrasp_schema SET schema_version = 7");
  const fs::path mark = fs::path(path_of(text)) / "eigengrasp-store.jsonl";
  write_file_atomically(mark, "{\"eigengrasp\":\"store\",\"version\":7,\"records\":0}\n");
  std::vector<std::string> addresses = {sqlite, text};
  if (available("postgresql")) {
    addresses.push_back(filled("postgresql"));
    PostgresServer::query(addresses.back(), "UPDATE eigengrasp_schema SET schema_version = 7");
  }
  for (const std::string& address : addresses)
    for (const StoreAccess access : {StoreAccess::read, StoreAccess::write})
      expect_sentence(open_error(address, access), {"is of version 7", "newer eigengrasp"});
  run_sqlite(path_of(sqlite), "UPDATE eigengrasp_schema SET schema_version = 2");
  expect_intact(sqlite);
}

TEST_F(BadStores, an_older_schema_is_brought_up_to_date) {
  std::vector<std::string> addresses = {filled("sqlite")};
  run_sqlite(path_of(addresses.front()), "DROP TABLE descriptor");
  run_sqlite(path_of(addresses.front()), "UPDATE eigengrasp_schema SET schema_version = 1");
  if (available("postgresql")) {
    addresses.push_back(filled("postgresql"));
    PostgresServer::query(addresses.back(), "DROP TABLE descriptor");
    PostgresServer::query(addresses.back(), "UPDATE eigengrasp_schema SET schema_version = 1");
  }
  for (const std::string& address : addresses) {
    expect_sentence(open_error(address, StoreAccess::read), {"older version 1", "db describe"});
    open_store(address);  // to write
    expect_intact(address);
    EXPECT_TRUE(open_store(address, {.access = StoreAccess::read})->descriptors("").empty());
  }
}

TEST_F(BadStores, a_text_line_cut_in_half) {
  const std::string address = filled("text");
  const fs::path file = fs::path(path_of(address)) / "grasps" / "glass" / "human@1.jsonl";
  const std::string whole = read_text_file(file);
  std::size_t line_20 = 0;
  for (int i = 0; i < 19; ++i) line_20 = whole.find('\n', line_20) + 1;
  const auto read = [&] { return error_of([&] { open_store(address)->grasps("glass", "human"); }); };
  write_file_atomically(file, whole.substr(0, line_20 + 300));
  expect_sentence(read(), {"human@1.jsonl:20", "cut in its middle"});
  write_file_atomically(file, whole.substr(0, line_20));
  expect_sentence(read(), {"human@1.jsonl:20", "line is missing"});
  const std::size_t line_21 = whole.find('\n', line_20);
  write_file_atomically(file, whole.substr(0, line_20 + 300) + whole.substr(line_21));
  expect_sentence(read(), {"human@1.jsonl:20", "cut or damaged"});
  write_file_atomically(file, whole + "{}\n");
  expect_sentence(read(), {"human@1.jsonl:42", "more lines"});
  write_file_atomically(file, "");
  expect_sentence(read(), {"human@1.jsonl", "head"});
  const fs::path models = fs::path(path_of(address)) / "models.jsonl";
  const std::string all_models = read_text_file(models);
  write_file_atomically(file, whole);
  write_file_atomically(models, all_models.substr(0, all_models.size() / 2));
  expect_sentence(read(), {"models.jsonl:2", "cut in its middle"});
  write_file_atomically(models, all_models);
  expect_intact(address);
}

TEST_F(BadStores, a_text_store_in_use) {
  const std::string address = filled("text");
  const auto writer = open_store(address);
  expect_sentence(open_error(address), {"in use by another program", "one writer"});
}

class BadServers : public BadStores {
 protected:
  void SetUp() override {
    if (!available("postgresql")) GTEST_SKIP() << PostgresServer::why_none();
  }
};

TEST_F(BadServers, wrong_password_missing_database_and_no_server) {
  const PostgresServer& server = *PostgresServer::instance();
  const std::string wrong = open_error(server.address("postgres", "wr0ng"));
  expect_sentence(wrong, {"name or password", "grasp@127.0.0.1"});
  EXPECT_EQ(wrong.find("wr0ng"), std::string::npos) << wrong;
  expect_sentence(open_error(server.address("no_such")), {"no_such", "no such database", "createdb"});
  expect_sentence(open_error("postgresql://grasp:secret@127.0.0.1:1/x"),
                  {"127.0.0.1:1", "no PostgreSQL server"});
}

TEST_F(BadServers, a_database_of_another_program_or_without_a_store) {
  const std::string address = new_address("postgresql");
  expect_sentence(open_error(address, StoreAccess::read), {"no grasp store", "add-objects"});
  PostgresServer::query(address, "CREATE TABLE grasp (x INTEGER)");
  expect_sentence(open_error(address), {"another program"});
  EXPECT_EQ(PostgresServer::query(address,
                                  "SELECT count(*) FROM information_schema.tables WHERE table_schema = "
                                  "'public'")[1][0],
            "1");
}

TEST_F(BadServers, a_lock_of_another_client) {
  const std::string address = filled("postgresql");
  const std::unique_ptr<PGconn, void (*)(PGconn*)> other(PQconnectdb(address.c_str()), PQfinish);
  PQclear(PQexec(other.get(), "BEGIN; LOCK TABLE grasp_source"));
  const auto store = open_store(address, {.lock_seconds = 0.1});
  expect_sentence(error_of([&] { store->add_source({"x", ""}); }), {"locked by another program"});
  PQclear(PQexec(other.get(), "ROLLBACK"));
  EXPECT_TRUE(store->add_source({"x", ""}));
}

TEST_F(BadServers, a_server_that_goes_and_comes_back) {
  const std::string address = filled("postgresql");
  const auto store = open_store(address, {.retry_seconds = 0.0});
  EXPECT_EQ(store->counts().grasps, 40);
  PostgresServer::instance()->stop();
  expect_sentence(error_of([&] {
                    store->finish_unit(done({"psb_12", 1.0, "human"}, 1, 2));
                  }),
                  {"127.0.0.1", "server"});
  PostgresServer::instance()->start();
  error_of([&] { store->counts(); });  // may still notice the loss
  EXPECT_TRUE(store->finish_unit(done({"psb_12", 1.0, "human"}, 1, 2)));
  EXPECT_EQ(store->counts().grasps, 41);
}

}  // namespace
}  // namespace eigengrasp
