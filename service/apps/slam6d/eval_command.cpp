// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "service/apps/number_arguments.hpp"
#include "service/apps/output.hpp"
#include "service/apps/slam6d/commands.hpp"
#include "service/pipeline/slam6d/pose_evaluation.hpp"

namespace slam6d::apps {
namespace {

using pipeline::PoseAlignment;

struct EvalArguments {
  std::vector<std::filesystem::path> estimates;
  std::filesystem::path truth;
  std::string alignment = "first";
  std::optional<double> max_ate_m;
  std::optional<double> max_ate_deg;
  bool json = false;
};

PoseAlignment AlignmentNamed(const std::string& name) {
  if (name == "none") return PoseAlignment::kNone;
  return name == "best" ? PoseAlignment::kBest : PoseAlignment::kFirst;
}

void WarnOfMissing(const pipeline::NamedErrors& named) {
  const pipeline::PoseErrors& errors = named.errors;
  if (errors.poses == errors.true_poses) return;
  fmt::print(stderr,
             "slam6d: {}: {} of {} true poses are compared; the others have no pose in it\n",
             named.name,
             errors.poses,
             errors.true_poses);
}

/// A bound on the error is that of the whole drive, or at least of most of it.
constexpr double kLeastCovered = 0.5;

int CountFailures(const pipeline::NamedErrors& named, const EvalArguments& arguments) {
  int failures = 0;
  if ((arguments.max_ate_m || arguments.max_ate_deg) && named.errors.covered < kLeastCovered) {
    fmt::print(stderr,
               "slam6d: {}: spans {:.0f} % of the truth, too little to hold a bound to\n",
               named.name,
               100.0 * named.errors.covered);
    ++failures;
  }
  const auto check = [&](const std::optional<double>& bound, double value, const char* what) {
    if (!bound || value <= *bound) return;  // Written so that NaN fails.
    fmt::print(stderr, "slam6d: {}: {}: {:.6g} is above {:.6g}\n", named.name, what, value, *bound);
    ++failures;
  };
  check(arguments.max_ate_m, named.errors.rmse_m, "ate rmse [m]");
  check(arguments.max_ate_deg,
        named.errors.rmse_rad * 180.0 / std::numbers::pi,
        "ate rotation rmse [deg]");
  return failures;
}

/// @throws std::runtime_error naming the trajectory that cannot be compared.
pipeline::NamedErrors ErrorsOf(const std::filesystem::path& path,
                               const io::NumberedPoses& truth,
                               PoseAlignment alignment) {
  const io::NumberedPoses estimate = io::ReadPoses(path);
  try {
    return {.name = path.string(), .errors = Compare(estimate, truth, alignment)};
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(path.string() + ": " + error.what());
  }
}

ExitCode RunEval(const EvalArguments& arguments) {
  const io::NumberedPoses truth = io::ReadPoses(arguments.truth);
  std::vector<pipeline::NamedErrors> all;
  for (const std::filesystem::path& estimate : arguments.estimates) {
    all.push_back(ErrorsOf(estimate, truth, AlignmentNamed(arguments.alignment)));
  }
  qwsm::apps::Print("{}", arguments.json ? ErrorJson(all) : ErrorTable(all));
  int failures = 0;
  for (const pipeline::NamedErrors& named : all) {
    WarnOfMissing(named);
    failures += CountFailures(named, arguments);
  }
  return failures == 0 ? ExitCode::kDone : ExitCode::kFailed;
}

}  // namespace

Command AddEvalCommand(CLI::App& program) {
  CLI::App* parser = AddParser(program, "eval", "how good registered poses are");
  auto arguments = std::make_shared<EvalArguments>();
  parser->footer(
      "  slam6d eval results/latest --truth dat/gt\n"
      "  slam6d eval dat/ results/latest --truth dat/gt          odometry and result\n"
      "  slam6d eval results/latest --truth gt.tum --max-ate 0.03     exit code 1 above");
  parser
      ->add_option("POSES",
                   arguments->estimates,
                   "TUM files, or folders of results, of .frames or of .pose files")
      ->required()
      ->type_name("");
  parser->add_option("--truth", arguments->truth, "the same, of the true poses")
      ->required()
      ->type_name("FILE");
  parser->add_option("--align", arguments->alignment, "none, first (pose onto the truth) or best")
      ->check(CLI::IsMember({"none", "first", "best"}))
      ->type_name("HOW")
      ->capture_default_str();
  const char* const bounds = "Bounds (exit code 1)";
  parser->add_option("--max-ate", arguments->max_ate_m, "rmse of the translation, in metres")
      ->check(qwsm::apps::NumberBetween(0.0, 1e9))
      ->group(bounds);
  parser
      ->add_option("--max-ate-rotation", arguments->max_ate_deg, "rmse of the rotation, in degrees")
      ->check(qwsm::apps::NumberBetween(0.0, 1e9))
      ->group(bounds);
  parser->add_flag("--json", arguments->json, "the same as JSON");
  return {.parser = parser, .run = [arguments] { return RunEval(*arguments); }};
}

}  // namespace slam6d::apps
