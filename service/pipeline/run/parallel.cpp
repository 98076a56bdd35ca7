// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/run/parallel.hpp"

#include <malloc.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <future>
#include <memory>
#include <thread>
#include <utility>
#include <vector>

namespace qwsm::pipeline {
namespace {

// More than what each scan takes and gives back.
constexpr int kLarge_bytes = 1 << 18;

}  // namespace

void RunInParallel(std::span<const std::function<void()>> tasks) {
  std::vector<std::exception_ptr> failures(tasks.size());
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    for (std::size_t i = next++; i < tasks.size(); i = next++) {
      try {
        tasks[i]();
      } catch (...) {
        failures[i] = std::current_exception();
      }
    }
  };
  const std::size_t cores = std::max(1U, std::thread::hardware_concurrency());
  {
    std::vector<std::jthread> others;
    for (std::size_t i = 1; i < std::min(cores, tasks.size()); ++i) others.emplace_back(work);
    work();
  }
  for (const std::exception_ptr& failure : failures) {
    if (failure) std::rethrow_exception(failure);
  }
}

void ShareMemoryAmongThreads() {
  mallopt(M_ARENA_MAX, 1);
  mallopt(M_MMAP_THRESHOLD, kLarge_bytes);
}

void GiveBackFreeMemory() { malloc_trim(0); }

std::function<void()> BeginOnAnotherThread(std::function<void()> work) {
  auto done = std::make_shared<std::future<void>>(std::async(std::launch::async, std::move(work)));
  return [done] { done->get(); };
}

}  // namespace qwsm::pipeline
