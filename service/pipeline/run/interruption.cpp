// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/run/interruption.hpp"

#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <string_view>
#include <utility>

namespace qwsm::pipeline {
namespace {

using std::literals::operator""sv;

constexpr int kInterruptedExitCode = 130;

// The only thing a signal handler and the program can share.
std::atomic<bool> interrupted = false;
static_assert(std::atomic<bool>::is_always_lock_free);

// Set before the handler is.
std::string_view answer_to_person;

// Only what may be called inside a signal handler.
void Say(std::string_view text) {
  for (const std::string_view part :
       {"\n"sv, std::string_view(program_invocation_short_name), ": "sv, text}) {
    [[maybe_unused]] const ssize_t ignored = write(STDERR_FILENO, part.data(), part.size());
  }
}

extern "C" void HandleSignal(int number) {
  if (interrupted.exchange(true)) {
    Say("quit without writing results\n");
    _exit(kInterruptedExitCode);
  }
  // Ctrl-C comes from a person; SIGTERM from a program, which may read what else is said as JSON.
  if (number == SIGTERM) return;
  Say(answer_to_person);
}

}  // namespace

Interruption::Interruption(std::string_view answer)
    : outer_requested_(interrupted.exchange(false)),
      outer_answer_(std::exchange(answer_to_person, answer)) {
  struct sigaction action {};
  action.sa_handler = HandleSignal;
  action.sa_flags = SA_RESTART;  // What is being written is written whole.
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, nullptr, &old_interrupt_);
  if (old_interrupt_.sa_handler != SIG_IGN) sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, &old_terminate_);
}

Interruption::~Interruption() {
  sigaction(SIGINT, &old_interrupt_, nullptr);
  sigaction(SIGTERM, &old_terminate_, nullptr);
  answer_to_person = outer_answer_;
  interrupted = outer_requested_;
}

bool Interruption::requested() const { return interrupted; }

}  // namespace qwsm::pipeline
