// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/apps/replay_arguments.hpp"

#include <optional>

#include "service/apps/number_arguments.hpp"
#include "service/config/number_text.hpp"

namespace qwsm::apps {
namespace {

constexpr double kSlowestRate = 1e-6;
constexpr double kFastestRate = 1e6;

/// Seconds of the record in one of ours; nothing for as fast as the service answers.
std::optional<double> FactorOf(const std::string& rate) {
  if (rate == "max") return std::nullopt;
  const std::optional<double> factor = config::ParseNumber(rate);
  if (factor && *factor >= kSlowestRate && *factor <= kFastestRate) return factor;
  throw UsageError(fmt::format("--rate: must be a number between {} and {}, or max, got '{}'",
                               kSlowestRate,
                               kFastestRate,
                               rate));
}

}  // namespace

void AddReplayArguments(CLI::App& parser, ReplayArguments& arguments) {
  parser.add_option("--robot", arguments.robot, "namespace of the robot; else none")
      ->type_name("NAME");
  parser.add_option("--rate", arguments.rate, "seconds of the record in a real one, or max")
      ->type_name("FACTOR")
      ->capture_default_str();
  parser.add_option("--wait", arguments.wait_s, "seconds to wait for somebody who listens")
      ->check(NumberBetween(0.0, 86400.0))
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
