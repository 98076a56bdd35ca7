// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>

struct sqlite3;
struct sqlite3_stmt;

namespace qwsm::io {

/// Tells what SQLite complains about; see sqlite3.h for the codes.
class SqliteError : public std::runtime_error {
 public:
  SqliteError(int code, const std::string& text) : std::runtime_error(text), code_(code) {}
  int code() const { return code_; }

 private:
  int code_;
};

/// A prepared statement. Parameters are counted from 1, columns from 0, as SQLite does.
/// All functions throw SqliteError.
class SqliteStatement {
 public:
  void Bind(int parameter, std::int64_t value);
  void Bind(int parameter, std::string_view text);
  void BindBlob(int parameter, std::string_view bytes);

  /// Runs the statement to the next row. @return false at the end.
  bool Step();
  /// Makes the statement ready to be run again.
  void Reset();

  std::int64_t Integer(int column) const;
  std::string Text(int column) const;
  /// Valid until the statement goes on.
  std::string_view Blob(int column) const;

 private:
  friend class SqliteDatabase;
  struct Finalize {
    void operator()(sqlite3_stmt* statement) const;
  };
  SqliteStatement(sqlite3* database, std::string_view sql);
  void Check(int code) const;

  sqlite3* database_;
  std::unique_ptr<sqlite3_stmt, Finalize> statement_;
};

/// A connection to a database file, for one thread at a time.
class SqliteDatabase {
 public:
  enum class Access {
    kReadOnly,
    kReadWrite,  ///< Opens to read and write; creates the database where there is none.
  };

  /// Opens a database. @throws SqliteError, as all functions of the class do.
  SqliteDatabase(const std::filesystem::path& file, Access access);

  /// Runs statements that give no rows.
  void Execute(const std::string& sql);
  SqliteStatement Prepare(std::string_view sql);
  /// The one number that a query such as `PRAGMA user_version` gives.
  std::int64_t Number(std::string_view sql);
  /// Gives up a transaction, if one is open.
  void RollBack() noexcept;

 private:
  struct Close {
    void operator()(sqlite3* database) const;
  };
  std::unique_ptr<sqlite3, Close> database_;
};

/// Whether the file begins as SQLite's databases do. False where it cannot be read.
bool IsSqliteDatabase(const std::filesystem::path& file);

}  // namespace qwsm::io
