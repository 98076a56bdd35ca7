// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/journal/sqlite_database.hpp"

#include <sqlite3.h>

#include <array>
#include <fstream>

namespace qwsm::io {
namespace {

constexpr int kBusyTimeout_ms = 2000;
constexpr std::string_view kMagic{"SQLite format 3\0", 16};

// The system's reason says more than SQLite's "disk I/O error".
std::string Explain(sqlite3* database) {
  std::string text = sqlite3_errmsg(database);
  if (sqlite3_errcode(database) == SQLITE_IOERR || sqlite3_errcode(database) == SQLITE_CANTOPEN) {
    const int reason = sqlite3_system_errno(database);
    if (reason != 0) text += " (" + std::generic_category().message(reason) + ")";
  }
  return text;
}

// To SQLite a null pointer is no value at all, not an empty one.
const char* NeverNull(std::string_view text) { return text.data() != nullptr ? text.data() : ""; }

}  // namespace

void SqliteStatement::Finalize::operator()(sqlite3_stmt* statement) const {
  sqlite3_finalize(statement);
}

SqliteStatement::SqliteStatement(sqlite3* database, std::string_view sql) : database_(database) {
  sqlite3_stmt* statement = nullptr;
  Check(
      sqlite3_prepare_v2(database, sql.data(), static_cast<int>(sql.size()), &statement, nullptr));
  statement_.reset(statement);
}

void SqliteStatement::Check(int code) const {
  if (code != SQLITE_OK) throw SqliteError(code & 0xFF, Explain(database_));
}

void SqliteStatement::Bind(int parameter, std::int64_t value) {
  Check(sqlite3_bind_int64(statement_.get(), parameter, value));
}

void SqliteStatement::Bind(int parameter, std::string_view text) {
  const int size = static_cast<int>(text.size());
  Check(sqlite3_bind_text(statement_.get(), parameter, NeverNull(text), size, SQLITE_TRANSIENT));
}

void SqliteStatement::BindBlob(int parameter, std::string_view bytes) {
  const int size = static_cast<int>(bytes.size());
  Check(sqlite3_bind_blob(statement_.get(), parameter, NeverNull(bytes), size, SQLITE_TRANSIENT));
}

bool SqliteStatement::Step() {
  const int code = sqlite3_step(statement_.get());
  if (code == SQLITE_ROW) return true;
  if (code != SQLITE_DONE) Check(code);
  return false;
}

void SqliteStatement::Reset() { sqlite3_reset(statement_.get()); }

std::int64_t SqliteStatement::Integer(int column) const {
  return sqlite3_column_int64(statement_.get(), column);
}

std::string SqliteStatement::Text(int column) const { return std::string(Blob(column)); }

std::string_view SqliteStatement::Blob(int column) const {
  const void* bytes = sqlite3_column_blob(statement_.get(), column);
  const auto size = static_cast<std::size_t>(sqlite3_column_bytes(statement_.get(), column));
  return {static_cast<const char*>(bytes), size};
}

void SqliteDatabase::Close::operator()(sqlite3* database) const { sqlite3_close_v2(database); }

SqliteDatabase::SqliteDatabase(const std::filesystem::path& file, Access access) {
  const int flags = access == Access::kReadOnly ? SQLITE_OPEN_READONLY
                                                : SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE;
  sqlite3* database = nullptr;
  const int code = sqlite3_open_v2(file.c_str(), &database, flags, nullptr);
  database_.reset(database);
  if (code != SQLITE_OK) throw SqliteError(code & 0xFF, Explain(database));
  sqlite3_busy_timeout(database, kBusyTimeout_ms);
}

void SqliteDatabase::Execute(const std::string& sql) {
  const int code = sqlite3_exec(database_.get(), sql.c_str(), nullptr, nullptr, nullptr);
  if (code != SQLITE_OK) throw SqliteError(code & 0xFF, Explain(database_.get()));
}

SqliteStatement SqliteDatabase::Prepare(std::string_view sql) { return {database_.get(), sql}; }

std::int64_t SqliteDatabase::Number(std::string_view sql) {
  SqliteStatement statement = Prepare(sql);
  return statement.Step() ? statement.Integer(0) : 0;
}

void SqliteDatabase::RollBack() noexcept {
  if (sqlite3_get_autocommit(database_.get()) == 0) {
    sqlite3_exec(database_.get(), "ROLLBACK", nullptr, nullptr, nullptr);
  }
}

bool IsSqliteDatabase(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) return false;
  std::array<char, kMagic.size()> start{};
  std::ifstream stream(file, std::ios::binary);
  stream.read(start.data(), start.size());
  return stream && std::string_view(start.data(), start.size()) == kMagic;
}

}  // namespace qwsm::io
