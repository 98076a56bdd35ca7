// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/dds/robot/source_watch.hpp"

#include <cstddef>
#include <utility>

namespace qwsm::dds {
namespace {

constexpr std::size_t kMostSources = 64;

}  // namespace

bool SourceWatch::Note(const Guid& participant) {
  if (is_told_ || participant == last_ || participant == Guid{}) return false;
  if (earlier_.size() >= kMostSources) earlier_.clear();
  earlier_.insert(std::exchange(last_, participant));
  is_told_ = earlier_.contains(participant);
  return is_told_;
}

}  // namespace qwsm::dds
