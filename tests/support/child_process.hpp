// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <stdexcept>
#include <utility>

namespace qwsm::test {

/// A copy of this process that does something and tells its parent numbers, until it ends or is
/// killed. Make it while there is but one thread.
class ChildProcess {
 public:
  using Tell = std::function<void(std::uint64_t)>;

  /// @param task gets a function that tells the parent a number, at once; any thread may call it.
  explicit ChildProcess(const std::function<void(const Tell&)>& task) {
    if (pipe(ends_.data()) != 0) throw std::runtime_error("cannot make a pipe");
    process_ = fork();
    if (process_ < 0) throw std::runtime_error("cannot fork");
    if (process_ > 0) {
      close(std::exchange(ends_[1], -1));
      return;
    }
    close(ends_[0]);
    task([this](std::uint64_t number) {
      if (write(ends_[1], &number, sizeof number) != sizeof number) _exit(2);
    });
    _exit(0);
  }
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;
  ~ChildProcess() {
    if (process_ > 0) Kill();
    close(ends_[0]);
  }

  /// The next number that was told, waiting for it; nothing once the child is gone and all is read.
  std::optional<std::uint64_t> Hear() const {
    std::uint64_t number = 0;
    if (read(ends_[0], &number, sizeof number) != sizeof number) return std::nullopt;
    return number;
  }
  /// kill -9.
  void Kill() {
    kill(process_, SIGKILL);
    static_cast<void>(Wait());
  }
  /// Its exit code; -1 where it was killed.
  int Wait() {
    int status = 0;
    waitpid(std::exchange(process_, -1), &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

 private:
  std::array<int, 2> ends_{};
  pid_t process_ = -1;
};

}  // namespace qwsm::test
