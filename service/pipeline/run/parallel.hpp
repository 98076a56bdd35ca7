// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <span>

namespace qwsm::pipeline {

/// Does all tasks, on as many threads as there are cores, and returns when they are done. Where
/// some fail the others are done all the same, and what the first of them threw is thrown.
void RunInParallel(std::span<const std::function<void()>> tasks);

/// Lets all threads of the program take memory from one place, to be called before there are any:
/// what is made on one thread and freed on another can then be used again by both. What is large
/// goes back to the system when it is freed and leaves no holes. Costs time where many threads
/// take memory at once.
void ShareMemoryAmongThreads();
/// Gives memory that is free back to the system, after much of it was freed.
void GiveBackFreeMemory();

/// Begins to do some work on a thread of its own. @returns what waits for its end, and throws what
/// the work threw.
std::function<void()> BeginOnAnotherThread(std::function<void()> work);

}  // namespace qwsm::pipeline
