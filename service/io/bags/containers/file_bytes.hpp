// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace qwsm::io {

/// The bytes of a file, read in any order through a window of it.
class FileBytes {
 public:
  /// Opens a file. @throws std::runtime_error naming the file and the reason.
  explicit FileBytes(const std::filesystem::path& path);

  std::uint64_t size() const { return size_; }
  /// The bytes from `offset` on, fewer at the end of the file; valid until the next call.
  std::string_view At(std::uint64_t offset, std::size_t size);

 private:
  std::ifstream file_;
  std::uint64_t size_;
  std::uint64_t window_begin_ = 0;
  std::string window_;
};

}  // namespace qwsm::io
