// SPDX-License-Identifier: BSD-3-Clause
// The little of SQLite that the run store needs, with errors as exceptions.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

struct sqlite3;
struct sqlite3_stmt;

namespace gonio::acquisition::sqlite {

class Statement;

/// A connection. Reading, too, opens the file for writing where it may: a writer that was killed leaves a journal that only a writer can
/// fold back; SQLite itself falls back to reading only where the file is write-protected.
/// Failures are Error(input) naming the file, SQLite's message and what was wanted; a violated constraint is Error(internal).
class Database {
 public:
  enum class Mode { read, write, create };
  Database(const std::filesystem::path& path, Mode mode, const std::string& vfs);

  /// Executes statements without results.
  void execute(const std::string& sql);
  Statement prepare(std::string_view sql);
  const std::string& path() const { return path_; }
  [[noreturn]] void fail(int code) const;

 private:
  struct Closer {
    void operator()(sqlite3* database) const noexcept;
  };
  std::string path_;
  std::unique_ptr<sqlite3, Closer> database_;
};

/// A prepared statement; bind in order, then step through the rows.
class Statement {
 public:
  Statement& bind(std::int64_t value);
  Statement& bind(double value);  ///< NaN is refused by NOT NULL columns
  Statement& bind(const std::string& value);
  Statement& bind_null();
  /// True: a row is there. False: done, and the statement may be bound anew.
  bool step();
  std::int64_t integer(int column) const;
  double real(int column) const;
  std::string text(int column) const;
  bool is_null(int column) const;

 private:
  friend class Database;
  Statement(const Database& database, sqlite3_stmt* statement) : database_(&database), statement_(statement) {}
  void check(int code) const;

  struct Finalizer {
    void operator()(sqlite3_stmt* statement) const noexcept;
  };
  const Database* database_;
  std::unique_ptr<sqlite3_stmt, Finalizer> statement_;
  int bound_ = 0;
};

}  // namespace gonio::acquisition::sqlite
