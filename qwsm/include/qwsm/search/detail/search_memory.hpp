// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <type_traits>
#include <vector>

namespace qwsm {

/// Memory for as long as a search lasts, in pages that the thread keeps for the next one: memory
/// that the system has to hand out again costs a search more than what it does with it.
class SearchMemory {
 public:
  SearchMemory() = default;
  SearchMemory(const SearchMemory&) = delete;
  SearchMemory& operator=(const SearchMemory&) = delete;
  ~SearchMemory();

  /// So many elements side by side, which may hold anything. They stay where they are.
  template <class T>
  std::span<T> Take(std::size_t count) {
    static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);
    static_assert(alignof(T) <= kAlignment);
    return {static_cast<T*>(TakeBytes(count * sizeof(T))), count};
  }
  /// The same, all of it 0: numbers, and pointers to nothing.
  template <class T>
  std::span<T> TakeZeros(std::size_t count) {
    const std::span<T> elements = Take<T>(count);
    Clear(elements.data(), elements.size_bytes());
    return elements;
  }

 private:
  static constexpr std::size_t kAlignment = 16;
  using Page = std::unique_ptr<std::byte[]>;

  // Pages of the thread that no search uses.
  static std::vector<Page>& Spare();
  static Page NewPage();
  void* TakeBytes(std::size_t bytes);
  // Not inline: what a compiler makes of a few hundred bytes takes longer than a call.
  static void Clear(void* first, std::size_t bytes);

  std::vector<Page> pages_;
  std::vector<Page> large_;  // What fits no page.
  std::byte* next_ = nullptr;
  std::size_t left_ = 0;  // Bytes of the last page.
};

}  // namespace qwsm
