// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// team_load TAG [ROBOTS [HZ [SECONDS [SPEED [FILE]]]]]: simulated robots (16, at 10 Hz, for 60 s)
// that drive through one office with 361 beams each, on loopback, to a service that was started
// with
//   qwsm serve --set network.interface=lo --set network.tag=TAG
// Prints what became of the scans. With SPEED 4 everything happens four times as fast. Into FILE go
// the answers, one a line: when it was heard since 1970, time of the match, time from arrival of
// the scan to its pose, all in milliseconds.
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/support/team_traffic.hpp"

namespace {

using namespace qwsm;

void Print(const char* what, const std::vector<std::chrono::nanoseconds>& sorted) {
  const auto ms = [&](double share) {
    return std::chrono::duration<double, std::milli>(test::Quantile(sorted, share)).count();
  };
  std::printf("%-24s median %.3f ms  p90 %.3f  p99 %.3f  longest %.3f\n",
              what,
              ms(0.5),
              ms(0.9),
              ms(0.99),
              ms(1.0));
}

void WriteAnswers(const char* path, const std::vector<test::TimedAnswer>& answers) {
  using Milliseconds = std::chrono::duration<double, std::milli>;
  std::ofstream file(path);
  file << std::fixed;
  for (const test::TimedAnswer& answer : answers) {
    file << Milliseconds(answer.heard.time_since_epoch()).count() << ' '
         << Milliseconds(answer.matching).count() << ' ' << Milliseconds(answer.latency).count()
         << '\n';
  }
  if (!file.flush()) throw std::runtime_error(std::string(path) + ": cannot be written");
}

int Measure(const char* tag, const test::TeamOptions& options, double speed, const char* path) {
  test::TeamTraffic team(options);
  if (!team.Join({.interface = "lo", .tag = tag})) {
    std::fprintf(stderr, "team_load: no service with the tag %s answers\n", tag);
    return 1;
  }
  const test::TrafficResult result = team.Run(team.scans_left(), speed);
  std::printf("%d robots at %g Hz, 361 beams, for %g s\n",
              options.robots,
              speed * options.rate_hz,
              options.duration_s / speed);
  std::printf("sent %zu  arrived %llu  answered %zu  dropped %llu  out of order %zu\n",
              result.sent,
              static_cast<unsigned long long>(result.counted),
              result.answered,
              static_cast<unsigned long long>(result.dropped),
              result.out_of_order);
  if (result.answered == 0) return 1;
  if (path != nullptr) WriteAnswers(path, result.answers);
  Print("scan arrived to pose", result.latency);
  Print("of which the match took", result.matching);
  std::printf("the sender was late by %.3f ms at worst\n",
              std::chrono::duration<double, std::milli>(result.latest).count());
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2 || argc > 7) {
    std::fputs("usage: team_load TAG [ROBOTS [HZ [SECONDS [SPEED [FILE]]]]]\n", stderr);
    return 2;
  }
  const auto number = [&](int i, double otherwise) {
    return argc > i ? std::atof(argv[i]) : otherwise;
  };
  try {
    return Measure(argv[1],
                   {.robots = static_cast<int>(number(2, 16)),
                    .rate_hz = number(3, 10.0),
                    .duration_s = number(4, 60.0)},
                   number(5, 1.0),
                   argc > 6 ? argv[6] : nullptr);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "team_load: %s\n", error.what());
    return 1;
  }
}
