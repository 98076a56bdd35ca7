// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fcntl.h>
#include <sched.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/support/temporary_folder.hpp"

namespace qwsm::test {

inline std::string ReadFile(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// The program stands in bin/ beside the folder of the tests.
inline std::filesystem::path ProgramPath(const std::string& name = "qwsm") {
  return std::filesystem::read_symlink("/proc/self/exe").parent_path().parent_path() / "bin" / name;
}

/// What a program did.
struct Outcome {
  int exit_code = -1;  ///< 128 + signal where it was killed.
  std::string output;
  std::string errors;
  std::chrono::nanoseconds cpu{};  ///< All it needed, of all its threads.
};

/// Where a program reads and writes, if not nowhere and into its outcome, and on which network.
struct Redirection {
  std::filesystem::path input = "/dev/null";
  std::filesystem::path output{};
  std::string program = "qwsm";
  std::filesystem::path network_namespace{};  ///< Such as /run/netns/NAME; empty: the test's own.
};

/// A program of ours as its own process.
class Program {
 public:
  explicit Program(std::vector<std::string> arguments, const Redirection& redirection = {}) {
    Start(std::move(arguments), redirection);
  }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;
  ~Program() {
    if (process_ > 0) Wait();
  }

  pid_t process() const { return process_; }
  void Signal(int number) const { kill(process_, number); }

  bool HasEnded() const {
    siginfo_t ended{};
    const int options = WEXITED | WNOHANG | WNOWAIT;  // It can still be waited for.
    const auto id = static_cast<id_t>(process_);
    return waitid(P_PID, id, &ended, options) == 0 && ended.si_pid == process_;
  }

  std::string ErrorsSoFar() const { return ReadFile(streams_.path() / "errors"); }

  /// What it has needed so far, of all its threads. @pre it has not ended.
  std::chrono::nanoseconds CpuSoFar() const {
    clockid_t clock{};
    timespec time{};
    if (clock_getcpuclockid(process_, &clock) != 0 || clock_gettime(clock, &time) != 0) {
      throw std::runtime_error("the program has ended");
    }
    return std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec);
  }

  Outcome Wait() {
    int status = 0;
    rusage usage{};
    wait4(process_, &status, 0, &usage);
    process_ = -1;
    return {.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status),
            .output = ReadFile(streams_.path() / "output"),
            .errors = ReadFile(streams_.path() / "errors"),
            .cpu = Duration(usage.ru_utime) + Duration(usage.ru_stime)};
  }

 private:
  void Start(std::vector<std::string> arguments, const Redirection& redirection) {
    arguments.insert(arguments.begin(), ProgramPath(redirection.program));
    std::vector<char*> argv;
    for (std::string& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    process_ = fork();
    if (process_ < 0) throw std::runtime_error("cannot fork");
    if (process_ > 0) return;
    Enter(redirection.network_namespace);
    Redirect(STDIN_FILENO, redirection.input, O_RDONLY);
    const bool captured = redirection.output.empty();
    Redirect(STDOUT_FILENO,
             captured ? streams_.path() / "output" : redirection.output,
             O_WRONLY | O_CREAT);
    Redirect(STDERR_FILENO, streams_.path() / "errors", O_WRONLY | O_CREAT);
    execv(argv.front(), argv.data());
    _exit(127);
  }

  static std::chrono::nanoseconds Duration(const timeval& time) {
    return std::chrono::seconds(time.tv_sec) + std::chrono::microseconds(time.tv_usec);
  }

  static void Enter(const std::filesystem::path& network_namespace) {
    if (network_namespace.empty()) return;
    if (setns(open(network_namespace.c_str(), O_RDONLY), CLONE_NEWNET) != 0) _exit(126);
  }

  static void Redirect(int descriptor, const std::filesystem::path& file, int flags) {
    dup2(open(file.c_str(), flags, 0600), descriptor);
  }

  TemporaryFolder streams_;
  pid_t process_ = -1;
};

inline Outcome RunProgram(std::vector<std::string> arguments) {
  return Program(std::move(arguments)).Wait();
}

}  // namespace qwsm::test
