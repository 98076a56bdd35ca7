// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/run/interruption.hpp"

#include <time.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdint>
#include <string_view>
#include <utility>

namespace qwsm::pipeline {
namespace {

using std::literals::operator""sv;

constexpr int kInterruptedExitCode = 130;

// Who wants the program to quit at once has read what it said.
constexpr std::int64_t kOneRequest_ns = 500'000'000;

// When it was requested first, by the monotonic clock; 0: not yet. The only thing that a signal
// handler and the program can share.
std::atomic<std::int64_t> requested_at_ns = 0;
static_assert(std::atomic<std::int64_t>::is_always_lock_free);

// Set before the handler is.
std::string_view answer_to_person;

// Only what may be called inside a signal handler.
void Say(std::string_view text) {
  for (const std::string_view part :
       {"\n"sv, std::string_view(program_invocation_short_name), ": "sv, text}) {
    [[maybe_unused]] const ssize_t ignored = write(STDERR_FILENO, part.data(), part.size());
  }
}

std::int64_t MonotonicTime_ns() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
}

void NoteRequest(int number) {
  const std::int64_t now_ns = MonotonicTime_ns();
  std::int64_t first_ns = 0;
  const bool is_first = requested_at_ns.compare_exchange_strong(first_ns, now_ns);
  // Ctrl-C comes from a person; others from a program, which may read what else is said as JSON.
  if (number != SIGINT) return;
  if (is_first) return Say(answer_to_person);
  if (now_ns - first_ns < kOneRequest_ns) return;
  Say("quit without writing results\n");
  _exit(kInterruptedExitCode);
}

extern "C" void HandleSignal(int number) {
  const int error_number = errno;  // Of the call that the signal came into.
  NoteRequest(number);
  errno = error_number;
}

/// Handles a signal as wanted. @return how it was handled before.
struct sigaction Handle(int number, void (*handler)(int)) {
  struct sigaction action {};
  struct sigaction old {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART;  // What is being written is written whole.
  sigemptyset(&action.sa_mask);
  sigaction(number, &action, &old);
  return old;
}

/// The same, but for one that the program was started to ignore.
struct sigaction HandleUnlessIgnored(int number) {
  const struct sigaction old = Handle(number, HandleSignal);
  if (old.sa_handler == SIG_IGN) sigaction(number, &old, nullptr);
  return old;
}

}  // namespace

Interruption::Interruption(std::string_view answer, WithoutReaders without_readers)
    : outer_requested_at_(requested_at_ns.exchange(0)),
      outer_answer_(std::exchange(answer_to_person, answer)) {
  old_interrupt_ = HandleUnlessIgnored(SIGINT);
  old_hang_up_ = HandleUnlessIgnored(SIGHUP);
  old_terminate_ = Handle(SIGTERM, HandleSignal);
  sigaction(SIGPIPE, nullptr, &old_pipe_);
  if (without_readers == WithoutReaders::kGoesOn) Handle(SIGPIPE, SIG_IGN);
}

Interruption::~Interruption() {
  sigaction(SIGINT, &old_interrupt_, nullptr);
  sigaction(SIGHUP, &old_hang_up_, nullptr);
  sigaction(SIGTERM, &old_terminate_, nullptr);
  sigaction(SIGPIPE, &old_pipe_, nullptr);
  answer_to_person = outer_answer_;
  requested_at_ns = outer_requested_at_;
}

bool Interruption::requested() const { return requested_at_ns != 0; }

}  // namespace qwsm::pipeline
