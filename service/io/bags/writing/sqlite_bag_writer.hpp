// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>

#include "service/io/bags/writing/bag_writer.hpp"
#include "service/io/journal/sqlite_database.hpp"

namespace qwsm::io {

/// Writes databases of rosbag2, schema 4, in which readers of schema 3 find all they look for.
class SqliteBagWriter final : public BagWriter {
 public:
  /// Begins a database in a file that is new or empty. @throws SqliteError, as all functions do.
  explicit SqliteBagWriter(const std::filesystem::path& file);

  std::string_view storage() const override { return "sqlite3"; }
  std::size_t AddTopic(const TopicToWrite& topic) override;
  void Write(std::size_t topic, Timestamp stamp, std::string_view cdr) override;
  void Finish(const std::string& file_name) override;

 private:
  SqliteDatabase database_;
  SqliteStatement insert_;
};

}  // namespace qwsm::io
