// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/search/detail/merge_ledger.hpp"

#include <cassert>

namespace qwsm::quadtree {

void MergeLedger::Add(std::uint32_t account, const Contribution& contribution) {
  Account& a = accounts_[account];
  a.sum_x += contribution.fraction_x;
  a.sum_y += contribution.fraction_y;
  if (a.count == 0) a.oldest_scan = contribution.scan;
  ++a.count;
  const std::uint32_t added = contributions_.Add(contribution);
  contributions_[added].previous = a.latest;
  a.latest = added;
}

std::size_t MergeLedger::Withdraw(std::uint32_t account, std::uint32_t scan) {
  Account& a = accounts_[account];
  const std::uint32_t count_before = a.count;
  for (std::uint32_t* link = &a.latest; *link != kNoIndex;) {
    Contribution& contribution = contributions_[*link];
    if (contribution.scan != scan) {
      a.oldest_scan = contribution.scan;  // Of those left; the last one seen is the oldest.
      link = &contribution.previous;
      continue;
    }
    a.sum_x -= contribution.fraction_x;
    a.sum_y -= contribution.fraction_y;
    --a.count;
    contributions_.Free(*link);
    *link = contribution.previous;
  }
  return count_before - a.count;
}

void MergeLedger::Close(std::uint32_t account) {
  for (std::uint32_t i = accounts_[account].latest; i != kNoIndex; i = contributions_[i].previous) {
    contributions_.Free(i);
  }
  accounts_.Free(account);
}

}  // namespace qwsm::quadtree
