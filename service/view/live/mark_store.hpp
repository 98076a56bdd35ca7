// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "service/dds/gateway/mark.hpp"

namespace qwsm::view {

/// All marks that are known, kept in a file beside the journal, which outlives the service. Used by
/// one thread.
class MarkStore {
 public:
  static constexpr std::size_t kMostMarks = 1024;
  using Warn = std::function<void(const std::string&)>;

  /// Reads what was kept; a file that cannot be read is set aside.
  /// @param file empty: marks are not kept.
  MarkStore(std::filesystem::path file, Warn warn);

  /// Takes a mark, by whomever, and keeps it if it is the newest of its id.
  void Take(const dds::Mark& mark);
  /// Whether there is room for this mark.
  bool HasRoomFor(const dds::Mark& mark) const;
  std::vector<dds::Mark> marks() const;

 private:
  void Load();
  void Save() const;

  std::filesystem::path file_;
  Warn warn_;
  std::map<std::string, dds::Mark> marks_;  // By their ids.
};

}  // namespace qwsm::view
