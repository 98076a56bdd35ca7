// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "service/io/bags/writing/bag_writer.hpp"
#include "service/io/files/atomic_file.hpp"

namespace qwsm::io {

/// The formats of rosbag2.
enum class BagFormat { kMcap, kSqlite };

/// The format that a file's name asks for: .mcap or .db3; nothing for other names.
std::optional<BagFormat> BagFormatOf(const std::filesystem::path& path);

/// A bag of rosbag2 that appears whole or not at all: as one file where the path ends in .mcap or
/// .db3, else as a folder with its metadata.yaml.
class BagFile {
 public:
  /// Begins a bag. @throws WriteError, as all functions do.
  BagFile(const std::filesystem::path& path, BagFormat format);
  ~BagFile();

  /// Writes a message; topics are added as they come.
  void Write(const TopicToWrite& topic, Timestamp stamp, std::string_view cdr);
  /// From now on, what was written stays if the bag is never ended, as when the disk is full: under
  /// the name that is returned, and to be read as any bag that is cut off.
  const std::filesystem::path& KeepUnfinished() { return file_->KeepUnfinished(); }
  /// Throws if a write has failed so far.
  void ThrowIfFailed() const { file_->ThrowIfFailed(); }
  /// Ends the bag and puts it in its place.
  void Commit();

 private:
  std::filesystem::path folder_;  // Empty for a bag of one file.
  bool has_made_folder_ = false;
  std::filesystem::path path_;    // Of the one file.
  std::unique_ptr<AtomicFile> file_;
  std::unique_ptr<BagWriter> writer_;
  std::map<std::string, std::size_t, std::less<>> topics_;
};

}  // namespace qwsm::io
