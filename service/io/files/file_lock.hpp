// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

namespace qwsm::io {

/// Keeps a file for one process: a file of its own that is locked as long as this lives, and that
/// the system unlocks however the process ends.
class FileLock {
 public:
  /// Tries to lock; see is_held(). @param file is created where there is none.
  explicit FileLock(const std::filesystem::path& file);
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;
  ~FileLock();

  bool is_held() const { return is_held_; }
  /// Whether another process holds the lock; else the file cannot be created.
  bool is_held_elsewhere() const { return descriptor_ >= 0 && !is_held_; }

 private:
  int descriptor_;
  bool is_held_ = false;
};

}  // namespace qwsm::io
