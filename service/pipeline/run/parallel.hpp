// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <span>

namespace qwsm::pipeline {

/// Does all tasks, on as many threads as there are cores, and returns when they are done. Where
/// some fail the others are done all the same, and what the first of them threw is thrown.
void RunInParallel(std::span<const std::function<void()>> tasks);

/// Begins to do some work on a thread of its own. @returns what waits for its end, and throws what
/// the work threw.
std::function<void()> BeginOnAnotherThread(std::function<void()> work);

}  // namespace qwsm::pipeline
