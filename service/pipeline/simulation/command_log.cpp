// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/simulation/command_log.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <string>
#include <string_view>
#include <utility>

#include "service/config/number_text.hpp"
#include "service/config/problem.hpp"

namespace qwsm::pipeline {
namespace {

constexpr double kFastest = 20.0;  // As TimedCommandOptions allow, in m/s and rad/s,
constexpr double kLatest_s = 1e6;  // and so late.
constexpr std::string_view kBlanks = " \t\r,";

config::Problem ProblemAt(config::Location location, std::string what) {
  config::Problem problem;
  problem.location = std::move(location);
  problem.what = std::move(what);
  return problem;
}

/// Reads one line after the other and notes what is wrong.
class CommandLogReader {
 public:
  explicit CommandLogReader(std::string name) : name_(std::move(name)) {}

  void ReadLine(std::string_view line) {
    ++line_;
    line = line.substr(0, line.find('#'));
    std::array<double, 3> values{};
    std::size_t fields = 0;
    for (std::size_t at = line.find_first_not_of(kBlanks); at != std::string_view::npos;) {
      const std::size_t end = std::min(line.find_first_of(kBlanks, at), line.size());
      const std::string_view field = line.substr(at, end - at);
      const auto value = config::ParseNumber(field);
      if (!value) return Refuse(at, fmt::format("'{}' is not a number", field));
      if (fields == values.size()) return Refuse(at, "more than 'stamp forward turn'");
      values[fields++] = *value;
      at = line.find_first_not_of(kBlanks, end);
    }
    if (fields == 0) return;
    if (fields < values.size()) return Refuse(0, "must be 'stamp forward turn', in s, m/s, rad/s");
    Add(values);
  }

  /// @throws config::ConfigError
  std::vector<sim::TimedCommandOptions> Finish() {
    if (commands_.empty() && problems_.empty()) {
      problems_.push_back(ProblemAt({name_}, "holds no commands: lines of 'stamp forward turn'"));
    }
    if (!problems_.empty()) throw config::ConfigError(std::move(problems_));
    return std::move(commands_);
  }

 private:
  void Add(const std::array<double, 3>& values) {
    const auto [stamp_s, forward_mps, turn_rad_s] = values;
    if (commands_.empty()) begin_s_ = stamp_s;
    const double start_s = stamp_s - begin_s_;
    if (!commands_.empty() && start_s < commands_.back().start_s) {
      return Refuse(0, "earlier than the command before; stamps must not decrease");
    }
    if (!(start_s <= kLatest_s)) {
      return Refuse(0, fmt::format("later than {} s after the first command", kLatest_s));
    }
    if (std::abs(forward_mps) > kFastest || std::abs(turn_rad_s) > kFastest) {
      return Refuse(0, fmt::format("speeds must be between -{0} and {0} m/s, rad/s", kFastest));
    }
    commands_.push_back({start_s, forward_mps, turn_rad_s});
  }

  void Refuse(std::size_t at, std::string what) {
    problems_.push_back(ProblemAt({name_, line_, static_cast<int>(at) + 1}, std::move(what)));
  }

  std::string name_;
  int line_ = 0;
  double begin_s_ = 0.0;
  std::vector<sim::TimedCommandOptions> commands_;
  std::vector<config::Problem> problems_;
};

}  // namespace

std::vector<sim::TimedCommandOptions> ReadCommandLog(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream || std::filesystem::is_directory(file)) {
    throw config::ConfigError({ProblemAt({file.string()}, "cannot be opened")});
  }
  CommandLogReader reader(file.string());
  for (std::string line; std::getline(stream, line);) reader.ReadLine(line);
  return reader.Finish();
}

void ReadCommandLogs(const std::filesystem::path& folder, sim::ScenarioOptions& scenario) {
  std::vector<config::Problem> problems;
  for (sim::RobotOptions& robot : scenario.robots) {
    if (robot.driver.command_log.empty()) continue;
    try {
      robot.driver.commands = ReadCommandLog(folder / robot.driver.command_log);
      robot.driver.command_log.clear();
    } catch (const config::ConfigError& error) {
      problems.insert(problems.end(), error.problems().begin(), error.problems().end());
    }
  }
  if (!problems.empty()) throw config::ConfigError(std::move(problems));
}

}  // namespace qwsm::pipeline
