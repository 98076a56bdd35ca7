// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>
#include <ostream>
#include <stdexcept>
#include <string_view>

namespace qwsm::io {

/// Tells of a file that could not be written: the text names it and gives the system's reason.
class WriteError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A file that appears under its name whole, or not at all: until Commit() the bytes go to a
/// neighbour with a name of its own, which is removed if there is no commit. A symbolic link stays,
/// and what it leads to is written. A pipe or a device, such as /dev/stdout, is written to itself.
class AtomicFile {
 public:
  /// Begins the file. @throws WriteError where it cannot be created, or is none.
  explicit AtomicFile(std::filesystem::path path);
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;
  ~AtomicFile();

  std::ostream& stream();

  /// Where to write for a library that wants a path instead of the stream.
  const std::filesystem::path& temporary_path() const { return temporary_path_; }

  /// Throws if a write has failed so far: long runs ask now and then, rather than find the disk
  /// full at the end.
  /// @throws WriteError
  void ThrowIfFailed() const;

  /// From now on, what was written stays under its temporary name, if there is no commit: for what
  /// cannot be had again.
  /// @return where it is.
  const std::filesystem::path& KeepUnfinished() {
    keeps_unfinished_ = true;
    return committed_ ? path_ : temporary_path_;
  }

  /// Puts the file in its place. @throws WriteError if any byte did not get there.
  void Commit();

 private:
  class FileBuffer;

  std::filesystem::path path_;    // As asked for.
  std::filesystem::path target_;  // What that leads to.
  std::filesystem::path temporary_path_;
  std::unique_ptr<FileBuffer> buffer_;
  std::ostream stream_;
  bool committed_ = false;
  bool keeps_unfinished_ = false;
};

/// Writes a whole file at once. @throws WriteError.
void WriteTextFile(const std::filesystem::path& path, std::string_view text);

}  // namespace qwsm::io
