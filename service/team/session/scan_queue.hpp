// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <utility>

namespace qwsm::team {

/// A bounded queue in which the newest wins: when it is full the oldest is dropped, and counted.
/// A pose for the scan of a moment ago is worth more than one for the scan of a second ago. Scans
/// that pile up because something is waited for get room beside the others, once.
template <class Scan>
class ScanQueue {
 public:
  /// Makes an empty queue. @pre capacity > 0
  explicit ScanQueue(std::size_t capacity) : capacity_(capacity) { assert(capacity > 0); }

  static constexpr std::size_t kMostExtra = 256;

  /// @param gets_room whether this one drops none: that there are so many is nobody's slowness.
  void Push(Scan scan, bool gets_room = false) {
    if (scans_.size() == capacity_ + extra_ && gets_room && extra_ < kMostExtra) ++extra_;
    if (scans_.size() == capacity_ + extra_) {
      scans_.pop_front();
      ++dropped_;
    }
    scans_.push_back(std::move(scan));
  }
  /// Takes the oldest scan out. @pre !empty()
  Scan Pop() {
    Scan scan = std::move(scans_.front());
    scans_.pop_front();
    if (extra_ > 0) --extra_;
    return scan;
  }
  /// The oldest scan. @pre !empty()
  const Scan& front() const { return scans_.front(); }
  bool empty() const { return scans_.empty(); }
  std::size_t size() const { return scans_.size(); }
  std::uint64_t dropped() const { return dropped_; }

 private:
  std::size_t capacity_;
  std::size_t extra_ = 0;  // Room for those that had to wait.
  std::deque<Scan> scans_;
  std::uint64_t dropped_ = 0;
};

}  // namespace qwsm::team
