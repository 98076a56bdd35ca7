// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

#include "qwsm/search/detail/paged_pool.hpp"
#include "qwsm/search/detail/quadtree_layout.hpp"

namespace qwsm::quadtree {

/// Who contributed what to the points that were merged, so that a scan can be taken out again
/// exactly. Sums are integers: a mean does not depend on the order of insertions and removals.
/// Costs 12 bytes for each merged insertion, and nothing for points alone in their cell.
class MergeLedger {
 public:
  struct Contribution {
    std::uint32_t previous = kNoIndex;
    std::uint32_t scan = 0;
    std::uint16_t fraction_x = 0;  ///< In units from the cell's corner.
    std::uint16_t fraction_y = 0;
  };

  /// Begins an account and returns its number.
  std::uint32_t Open() { return accounts_.Add({}); }
  void Add(std::uint32_t account, const Contribution& contribution);
  /// Takes out all that a scan contributed and returns how many that were.
  std::size_t Withdraw(std::uint32_t account, std::uint32_t scan);
  void Close(std::uint32_t account);

  std::uint32_t count(std::uint32_t account) const { return accounts_[account].count; }
  /// The first contribution left. Cost: linear in count(). @pre count() > 0
  const Contribution& Oldest(std::uint32_t account) const;
  /// Mean of the contributions, rounded to units. @pre count() > 0
  std::uint16_t mean_x(std::uint32_t account) const {
    return Mean(accounts_[account].sum_x, account);
  }
  std::uint16_t mean_y(std::uint32_t account) const {
    return Mean(accounts_[account].sum_y, account);
  }

  /// Contributions of all accounts.
  std::size_t size() const { return contributions_.size(); }
  std::size_t account_count() const { return accounts_.size(); }
  std::size_t bytes() const { return accounts_.bytes() + contributions_.bytes(); }

 private:
  struct Account {
    std::uint64_t sum_x = 0;
    std::uint64_t sum_y = 0;
    std::uint32_t count = 0;
    std::uint32_t latest = kNoIndex;
  };

  std::uint16_t Mean(std::uint64_t sum, std::uint32_t account) const {
    const std::uint64_t count = accounts_[account].count;
    return static_cast<std::uint16_t>((sum + count / 2) / count);
  }

  PagedPool<Account> accounts_;
  PagedPool<Contribution> contributions_;
};

}  // namespace qwsm::quadtree
