// SPDX-License-Identifier: BSD-3-Clause
// SQLite calls with their results checked.
#include "acquisition/sqlite.hpp"

#include <fmt/format.h>
#include <sqlite3.h>

#include "brdf/error.hpp"

namespace gonio::acquisition::sqlite {

void Database::Closer::operator()(sqlite3* database) const noexcept { sqlite3_close(database); }
void Statement::Finalizer::operator()(sqlite3_stmt* statement) const noexcept { sqlite3_finalize(statement); }

Database::Database(const std::filesystem::path& path, Mode mode, const std::string& vfs) : path_(path.string()) {
  const int flags = mode == Mode::create ? SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE : SQLITE_OPEN_READWRITE;
  sqlite3* database = nullptr;
  const int code = sqlite3_open_v2(path_.c_str(), &database, flags, vfs.empty() ? nullptr : vfs.c_str());
  database_.reset(database);
  if (code != SQLITE_OK) fail(code);
  sqlite3_extended_result_codes(database, 1);
  if (mode == Mode::read) execute("PRAGMA query_only = ON");
}

void Database::fail(int code) const {
  const std::string found = fmt::format("{} (SQLite {})", database_ ? sqlite3_errmsg(database_.get()) : sqlite3_errstr(code), code);
  switch (code & 0xff) {
    case SQLITE_CONSTRAINT: throw Error(ErrorKind::internal, Fault{path_, found, "a row that meets the schema of a run"});
    case SQLITE_BUSY:
    case SQLITE_LOCKED: throw Error(ErrorKind::input, Fault{path_, found, "a run file that no other program is writing"});
    case SQLITE_FULL:
    case SQLITE_IOERR: throw Error(ErrorKind::input, Fault{path_, found, "a disk that takes the reading"});
    default: throw Error(ErrorKind::input, Fault{path_, found, "a run file (.gonio)"});
  }
}

void Database::execute(const std::string& sql) {
  if (const int code = sqlite3_exec(database_.get(), sql.c_str(), nullptr, nullptr, nullptr); code != SQLITE_OK) fail(code);
}

Statement Database::prepare(std::string_view sql) {
  sqlite3_stmt* statement = nullptr;
  if (const int code = sqlite3_prepare_v2(database_.get(), sql.data(), static_cast<int>(sql.size()), &statement, nullptr);
      code != SQLITE_OK) {
    fail(code);
  }
  return {*this, statement};
}

void Statement::check(int code) const {
  if (code == SQLITE_OK) return;
  sqlite3_reset(statement_.get());
  database_->fail(code);
}

Statement& Statement::bind(std::int64_t value) {
  check(sqlite3_bind_int64(statement_.get(), ++bound_, value));
  return *this;
}

Statement& Statement::bind(double value) {
  check(sqlite3_bind_double(statement_.get(), ++bound_, value));
  return *this;
}

Statement& Statement::bind(const std::string& value) {
  check(sqlite3_bind_text(statement_.get(), ++bound_, value.data(), static_cast<int>(value.size()), SQLITE_TRANSIENT));
  return *this;
}

Statement& Statement::bind_null() {
  check(sqlite3_bind_null(statement_.get(), ++bound_));
  return *this;
}

bool Statement::step() {
  const int code = sqlite3_step(statement_.get());
  if (code == SQLITE_ROW) return true;
  bound_ = 0;
  if (code == SQLITE_DONE) {
    sqlite3_reset(statement_.get());
    return false;
  }
  sqlite3_reset(statement_.get());
  database_->fail(code);
}

std::int64_t Statement::integer(int column) const { return sqlite3_column_int64(statement_.get(), column); }
double Statement::real(int column) const { return sqlite3_column_double(statement_.get(), column); }

std::string Statement::text(int column) const {
  const unsigned char* text = sqlite3_column_text(statement_.get(), column);
  return text ? std::string(reinterpret_cast<const char*>(text), static_cast<std::size_t>(sqlite3_column_bytes(statement_.get(), column)))
              : std::string();
}

bool Statement::is_null(int column) const { return sqlite3_column_type(statement_.get(), column) == SQLITE_NULL; }

}  // namespace gonio::acquisition::sqlite
