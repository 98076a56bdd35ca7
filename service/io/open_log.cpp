// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/logs/log_reader.hpp"

#include <algorithm>
#include <fstream>
#include <iostream>
#include <utility>

#include "service/io/bags/assembly/bag_reader.hpp"
#include "service/io/files/file_error.hpp"
#include "service/io/journal/sqlite_database.hpp"
#include "service/io/logs/journal_reader.hpp"
#include "service/io/logs/text_log_reader.hpp"

namespace qwsm::io {

std::unique_ptr<LogReader> OpenLog(std::istream& stream,
                                   std::string_view name,
                                   const LogOptions& options) {
  return std::make_unique<TextLogReader>(stream, name, options);
}

std::unique_ptr<LogReader> OpenLog(const std::filesystem::path& path, const LogOptions& options) {
  if (path == "-") return OpenLog(std::cin, kStandardInput, options);
  if (IsBag(path)) return std::make_unique<BagReader>(std::span(&path, 1), options);
  if (IsSqliteDatabase(path)) return std::make_unique<JournalReader>(path, options.mirrored);
  std::unique_ptr<std::ifstream> file;
  try {
    file = std::make_unique<std::ifstream>(OpenForReading(path));
  } catch (const std::runtime_error& error) {
    throw LogError(error.what());
  }
  auto reader = std::make_unique<TextLogReader>(*file, path.string(), options);
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);  // Not that of a pipe.
  reader->Own(std::move(file), error ? std::nullopt : std::optional<std::uint64_t>(size));
  return reader;
}

std::vector<std::unique_ptr<LogReader>> OpenLogs(std::span<const std::filesystem::path> paths,
                                                 const LogOptions& options) {
  std::vector<std::unique_ptr<LogReader>> readers;
  for (auto first = paths.begin(); first != paths.end();) {
    const auto end = std::find_if(
        first, paths.end(), [](const auto& path) { return path == "-" || !IsBag(path); });
    if (end - first > 1) {
      readers.push_back(std::make_unique<BagReader>(std::span(first, end), options));
      first = end;
    } else {
      readers.push_back(OpenLog(*first++, options));
    }
  }
  return readers;
}

}  // namespace qwsm::io
