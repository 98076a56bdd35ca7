// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace qwsm {

/// Room for elements with dense 32-bit indices, in pages of fixed size. Growing never moves an
/// element, so that inserting into a large map has no pauses.
template <class T, int kPageBits>
class Pages {
 public:
  using Index = std::uint32_t;
  static constexpr std::size_t kPageSize = std::size_t{1} << kPageBits;

  Pages() = default;
  Pages(Pages&&) noexcept = default;
  Pages& operator=(Pages&&) noexcept = default;
  ~Pages() = default;
  Pages(const Pages& other) {
    for (const Page& page : other.pages_) {
      Grow();
      std::copy_n(page.get(), kPageSize, pages_.back().get());
    }
  }
  Pages& operator=(const Pages& other) { return *this = Pages(other); }

  T& operator[](Index i) { return pages_[i >> kPageBits][i & (kPageSize - 1)]; }
  const T& operator[](Index i) const { return pages_[i >> kPageBits][i & (kPageSize - 1)]; }

  /// Elements that there is room for.
  std::size_t size() const { return pages_.size() << kPageBits; }
  /// Adds a page.
  void Grow() { pages_.push_back(std::make_unique<T[]>(kPageSize)); }
  /// Memory held.
  std::size_t bytes() const { return size() * sizeof(T) + pages_.capacity() * sizeof(Page); }

 private:
  using Page = std::unique_ptr<T[]>;

  std::vector<Page> pages_;
};

/// Elements with dense 32-bit indices. Never holds more than one page of spare room. Freed indices
/// are handed out again, the latest first.
template <class T, int kPageBits = 6>
class PagedPool {
 public:
  using Index = std::uint32_t;

  T& operator[](Index i) { return elements_[i]; }
  const T& operator[](Index i) const { return elements_[i]; }

  /// Stores an element and returns its index. Invalidates no reference.
  Index Add(T value) {
    const Index i = next();
    if (free_.empty()) {
      if (end_ == elements_.size()) elements_.Grow();
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
  std::size_t bytes() const { return elements_.bytes() + free_.capacity() * sizeof(Index); }

 private:
  Pages<T, kPageBits> elements_;
  std::vector<Index> free_;
  Index end_ = 0;
};

}  // namespace qwsm
