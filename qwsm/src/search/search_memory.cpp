// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/search/detail/search_memory.hpp"

#include <cstring>
#include <utility>

namespace qwsm {
namespace {

constexpr std::size_t kPageBytes = std::size_t{1} << 17;
constexpr std::size_t kMostSpare = 64;  // Pages: 8 MB.

}  // namespace

SearchMemory::~SearchMemory() {
  std::vector<Page>& spare = Spare();
  while (!pages_.empty() && spare.size() < kMostSpare) {
    spare.push_back(std::move(pages_.back()));
    pages_.pop_back();
  }
}

std::vector<SearchMemory::Page>& SearchMemory::Spare() {
  thread_local std::vector<Page> spare;
  return spare;
}

SearchMemory::Page SearchMemory::NewPage() {
  std::vector<Page>& spare = Spare();
  if (spare.empty()) return std::make_unique_for_overwrite<std::byte[]>(kPageBytes);
  Page page = std::move(spare.back());
  spare.pop_back();
  return page;
}

void* SearchMemory::TakeBytes(std::size_t bytes) {
  bytes = (bytes + kAlignment - 1) / kAlignment * kAlignment;
  if (bytes > kPageBytes) {
    return large_.emplace_back(std::make_unique_for_overwrite<std::byte[]>(bytes)).get();
  }
  if (bytes > left_) {
    next_ = pages_.emplace_back(NewPage()).get();
    left_ = kPageBytes;
  }
  void* taken = next_;
  next_ += bytes;
  left_ -= bytes;
  return taken;
}

void SearchMemory::Clear(void* first, std::size_t bytes) { std::memset(first, 0, bytes); }

}  // namespace qwsm
