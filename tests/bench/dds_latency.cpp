// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// dds_latency PROGRAM LOG [HZ]: how long it takes from a scan on the network to its pose on the
// network, over loopback, beside the time of the match itself. PROGRAM is qwsm; the scans are the
// log's, published at a steady rate (40 Hz), each after the answer to the one before.
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <thread>
#include <vector>

#include "service/dds/robot/match_report_reader.hpp"
#include "service/dds/robot/robot_publisher.hpp"
#include "service/pipeline/run/log_source.hpp"

namespace {

using namespace qwsm;
using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

/// The service, in a network of its own, until the end of this program.
class Service {
 public:
  Service(const char* program, const std::string& tag) {
    const std::string setting = "network.tag=" + tag;
    process_ = fork();
    if (process_ != 0) return;
    execl(program,
          program,
          "serve",
          "--quiet",
          "--set",
          "network.interface=lo",
          "--set",
          setting.c_str(),
          nullptr);
    _exit(127);
  }
  Service(const Service&) = delete;
  Service& operator=(const Service&) = delete;
  ~Service() {
    kill(process_, SIGTERM);
    waitpid(process_, nullptr, 0);
  }

 private:
  pid_t process_;
};

struct Distribution {
  std::vector<double> ms;

  void Add(Clock::duration duration) {
    ms.push_back(std::chrono::duration<double, std::milli>(duration).count());
  }
  void Print(const char* what) {
    std::ranges::sort(ms);
    const auto quantile = [this](double q) {
      return ms[static_cast<std::size_t>(q * static_cast<double>(ms.size() - 1))];
    };
    std::printf("%-28s median %.3f ms  p90 %.3f  p99 %.3f  longest %.3f\n",
                what,
                quantile(0.5),
                quantile(0.9),
                quantile(0.99),
                ms.back());
  }
};

void Measure(const char* program, const char* log, double rate_hz) {
  const std::string tag = "latency-" + std::to_string(getpid());
  const Service service(program, tag);
  pipeline::LogSource source({log}, {});
  const dds::Participant participant({.interface = "lo", .tag = tag});
  dds::MatchReportReader reports(participant, {"robot"});
  dds::RobotPublisher robot(participant, dds::RobotNames("robot"), dds::OdometryUse::kPublished);
  robot.WaitForListener(source.Peek()->scan.geometry.T_robot_laser, 10s);
  while (!reports.has_writer()) reports.Take(10ms);

  Distribution there_and_back;
  Distribution matching;
  std::size_t unanswered = 0;
  const auto period =
      std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(1 / rate_hz));
  auto due = Clock::now();
  while (const auto observation = source.Next()) {
    std::this_thread::sleep_until(due);
    due = std::max(due + period, Clock::now());
    const auto sent = Clock::now();
    robot.Publish(*observation);
    const std::vector<dds::MatchReport> answers = reports.Take(1s);
    if (answers.empty()) {
      ++unanswered;
      continue;
    }
    there_and_back.Add(Clock::now() - sent);
    matching.Add(answers.back().duration);
  }
  std::printf("%zu scans at %.0f Hz, %zu without an answer\n",
              there_and_back.ms.size(),
              rate_hz,
              unanswered);
  if (there_and_back.ms.empty()) return;
  there_and_back.Print("scan published to pose here");
  matching.Print("of which the match took");
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3 && argc != 4) {
    std::fputs("usage: dds_latency PROGRAM LOG [HZ]\n", stderr);
    return 2;
  }
  try {
    Measure(argv[1], argv[2], argc == 4 ? std::atof(argv[3]) : 40.0);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "dds_latency: %s\n", error.what());
    return 1;
  }
  return 0;
}
