// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/bags/assembly/bag_faults.hpp"

#include <algorithm>

namespace qwsm::io {
namespace {

constexpr std::size_t kMostKinds = 200;
constexpr std::size_t kMostDamages = 10'000;

}  // namespace

void BagFaults::OfMessage(const std::string& topic, std::uint64_t number, const std::string& what) {
  Count(topic + ": " + what,
        number,
        report_.name + ": message " + std::to_string(number) + " (" + topic + "): " + what);
}

void BagFaults::OfFile(const std::string& file, std::uint64_t where, const std::string& what) {
  const std::string told = file + ": at " + std::to_string(where) + ": " + what;
  if (damages_.size() < kMostDamages && damages_.insert(told).second) {
    Count(what, report_.lines + 1, told);
  }
}

void BagFaults::Count(const std::string& what, std::uint64_t number, const std::string& told) {
  if (options_.strict) throw LogError(told);
  const auto known = std::ranges::find(report_.faults, what, &LogFault::what);
  if (known != report_.faults.end()) {
    ++known->count;
  } else if (report_.faults.size() < kMostKinds) {
    report_.faults.push_back(
        {.what = what, .count = 1, .first_line = static_cast<std::size_t>(number)});
    if (options_.on_fault) options_.on_fault(told);
  }
}

void BagFaults::Doubt(const std::string& what) {
  report_.notes.push_back(what);
  if (options_.on_fault) options_.on_fault(report_.name + ": " + what);
}

}  // namespace qwsm::io
