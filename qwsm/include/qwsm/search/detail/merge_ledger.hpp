// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

#include "qwsm/search/detail/paged_pool.hpp"
#include "qwsm/search/detail/quadtree_layout.hpp"

namespace qwsm::quadtree {

/// Who contributed a point, in 32 bits: one scan, several that have an account in the ledger, or
/// none, where no point is stored.
class Origin {
 public:
  /// Scans are numbered below.
  static constexpr std::uint32_t kScanEnd = (1U << 31) - 1;

  constexpr Origin() = default;
  static constexpr Origin Scan(std::uint32_t scan) { return Origin(scan); }
  static constexpr Origin Account(std::uint32_t account) { return Origin(account | kAccountBit); }

  constexpr explicit operator bool() const { return bits_ != kNone; }
  constexpr bool is_account() const { return (bits_ & kAccountBit) != 0; }  ///< @pre not none
  constexpr std::uint32_t scan() const { return bits_; }                    ///< @pre not an account
  constexpr std::uint32_t account() const { return bits_ & ~kAccountBit; }

 private:
  static constexpr std::uint32_t kAccountBit = 1U << 31;
  static constexpr std::uint32_t kNone = ~0U;
  constexpr explicit Origin(std::uint32_t bits) : bits_(bits) {}

  std::uint32_t bits_ = kNone;
};

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
  /// The scan of the first contribution left. @pre count() > 0
  std::uint32_t oldest_scan(std::uint32_t account) const { return accounts_[account].oldest_scan; }
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
    std::uint32_t oldest_scan = 0;
  };

  std::uint16_t Mean(std::uint64_t sum, std::uint32_t account) const {
    const std::uint64_t count = accounts_[account].count;
    return static_cast<std::uint16_t>((sum + count / 2) / count);
  }

  PagedPool<Account> accounts_;
  PagedPool<Contribution> contributions_;
};

}  // namespace qwsm::quadtree
