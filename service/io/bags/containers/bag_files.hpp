// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "service/io/bags/containers/message_source.hpp"

namespace qwsm::io {

/// What metadata.yaml says of a bag, as far as it matters.
struct BagMetadata {
  std::vector<std::string> files;  ///< Relative to the folder.
  std::optional<std::uint64_t> messages;
};

/// Reads the metadata.yaml of a folder; empty where there is none.
BagMetadata ReadMetadata(const std::filesystem::path& folder);

/// Whether a path is a bag: a folder of rosbag2, or a file, by its content. It may be compressed
/// as a whole, with zstd, gzip, bzip2 or xz.
bool IsBag(const std::filesystem::path& path);

/// The files that a bag consists of, in the order of recording: those that its metadata names, or
/// all in its folder by the numbers in their names; or the one file itself.
/// @param tell is told which files are missing.
/// @throws BagError where there is none.
std::vector<std::filesystem::path> FilesOfBag(const std::filesystem::path& path,
                                              const std::function<void(const std::string&)>& tell);

/// A file of a bag, made ready to be read in any order.
class OpenBagFile {
 public:
  /// Opens a file; one that is compressed as a whole is unpacked into a temporary file first.
  /// @throws std::runtime_error naming the file where it is no bag.
  OpenBagFile(const std::filesystem::path& path, MessageSource::TellDamage tell);
  OpenBagFile(OpenBagFile&&) noexcept = default;
  ~OpenBagFile();

  MessageSource& messages() { return *source_; }
  const std::string& compression() const { return compression_; }

 private:
  class TemporaryFile;

  std::string compression_ = "none";
  std::unique_ptr<TemporaryFile> unpacked_;
  std::unique_ptr<MessageSource> source_;
};

}  // namespace qwsm::io
