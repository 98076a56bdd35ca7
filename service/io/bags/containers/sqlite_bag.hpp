// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "service/io/bags/containers/message_source.hpp"
#include "service/io/journal/sqlite_database.hpp"

namespace qwsm::io {

/// Reads the databases of rosbag2, schemas 1 to 4: they differ in tables that are not needed here.
class SqliteBag final : public MessageSource {
 public:
  /// Opens a database. @throws std::runtime_error where it is none, or none of rosbag2.
  SqliteBag(const std::filesystem::path& path, TellDamage tell);

  /// Whether the database has the tables of rosbag2. False where it cannot be read.
  static bool Recognizes(const std::filesystem::path& path);

  std::string_view format() const override { return "rosbag2 (sqlite3)"; }
  const std::vector<BagTopic>& topics() const override { return topics_; }
  std::optional<BagMessage> Next() override;
  std::string_view Read(const MessageAddress& address) override;

 private:
  using RowsAhead = std::map<std::int64_t, std::string>;

  std::optional<BagMessage> TakeRow();
  bool GoAround(const std::string& problem);
  RowsAhead ReadAhead(std::int64_t topic, std::int64_t row);

  SqliteDatabase database_;
  TellDamage tell_;
  std::vector<BagTopic> topics_;
  std::map<std::int64_t, std::size_t> topic_of_id_;
  SqliteStatement rows_;      // From the row after a number on, in the order of writing.
  SqliteStatement messages_;  // Of a topic, from a row on.
  std::int64_t last_row_ = -1;
  std::int64_t stride_ = 1;
  std::map<std::uint64_t, RowsAhead> ahead_;  // By topic.
};

}  // namespace qwsm::io
