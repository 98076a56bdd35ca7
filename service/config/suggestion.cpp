// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/config/suggestion.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace qwsm::config {

int EditDistance(std::string_view a, std::string_view b) {
  std::vector<int> before_last(b.size() + 1);
  std::vector<int> last(b.size() + 1);
  std::vector<int> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before_last.swap(last);
    last.swap(row);
    row[0] = static_cast<int>(i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const int replace = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, replace});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) row[j] = std::min(row[j], before_last[j - 2] + 1);
    }
  }
  return row[b.size()];
}

std::optional<std::string> ClosestName(std::string_view typed, std::span<const std::string> names) {
  constexpr std::size_t kLongestName = 100;
  if (typed.size() > kLongestName) return std::nullopt;
  const std::string* closest = nullptr;
  int smallest = 0;
  for (const std::string& name : names) {
    const int distance = EditDistance(typed, name);
    const auto allowed = static_cast<int>(std::max<std::size_t>(1, name.size() / 3));
    if (distance > allowed || (closest != nullptr && distance >= smallest)) continue;
    closest = &name;
    smallest = distance;
  }
  if (closest == nullptr) return std::nullopt;
  return *closest;
}

std::string DidYouMean(std::string_view typed, std::span<const std::string> names) {
  const std::optional<std::string> name = ClosestName(typed, names);
  return name ? "; did you mean '" + *name + "'?" : std::string();
}

}  // namespace qwsm::config
