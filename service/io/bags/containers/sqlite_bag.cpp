// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/bags/containers/sqlite_bag.hpp"

namespace qwsm::io {
namespace {

// Rows that are left out at once, where pages of the database are damaged, at most.
constexpr std::int64_t kLongestStride = std::int64_t{1} << 40;
// Messages of a topic that are read at once: SQLite locks and unlocks the file for each query,
// which takes longer than to read a scan.
constexpr std::size_t kAheadBytes = std::size_t{1} << 16;

/// Opens a database for what can be read of it: with that pragma a file that is cut off, which has
/// pages that its schema says it has not, is not refused as a whole.
SqliteDatabase OpenEvenIfCut(const std::filesystem::path& path) {
  SqliteDatabase database(path, SqliteDatabase::Access::kReadOnly);
  database.Execute("PRAGMA writable_schema=ON");
  return database;
}

}  // namespace

bool SqliteBag::Recognizes(const std::filesystem::path& path) {
  try {
    SqliteDatabase database = OpenEvenIfCut(path);
    return database.Number(
               "SELECT count(*) FROM sqlite_master WHERE name IN ('topics','messages')") == 2;
  } catch (const SqliteError&) {
    return false;
  }
}

SqliteBag::SqliteBag(const std::filesystem::path& path, TellDamage tell)
    : database_(OpenEvenIfCut(path)),
      tell_(std::move(tell)),
      rows_(database_.Prepare("SELECT id, topic_id, data FROM messages WHERE id > ? ORDER BY id")),
      messages_(database_.Prepare(
          "SELECT id, data FROM messages WHERE topic_id = ? AND id >= ? ORDER BY id")) {
  SqliteStatement topics =
      database_.Prepare("SELECT id, name, type, serialization_format FROM topics ORDER BY id");
  while (topics.Step()) {
    topic_of_id_.emplace(topics.Integer(0), topics_.size());
    topics_.push_back({.name = topics.Text(1),
                       .type = PlainTypeName(topics.Text(2)),
                       .encoding = topics.Text(3) == "cdr" ? Encoding::kCdr : Encoding::kOther});
  }
  rows_.Bind(1, std::int64_t{-1});
}

std::optional<BagMessage> SqliteBag::Next() {
  for (;;) {
    try {
      if (!rows_.Step()) return std::nullopt;
      if (rows_.Integer(0) <= last_row_) {
        if (!GoAround("its pages go round in a circle")) return std::nullopt;
        continue;
      }
      if (std::optional<BagMessage> message = TakeRow()) return message;
    } catch (const SqliteError& error) {
      if (!GoAround(error.what())) return std::nullopt;
    }
  }
}

std::optional<BagMessage> SqliteBag::TakeRow() {
  last_row_ = rows_.Integer(0);
  stride_ = 1;
  const auto topic = topic_of_id_.find(rows_.Integer(1));
  if (topic == topic_of_id_.end()) {
    tell_(static_cast<std::uint64_t>(last_row_), "a message belongs to a topic that is not listed");
    return std::nullopt;
  }
  return BagMessage{.topic = topic->second,
                    .address = {.container = static_cast<std::uint64_t>(topic->first),
                                .at = static_cast<std::uint64_t>(last_row_)},
                    .bytes = rows_.Blob(2)};
}

/// Goes on behind the damaged page: a row further, then two, then four ...
/// @return whether there may be rows behind it.
bool SqliteBag::GoAround(const std::string& problem) {
  tell_(static_cast<std::uint64_t>(last_row_), "the database is damaged: " + problem);
  if (stride_ > kLongestStride) return false;
  last_row_ += stride_;
  stride_ *= 2;
  rows_.Reset();
  rows_.Bind(1, last_row_);
  return true;
}

std::string_view SqliteBag::Read(const MessageAddress& address) {
  RowsAhead& ahead = ahead_[address.container];
  const auto row = static_cast<std::int64_t>(address.at);
  auto found = ahead.find(row);
  if (found == ahead.end()) {
    ahead = ReadAhead(static_cast<std::int64_t>(address.container), row);
    found = ahead.find(row);
  }
  return found == ahead.end() ? std::string_view() : found->second;
}

/// A row, and those of the same topic that are likely to be asked for next.
SqliteBag::RowsAhead SqliteBag::ReadAhead(std::int64_t topic, std::int64_t row) {
  RowsAhead ahead;
  messages_.Reset();
  messages_.Bind(1, topic);
  messages_.Bind(2, row);
  for (std::size_t bytes = 0; bytes < kAheadBytes;) {
    try {
      if (!messages_.Step()) break;
    } catch (const SqliteError&) {
      if (ahead.empty()) throw;
      break;  // It is told when it is asked for.
    }
    const auto [added, is_new] = ahead.emplace(messages_.Integer(0), messages_.Blob(1));
    if (!is_new) break;  // Damaged pages go round in a circle.
    bytes += sizeof(RowsAhead::value_type) + added->second.size();
  }
  messages_.Reset();
  return ahead;
}

}  // namespace qwsm::io
