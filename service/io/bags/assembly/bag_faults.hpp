// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <set>
#include <string>

#include "qwsm/logs/log_reader.hpp"

namespace qwsm::io {

/// Counts what is wrong with a bag in its report, and tells each kind once.
class BagFaults {
 public:
  /// Starts to count. Both outlive this.
  BagFaults(LogReport& report, const LogOptions& options) : report_(report), options_(options) {}

  /// A message that cannot be used. @throws LogError when strict.
  void OfMessage(const std::string& topic, std::uint64_t number, const std::string& what);
  /// Damage of a file. @throws LogError when strict.
  void OfFile(const std::string& file, std::uint64_t where, const std::string& what);
  /// What the bag leaves open, and how it is understood.
  void Doubt(const std::string& what);

 private:
  void Count(const std::string& what, std::uint64_t number, const std::string& told);

  std::set<std::string> damages_;  // Files are read twice: each is counted once.
  LogReport& report_;
  const LogOptions& options_;
};

}  // namespace qwsm::io
