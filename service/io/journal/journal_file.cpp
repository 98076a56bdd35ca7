// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/journal/journal_file.hpp"

#include <fmt/format.h>
#include <sqlite3.h>
#include <sys/stat.h>

#include <algorithm>
#include <utility>

#include "service/io/files/atomic_file.hpp"
#include "service/io/files/file_lock.hpp"
#include "service/io/files/link_target.hpp"
#include "service/io/journal/journal_table.hpp"
#include "service/io/journal/mark_table.hpp"
#include "service/io/journal/sqlite_database.hpp"

namespace qwsm::io {
namespace {

constexpr std::int64_t kVersion = 1;

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
    case SQLITE_ERROR:  // A table is missing.
      ThrowDamaged(file, error.what());
    default:
      throw WriteError(fmt::format("{}: {}", file.string(), error.what()));
  }
}

void CheckFormat(SqliteDatabase& database, const std::filesystem::path& file) {
  if (database.Number("PRAGMA application_id") != kJournalApplicationId) {
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
    database.Execute("CREATE TABLE meta(key TEXT PRIMARY KEY, value TEXT NOT NULL);");
    JournalTable::Create(database);
    SetMeta(database, "kind", kind);
    SetMeta(database, "identity", identity);
    database.Execute(fmt::format(
        "PRAGMA application_id = {}; PRAGMA user_version = {}", kJournalApplicationId, kVersion));
  }
  database.Execute("COMMIT");
}

// Its index, too: one that claims an entry which is not there would keep it from being stored.
bool IsSound(SqliteDatabase& database) {
  SqliteStatement check = database.Prepare("PRAGMA integrity_check(1)");
  return check.Step() && check.Text(0) == "ok";
}

/// One service alone may write a journal, by whatever name.
std::unique_ptr<FileLock> LockOf(const std::filesystem::path& file) {
  auto lock = std::make_unique<FileLock>(TargetOf(file).string() + ".lock");
  if (lock->is_held_elsewhere()) {
    throw JournalError(file.string() + ": is in use by another service; each needs its own");
  }
  return lock;
}

/// Device and inode: what is under a name, however often it is written.
using FileNumber = std::pair<dev_t, ino_t>;

/// Nothing where there is no file of that name.
std::optional<FileNumber> NumberOf(const std::filesystem::path& file) {
  struct stat status {};
  if (stat(file.c_str(), &status) != 0) return std::nullopt;
  return FileNumber(status.st_dev, status.st_ino);
}

/// Removes the log of a database and its index.
void RemoveLogOf(const std::filesystem::path& file) {
  for (const char* part : {"-wal", "-shm"}) std::filesystem::remove(file.string() + part);
}

/// A name that nothing has yet, to keep a damaged file under.
std::filesystem::path NameForDamaged(const std::filesystem::path& file) {
  std::filesystem::path name = file.string() + ".damaged";
  for (int count = 2; std::filesystem::exists(name); ++count) {
    name = fmt::format("{}.damaged-{}", file.string(), count);
  }
  return name;
}

}  // namespace

struct JournalFile::State {
  State(std::filesystem::path path, SqliteDatabase::Access access)
      : file(std::move(path)), database(file, access), number(NumberOf(file)), table(database) {}

  /// Whether a transaction is on the disk when it ends.
  void Wait(bool for_disk) {
    database.Execute(for_disk ? "PRAGMA synchronous = FULL" : "PRAGMA synchronous = NORMAL");
  }

  std::filesystem::path file;
  std::unique_ptr<FileLock> lock;
  SqliteDatabase database;
  std::optional<FileNumber> number;  // Of the file that is open.
  JournalTable table;
  std::string identity;

  JournalTable::Extent extent;
  std::int64_t position = 0;    // Looked up so far, from 1 on.
  std::int64_t last_found = 0;  // Of the positions looked up.
  std::int64_t found = 0;

  std::filesystem::path damaged_copy;
  std::size_t lost_in_mending = 0;
};

JournalFile::JournalFile(std::unique_ptr<State> state) : state_(std::move(state)) {}
JournalFile::JournalFile(JournalFile&&) noexcept = default;
JournalFile& JournalFile::operator=(JournalFile&&) noexcept = default;
JournalFile::~JournalFile() = default;

JournalFile JournalFile::Continue(const std::filesystem::path& file,
                                  std::string_view kind,
                                  std::string_view identity) {
  std::unique_ptr<FileLock> lock = LockOf(file);
  try {
    JournalFile journal = OpenToWrite(file, kind, identity);
    if (!IsSound(journal.state_->database) || !journal.state_->table.CanGrow()) {
      journal = Mended(std::move(journal), kind);
    }
    journal.state_->lock = std::move(lock);
    return journal;
  } catch (const SqliteError& error) {
    Rethrow(error, file);
  } catch (const std::filesystem::filesystem_error& error) {
    throw WriteError(fmt::format(
        "{}: is damaged and cannot be mended: {}", file.string(), error.code().message()));
  }
}

JournalFile JournalFile::OpenToWrite(const std::filesystem::path& file,
                                     std::string_view kind,
                                     std::string_view identity) {
  auto state = std::make_unique<State>(file, SqliteDatabase::Access::kReadWrite);
  SqliteDatabase& database = state->database;
  if (!IsNew(database)) CheckFormat(database, file);
  database.Execute("PRAGMA journal_mode = WAL");
  // What is only appended to needs few pages at hand; kilobytes are told as negative numbers.
  database.Execute("PRAGMA cache_size = -256");
  Begin(database, kind, identity);
  return Opened(std::move(state), kind);
}

/// @return the number of marks that are lost.
std::size_t JournalFile::CopyTo(const std::filesystem::path& file, std::string_view kind) {
  std::filesystem::remove(file);  // Of an earlier attempt that was cut short.
  RemoveLogOf(file);
  std::size_t lost_marks = 0;
  const JournalFile copy = OpenToWrite(file, kind, identity());
  copy.state_->Wait(true);
  copy.state_->database.Execute("BEGIN");
  while (const auto entry = Next()) copy.state_->table.Insert(*entry);
  copy.state_->database.Execute("COMMIT");
  MarkTable(copy.state_->database).Put(MarkTable(state_->database).All(lost_marks));
  return lost_marks;
}

/// Whatever happens meanwhile, the file is there: the damaged one, or the mended one in its place.
JournalFile JournalFile::Mended(JournalFile damaged, std::string_view kind) {
  const std::filesystem::path file = damaged.state_->file;
  const std::filesystem::path target = TargetOf(file);
  const std::filesystem::path mended = target.string() + ".mended";
  const std::string identity = damaged.identity();
  const std::size_t lost_marks = damaged.CopyTo(mended, kind);
  const std::size_t lost = damaged.damaged() + lost_marks;
  damaged.state_->database.Execute("PRAGMA wal_checkpoint(TRUNCATE)");
  damaged.state_.reset();
  const std::filesystem::path kept = NameForDamaged(file);
  std::filesystem::copy_file(file, kept);
  // They stay where somebody else reads the journal, and the new one would take them as its own.
  RemoveLogOf(target);
  std::filesystem::rename(mended, target);
  JournalFile journal = OpenToWrite(file, kind, identity);
  journal.state_->damaged_copy = kept;
  journal.state_->lost_in_mending = lost;
  return journal;
}

bool JournalFile::IsInPlace() const { return NumberOf(state_->file) == state_->number; }

// SQLite still reads what is in a file that has no name any more.
void JournalFile::WriteAnew(std::string_view kind) {
  State& state = *state_;
  const std::filesystem::path target = TargetOf(state.file);
  if (NumberOf(target)) {
    throw JournalError(state.file.string() +
                       ": is another file than the one that was opened; move it away");
  }
  try {
    state.lock.reset();  // It may have gone with the file.
    std::unique_ptr<FileLock> lock = LockOf(state.file);
    state.extent = {};
    state.position = state.last_found = state.found = 0;
    const std::filesystem::path anew = target.string() + ".anew";
    CopyTo(anew, kind);
    RemoveLogOf(target);
    std::filesystem::rename(anew, target);
    state.number = NumberOf(target);  // Whoever opens it again goes on with that.
    JournalFile journal = OpenToWrite(state.file, kind, identity());
    journal.state_->lock = std::move(lock);
    *this = std::move(journal);
  } catch (const SqliteError& error) {
    Rethrow(error, state.file);
  } catch (const std::filesystem::filesystem_error& error) {
    throw WriteError(
        fmt::format("{}: cannot be written anew: {}", state.file.string(), error.code().message()));
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
  if (found.empty()) ThrowDamaged(state->file, "it does not say of what it is a journal");
  if (found != kind) {
    throw JournalError(
        fmt::format("{}: is a journal of {}, not of {}", state->file.string(), found, kind));
  }
  state->identity = GetMeta(state->database, "identity");
  return JournalFile(std::move(state));
}

const std::string& JournalFile::identity() const { return state_->identity; }

const std::filesystem::path& JournalFile::damaged_copy() const { return state_->damaged_copy; }

std::size_t JournalFile::damaged() const {
  const State& state = *state_;
  const std::int64_t claimed = std::min(state.position, state.extent.claimed.value_or(0));
  return state.lost_in_mending +
         static_cast<std::size_t>(std::max(state.last_found, claimed) - state.found);
}

std::size_t JournalFile::size() const {
  return static_cast<std::size_t>(state_->table.Measure().claimed.value_or(0));
}

void JournalFile::Append(std::span<const JournalEntry> entries) {
  State& state = *state_;
  try {
    for (const JournalEntry& entry : entries) {
      // The last one takes those before it along to the disk.
      state.Wait(&entry == &entries.back());
      state.table.Insert(entry);
    }
  } catch (const SqliteError& error) {
    state.table.GiveUpInsertion();
    state.database.RollBack();
    Rethrow(error, state.file);
  }
}

std::optional<JournalEntry> JournalFile::Next() {
  State& state = *state_;
  try {
    // Somebody else may be writing it.
    if (state.position >= state.extent.last_position) state.extent = state.table.Measure();
    while (state.position < state.extent.last_position) {
      std::optional<JournalEntry> entry = state.table.Find(++state.position);
      if (!entry) continue;
      state.last_found = state.position;
      ++state.found;
      return entry;
    }
  } catch (const SqliteError& error) {
    throw JournalError(fmt::format("{}: cannot be read: {}", state.file.string(), error.what()));
  }
  if (!state.extent.claimed && state.found == 0) {
    ThrowDamaged(state.file, "none of its entries can be found");
  }
  return std::nullopt;
}

}  // namespace qwsm::io
