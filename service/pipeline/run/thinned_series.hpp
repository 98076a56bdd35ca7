// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cassert>
#include <cstddef>
#include <utility>
#include <vector>

namespace qwsm::pipeline {

/// A series of any length in bounded memory: whenever it is full every other element goes, and of
/// those that come later only as many are kept, so that they stay evenly spread.
template <class T>
class ThinnedSeries {
 public:
  /// Makes an empty series. @pre capacity is even.
  explicit ThinnedSeries(std::size_t capacity) : capacity_(capacity) {
    assert(capacity > 0 && capacity % 2 == 0 && "what is kept stays evenly spread");
  }

  void Add(T element) {
    if (added_++ % stride_ != 0) return;
    if (elements_.size() == capacity_) {
      for (std::size_t i = 0; i < capacity_ / 2; ++i) elements_[i] = std::move(elements_[2 * i]);
      elements_.erase(elements_.begin() + static_cast<std::ptrdiff_t>(capacity_ / 2),
                      elements_.end());
      stride_ *= 2;
    }
    elements_.push_back(std::move(element));
  }

  const std::vector<T>& elements() const& { return elements_; }
  std::vector<T> elements() && { return std::move(elements_); }

 private:
  std::size_t capacity_;
  std::size_t added_ = 0;
  std::size_t stride_ = 1;  // Distance of the elements that are kept, among all.
  std::vector<T> elements_;
};

}  // namespace qwsm::pipeline
