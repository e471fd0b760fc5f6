// SPDX-License-Identifier: BSD-3-Clause
// The run store's SQL in a real SQLite: what it takes and what it refuses.
#include <fmt/format.h>
#include <sqlite3.h>

#include "data-schemas/document.hpp"
#include "tests/check.hpp"

namespace {

class Database {
 public:
  Database() { sqlite3_open(":memory:", &handle_); }
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;
  ~Database() { sqlite3_close(handle_); }

  bool takes(const std::string& sql) { return sqlite3_exec(handle_, sql.c_str(), nullptr, nullptr, nullptr) == SQLITE_OK; }
  std::string value(const std::string& sql) {
    sqlite3_stmt* statement = nullptr;
    sqlite3_prepare_v2(handle_, sql.c_str(), -1, &statement, nullptr);
    std::string text;
    if (sqlite3_step(statement) == SQLITE_ROW) text = reinterpret_cast<const char*>(sqlite3_column_text(statement, 0));
    sqlite3_finalize(statement);
    return text;
  }

 private:
  sqlite3* handle_ = nullptr;
};

std::string step(const std::string& number, const std::string& rest) {
  return "INSERT INTO step VALUES (" + number + ", " + number + ", " + rest + ")";
}
std::string reading(const std::string& step_attempt_repeat, const std::string& rest = "100, 1e-6, 0.1, 1e-3, '[1,2]', '[1.0,2.0]', 1, ''") {
  return "INSERT INTO reading VALUES (NULL, " + step_attempt_repeat + ", " + rest + ")";
}
const char* const good_step = "'sample', 30.0, 0.0, 30.0, 180.0, '[0.0,30.0]', 0.1, 'ok', '', 0.0, NULL";

}  // namespace

TEST_CASE("the run store is made and marked", "[run_sql]") {
  Database database;
  REQUIRE(database.takes(std::string(gonio::run_sql())));
  CHECK(database.value("PRAGMA application_id") == std::to_string(('g' << 24) | ('o' << 16) | ('n' << 8) | 'i'));
  CHECK(database.value("PRAGMA user_version") == "1");
  CHECK(database.value("SELECT group_concat(name) FROM (SELECT name FROM sqlite_schema WHERE type = 'table' ORDER BY name)") ==
        "calibration,event,meta,reading,step");
}

TEST_CASE("the column dictionary holds every table and every column of the run store", "[run_sql]") {
  const std::string dictionary = gonio::read_file(std::filesystem::path(GONIO_SOURCE_DIR) / "data-schemas" / "columns.md");
  Database database;
  REQUIRE(database.takes(std::string(gonio::run_sql())));
  for (const char* table : {"meta", "step", "reading", "event", "calibration"}) {
    const std::size_t start = dictionary.find("### `" + std::string(table) + "`");
    REQUIRE(start != std::string::npos);
    const std::string section = dictionary.substr(start, dictionary.find("\n### ", start) - start);
    int columns = 0;
    for (std::string name;
         !(name = database.value(fmt::format("SELECT name FROM pragma_table_info('{}') WHERE cid = {}", table, columns))).empty();
         ++columns) {
      INFO(table << '.' << name);
      CHECK(section.find('`' + name + '`') != std::string::npos);
    }
    CHECK(columns >= 2);
  }
}

TEST_CASE("a reading stands once for its step, attempt and repeat", "[run_sql]") {
  Database database;
  REQUIRE(database.takes(std::string(gonio::run_sql()) + "PRAGMA foreign_keys = ON;"));
  REQUIRE(database.takes(step("7", good_step)));
  CHECK(database.takes(reading("7, 0, 0")));
  CHECK_FALSE(database.takes(reading("7, 0, 0")));
  CHECK(database.takes(reading("7, 1, 0")));
  CHECK(database.takes(reading("7, 1, 1")));
  CHECK_FALSE(database.takes(reading("8, 0, 0")));
}

TEST_CASE("values of another type or outside their range are refused", "[run_sql]") {
  Database database;
  REQUIRE(database.takes(std::string(gonio::run_sql())));
  CHECK(database.takes(step("1", good_step)));
  CHECK(database.takes(step("2", "'sample', 30, 0, 30, 0, '[]', 0.1, 'masked', 'head in the beam', 0, 5")));
  CHECK_FALSE(database.takes(step("3", "'white', 30, 0, 30, 0, '[]', 0.1, 'ok', '', 0, NULL")));
  CHECK_FALSE(database.takes(step("3", "'sample', 'x', 0, 30, 0, '[]', 0.1, 'ok', '', 0, NULL")));
  CHECK_FALSE(database.takes(step("3", "'sample', 30, 0, 30, 0, '[', 0.1, 'ok', '', 0, NULL")));
  CHECK_FALSE(database.takes(step("3", "'sample', 30, 0, 30, 0, '[]', 0.0, 'ok', '', 0, NULL")));
  CHECK_FALSE(database.takes(step("3", "'sample', 30, 0, 30, 0, '[]', 0.1, 'masked', '', 0, NULL")));
  CHECK_FALSE(database.takes(reading("1, 0, 0", "100, NULL, 0.1, 1e-3, '[]', '[]', 1, ''")));
  CHECK_FALSE(database.takes(reading("1, 0, 0", "100, 1e-6, 0.1, 1e-3, '[]', '[]', 0, ''")));
  CHECK_FALSE(database.takes(reading("1, -1, 0")));
  CHECK(database.takes("INSERT INTO calibration VALUES ('reference_f', 0.31, NULL, '1/sr', 'certificate')"));
  CHECK_FALSE(database.takes("INSERT INTO calibration VALUES ('certificate', 0.31, 0.0, '1/sr', 'certificate')"));
}
