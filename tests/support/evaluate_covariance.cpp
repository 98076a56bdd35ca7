// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// evaluate_covariance [SEEDS] [KEY=VALUE ...]: how honest the mapper's covariances are, scenario by
// scenario: the mean NEES of its poses (3 when they are right), and root mean squares of the errors
// made beside those expected. Settings are the mapper's options, such as match_floor_m=0.005.
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <iomanip>
#include <iostream>
#include <string>
#include <vector>

#include "service/config/options_io.hpp"
#include "tests/support/consistency.hpp"

namespace {

using namespace qwsm;

void PrintHeading() {
  std::cout << "                                  NEES   95 % interval   in 95 %    along (cm)     "
               "across (cm)   heading (deg)  dead\n"
               "scenario            task          mean   of the mean     ellipse  error  sigma   "
               "error  sigma   error  sigma  reckoned\n";
}

void PrintPair(const test::ErrorAndSigma& pair, double scale) {
  std::cout << std::setprecision(2) << std::setw(8) << scale * pair.error << std::setw(7)
            << scale * pair.sigma;
}

void PrintRow(const std::string& scenario,
              const std::string& task,
              const test::ConsistencyResult& result) {
  constexpr double kCentimetres = 100.0;
  std::cout << std::left << std::setw(20) << scenario << std::setw(10) << task << std::right
            << std::fixed << std::setprecision(2) << std::setw(8) << result.nees.mean
            << std::setw(8) << result.nees.mean_low << " -" << std::setw(6) << result.nees.mean_high
            << std::setprecision(1) << std::setw(8)
            << 100.0 * result.nees.share_in_95_percent_ellipsoid << " %";
  PrintPair(result.along_m, kCentimetres);
  PrintPair(result.across_m, kCentimetres);
  PrintPair(result.heading_rad, RadiansToDegrees(1.0));
  std::cout << std::setw(6) << result.dead_reckoned << " of " << result.nees.count;
  if (result.without_covariance > 0) {
    std::cout << "  " << result.without_covariance << " without covariance";
  }
  std::cout << std::endl;
}

void Evaluate(const std::vector<std::string>& arguments) {
  std::uint64_t seeds = 3;
  config::OptionSources sources;
  for (const std::string& argument : arguments) {
    if (argument.find('=') == std::string::npos) {
      seeds = std::stoull(argument);
    } else {
      sources.settings.push_back(argument);
    }
  }
  const auto options = config::LoadOptions<MapperOptions>(sources);
  PrintHeading();
  for (const test::ConsistencyScenario& scenario : test::ConsistencyScenarios()) {
    for (const auto task : {test::ConsistencyTask::kLocalize, test::ConsistencyTask::kMap}) {
      PrintRow(scenario.name,
               task == test::ConsistencyTask::kLocalize ? "localize" : "map",
               EvaluateConsistency(scenario, task, options, seeds));
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    Evaluate({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    std::cerr << "evaluate_covariance: " << error.what()
              << "\nusage: evaluate_covariance [SEEDS] [KEY=VALUE ...]\n";
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
