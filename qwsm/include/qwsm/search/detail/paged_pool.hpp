// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace qwsm {

/// Elements with dense 32-bit indices, in pages of fixed size.
///
/// Growing never moves an element, so that inserting into a large map has no pauses, and never
/// holds more than one page of spare room. Freed indices are handed out again, the latest first.
template <class T, int kPageBits = 6>
class PagedPool {
 public:
  using Index = std::uint32_t;

  PagedPool() = default;
  PagedPool(PagedPool&&) noexcept = default;
  PagedPool& operator=(PagedPool&&) noexcept = default;
  ~PagedPool() = default;
  PagedPool(const PagedPool& other) : free_(other.free_), end_(other.end_) {
    for (const Page& page : other.pages_) {
      pages_.push_back(NewPage());
      for (std::size_t i = 0; i < kPageSize; ++i) pages_.back()[i] = page[i];
    }
  }
  PagedPool& operator=(const PagedPool& other) { return *this = PagedPool(other); }

  T& operator[](Index i) { return pages_[i >> kPageBits][i & kPageMask]; }
  const T& operator[](Index i) const { return pages_[i >> kPageBits][i & kPageMask]; }

  /// Stores an element and returns its index. Invalidates no reference.
  Index Add(T value) {
    const Index i = next();
    if (free_.empty()) {
      if (end_ >> kPageBits == pages_.size()) pages_.push_back(NewPage());
      ++end_;
    } else {
      free_.pop_back();
    }
    (*this)[i] = std::move(value);
    return i;
  }

  /// What Add() will return next.
  Index next() const { return free_.empty() ? end_ : free_.back(); }

  /// @pre `i` was given by Add() and not freed since.
  void Free(Index i) { free_.push_back(i); }

  /// Elements in use.
  std::size_t size() const { return end_ - free_.size(); }
  /// One more than the largest index ever in use.
  Index end() const { return end_; }
  /// Memory held.
  std::size_t bytes() const {
    return pages_.size() * kPageSize * sizeof(T) + pages_.capacity() * sizeof(Page) +
           free_.capacity() * sizeof(Index);
  }

 private:
  static constexpr std::size_t kPageSize = std::size_t{1} << kPageBits;
  static constexpr Index kPageMask = kPageSize - 1;
  using Page = std::unique_ptr<T[]>;
  static Page NewPage() { return std::make_unique<T[]>(kPageSize); }

  std::vector<Page> pages_;
  std::vector<Index> free_;
  Index end_ = 0;
};

}  // namespace qwsm
