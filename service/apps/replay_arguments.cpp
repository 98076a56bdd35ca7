// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/apps/replay_arguments.hpp"

#include <cstdlib>
#include <optional>

namespace qwsm::apps {
namespace {

/// Seconds of the record in one of ours; nothing for as fast as the service answers.
std::optional<double> FactorOf(const std::string& rate) {
  if (rate == "max") return std::nullopt;
  char* end = nullptr;
  const double factor = std::strtod(rate.c_str(), &end);
  if (end == rate.c_str() || *end != '\0' || !(factor > 0.0 && factor <= 1e6)) {
    throw UsageError(fmt::format("--rate: must be a positive number or max, got '{}'", rate));
  }
  return factor;
}

}  // namespace

void AddReplayArguments(CLI::App& parser, ReplayArguments& arguments) {
  parser.add_option("--robot", arguments.robot, "namespace of the robot; else none")
      ->type_name("NAME");
  parser.add_option("--rate", arguments.rate, "seconds of the record in a real one, or max")
      ->type_name("FACTOR")
      ->capture_default_str();
  parser.add_option("--wait", arguments.wait_s, "seconds to wait for somebody who listens")
      ->check(CLI::Range(0.0, 86400.0))
      ->type_name("S")
      ->capture_default_str();
}

pipeline::ReplayOptions ReplayOptionsOf(const ReplayArguments& arguments,
                                        const Verbosity& verbosity) {
  return {
      .robot = arguments.robot,
      .factor = FactorOf(arguments.rate),
      .progress = verbosity.quiet ? pipeline::ProgressStyle::kNone : pipeline::StyleFor(stderr)};
}

}  // namespace qwsm::apps
