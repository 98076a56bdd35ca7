// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/dds/wire/refusals.hpp"

#include <fmt/format.h>

namespace qwsm::dds {

void Refusals::Add(const std::string& topic, std::string_view why) {
  std::uint64_t count = 0;
  {
    const std::lock_guard lock(mutex_);
    count = ++counts_[{topic, std::string(why)}];
  }
  if (count == 1) on_first_(fmt::format("{}: a sample was refused: {}", topic, why));
}

std::vector<Refusals::Kind> Refusals::All() const {
  const std::lock_guard lock(mutex_);
  std::vector<Kind> kinds;
  for (const auto& [kind, count] : counts_) kinds.push_back({kind.first, kind.second, count});
  return kinds;
}

}  // namespace qwsm::dds
