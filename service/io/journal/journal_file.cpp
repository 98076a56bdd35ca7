// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/journal/journal_file.hpp"

#include <fmt/format.h>
#include <sqlite3.h>

#include "service/io/files/atomic_file.hpp"
#include "service/io/files/binary.hpp"
#include "service/io/files/file_lock.hpp"
#include "service/io/journal/sqlite_database.hpp"

namespace qwsm::io {
namespace {

constexpr std::int64_t kApplicationId = 0x5157534D;  // "QWSM".
constexpr std::int64_t kVersion = 1;
constexpr std::string_view kSchema =
    "CREATE TABLE meta(key TEXT PRIMARY KEY, value TEXT NOT NULL);"
    "CREATE TABLE scan(position INTEGER PRIMARY KEY, service TEXT NOT NULL, robot TEXT NOT NULL,"
    " sequence INTEGER NOT NULL, stamp_ns INTEGER NOT NULL, contents BLOB NOT NULL,"
    " checksum INTEGER NOT NULL, UNIQUE(service, robot, sequence));";

std::int64_t ChecksumOf(const JournalEntry& entry) {
  BinaryWriter bytes;
  bytes.Add(entry.service);
  bytes.Add(entry.robot);
  bytes.Add(entry.sequence);
  bytes.Add(static_cast<std::int64_t>(entry.stamp.count()));
  bytes.Add(entry.contents);
  return Checksum(bytes.bytes());
}

[[noreturn]] void ThrowDamaged(const std::filesystem::path& file, const std::string& why) {
  throw JournalError(
      fmt::format("{}: is damaged: {}; move it away to begin a new one, or try to save what is in "
                  "it with `sqlite3 {} .recover`",
                  file.string(),
                  why,
                  file.string()));
}

// What can be mended by waiting, such as a full disk, apart from what cannot.
[[noreturn]] void Rethrow(const SqliteError& error, const std::filesystem::path& file) {
  switch (error.code()) {
    case SQLITE_NOTADB:
      throw JournalError(file.string() + ": is no journal of qwsm");
    case SQLITE_CORRUPT:
      ThrowDamaged(file, error.what());
    default:
      throw WriteError(fmt::format("{}: {}", file.string(), error.what()));
  }
}

void CheckFormat(SqliteDatabase& database, const std::filesystem::path& file) {
  if (database.Number("PRAGMA application_id") != kApplicationId) {
    throw JournalError(file.string() + ": is an SQLite database, but no journal of qwsm");
  }
  const std::int64_t version = database.Number("PRAGMA user_version");
  if (version != kVersion) {
    throw JournalError(
        fmt::format("{}: is a journal of version {}; this release of qwsm reads version {}",
                    file.string(),
                    version,
                    kVersion));
  }
}

bool IsNew(SqliteDatabase& database) {
  return database.Number("SELECT count(*) FROM sqlite_master") == 0;
}

void SetMeta(SqliteDatabase& database, std::string_view key, std::string_view value) {
  SqliteStatement statement = database.Prepare("INSERT INTO meta VALUES(?, ?)");
  statement.Bind(1, key);
  statement.Bind(2, value);
  statement.Step();
}

std::string GetMeta(SqliteDatabase& database, std::string_view key) {
  SqliteStatement statement = database.Prepare("SELECT value FROM meta WHERE key = ?");
  statement.Bind(1, key);
  return statement.Step() ? statement.Text(0) : std::string();
}

void Begin(SqliteDatabase& database, std::string_view kind, std::string_view identity) {
  database.Execute("BEGIN IMMEDIATE");
  if (IsNew(database)) {
    database.Execute(std::string(kSchema));
    SetMeta(database, "kind", kind);
    SetMeta(database, "identity", identity);
    database.Execute(fmt::format(
        "PRAGMA application_id = {}; PRAGMA user_version = {}", kApplicationId, kVersion));
  }
  database.Execute("COMMIT");
}

}  // namespace

struct JournalFile::State {
  State(std::filesystem::path path, SqliteDatabase::Access access)
      : file(std::move(path)), database(file, access) {}

  /// Whether a transaction is on the disk when it ends.
  void Wait(bool for_disk) {
    database.Execute(for_disk ? "PRAGMA synchronous = FULL" : "PRAGMA synchronous = NORMAL");
  }
  void Insert(const JournalEntry& entry);

  std::filesystem::path file;
  std::unique_ptr<FileLock> lock;
  SqliteDatabase database;
  std::string identity;
  std::optional<SqliteStatement> append;
  std::int64_t last_position = 0;  // Of those that were read.
  std::size_t damaged = 0;
};

void JournalFile::State::Insert(const JournalEntry& entry) {
  if (!append) {
    append = database.Prepare(
        "INSERT OR IGNORE INTO scan(service, robot, sequence, stamp_ns, contents, checksum)"
        " VALUES(?, ?, ?, ?, ?, ?)");
  }
  append->Reset();
  append->Bind(1, entry.service);
  append->Bind(2, entry.robot);
  append->Bind(3, static_cast<std::int64_t>(entry.sequence));
  append->Bind(4, static_cast<std::int64_t>(entry.stamp.count()));
  append->BindBlob(5, entry.contents);
  append->Bind(6, ChecksumOf(entry));
  append->Step();
  append->Reset();
}

JournalFile::JournalFile(std::unique_ptr<State> state) : state_(std::move(state)) {}
JournalFile::JournalFile(JournalFile&&) noexcept = default;
JournalFile& JournalFile::operator=(JournalFile&&) noexcept = default;
JournalFile::~JournalFile() = default;

JournalFile JournalFile::Continue(const std::filesystem::path& file,
                                  std::string_view kind,
                                  std::string_view identity) {
  auto lock = std::make_unique<FileLock>(file.string() + ".lock");
  if (lock->is_held_elsewhere()) {
    throw JournalError(file.string() + ": is in use by another service; each needs its own");
  }
  try {
    auto state = std::make_unique<State>(file, SqliteDatabase::Access::kReadWrite);
    state->lock = std::move(lock);
    SqliteDatabase& database = state->database;
    if (!IsNew(database)) CheckFormat(database, file);
    database.Execute("PRAGMA journal_mode = WAL");
    Begin(database, kind, identity);
    return Opened(std::move(state), kind);
  } catch (const SqliteError& error) {
    Rethrow(error, file);
  }
}

JournalFile JournalFile::Read(const std::filesystem::path& file, std::string_view kind) {
  try {
    auto state = std::make_unique<State>(file, SqliteDatabase::Access::kReadOnly);
    CheckFormat(state->database, file);
    return Opened(std::move(state), kind);
  } catch (const SqliteError& error) {
    try {
      Rethrow(error, file);
    } catch (const WriteError& unwritable) {
      throw JournalError(std::string(unwritable.what()) +
                         "; to read a journal its folder must be writable");
    }
  }
}

JournalFile JournalFile::Opened(std::unique_ptr<State> state, std::string_view kind) {
  const std::string found = GetMeta(state->database, "kind");
  if (found != kind) {
    throw JournalError(
        fmt::format("{}: is a journal of {}, not of {}", state->file.string(), found, kind));
  }
  state->identity = GetMeta(state->database, "identity");
  return JournalFile(std::move(state));
}

const std::string& JournalFile::identity() const { return state_->identity; }
std::size_t JournalFile::damaged() const { return state_->damaged; }

std::size_t JournalFile::size() const {
  return static_cast<std::size_t>(state_->database.Number("SELECT count(*) FROM scan"));
}

void JournalFile::Append(std::span<const JournalEntry> entries) {
  State& state = *state_;
  try {
    for (const JournalEntry& entry : entries) {
      // The last one takes those before it along to the disk.
      state.Wait(&entry == &entries.back());
      state.Insert(entry);
    }
  } catch (const SqliteError& error) {
    state.append.reset();
    state.database.RollBack();
    Rethrow(error, state.file);
  }
}

std::optional<JournalEntry> JournalFile::Next() {
  State& state = *state_;
  try {
    // A statement of its own each time: an open one would keep the log from being tidied up.
    for (;;) {
      SqliteStatement select = state.database.Prepare(
          "SELECT position, service, robot, sequence, stamp_ns, contents, checksum FROM scan"
          " WHERE position > ? ORDER BY position LIMIT 1");
      select.Bind(1, state.last_position);
      if (!select.Step()) return std::nullopt;
      state.last_position = select.Integer(0);
      JournalEntry entry{.service = select.Text(1),
                         .robot = select.Text(2),
                         .sequence = static_cast<std::uint64_t>(select.Integer(3)),
                         .stamp = std::chrono::nanoseconds(select.Integer(4)),
                         .contents = select.Blob(5)};
      if (ChecksumOf(entry) == select.Integer(6)) return entry;
      ++state.damaged;
    }
  } catch (const SqliteError& error) {
    ThrowDamaged(state.file, error.what());
  }
}

}  // namespace qwsm::io
