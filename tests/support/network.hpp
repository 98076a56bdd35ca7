// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <unistd.h>

#include <chrono>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/program.hpp"

namespace qwsm::test {

/// A network of its own on this host: programs with its arguments see each other and nobody else.
class PrivateNetwork {
 public:
  PrivateNetwork() {
    static int count = 0;
    tag_ = "test-" + std::to_string(getpid()) + "-" + std::to_string(count++);
  }

  const std::string& tag() const { return tag_; }

  std::vector<std::string> Join(std::vector<std::string> arguments) const {
    arguments.insert(arguments.end(),
                     {"--set", "network.interface=lo", "--set", "network.tag=" + tag_});
    return arguments;
  }
  /// Of the simulator, whose --set takes options of the scenario.
  std::vector<std::string> JoinSimulator(std::vector<std::string> arguments) const {
    arguments.insert(arguments.end(), {"--network", "interface=lo", "--network", "tag=" + tag_});
    return arguments;
  }
  /// Joins a service that waits for odometry however busy the machine is.
  std::vector<std::string> JoinService(std::vector<std::string> arguments) const {
    arguments.insert(arguments.end(), {"--set", "team.session.odometry_wait_s=10"});
    return Join(std::move(arguments));
  }
  Outcome Run(std::vector<std::string> arguments) const {
    return RunProgram(Join(std::move(arguments)));
  }

 private:
  std::string tag_;
};

/// A program that runs until it is told to stop, or the test is over.
class Daemon {
 public:
  explicit Daemon(std::vector<std::string> arguments, const std::string& program = "qwsm")
      : Daemon(std::move(arguments), Redirection{.output = {}, .program = program}) {}
  Daemon(std::vector<std::string> arguments, const Redirection& redirection)
      : program_(std::make_unique<Program>(std::move(arguments), redirection)) {}
  Daemon(const Daemon&) = delete;
  Daemon& operator=(const Daemon&) = delete;
  ~Daemon() {
    if (program_) program_->Signal(SIGKILL);
  }

  pid_t process() const { return program_->process(); }
  void Signal(int number) const { program_->Signal(number); }
  bool HasEnded() const { return program_->HasEnded(); }
  std::string ErrorsSoFar() const { return program_->ErrorsSoFar(); }
  std::chrono::nanoseconds CpuSoFar() const { return program_->CpuSoFar(); }
  /// Waits until the program says something on stderr. @returns false after ten seconds without.
  bool WaitUntilItSays(const std::string& text) const {
    for (int i = 0; i < 1000; ++i) {
      if (program_->ErrorsSoFar().find(text) != std::string::npos) return true;
      usleep(10'000);
    }
    return false;
  }
  /// Waits for the end.
  Outcome Wait() { return std::exchange(program_, nullptr)->Wait(); }
  /// Sends the signal and waits for the end.
  Outcome End(int number = SIGTERM) {
    program_->Signal(number);
    return std::exchange(program_, nullptr)->Wait();
  }

 private:
  std::unique_ptr<Program> program_;
};

}  // namespace qwsm::test
