// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "qwsm/geometry/angle.hpp"
#include "service/apps/command.hpp"
#include "service/apps/number_arguments.hpp"
#include "service/apps/output.hpp"
#include "service/pipeline/evaluation/evaluation.hpp"

namespace qwsm::apps {
namespace {

using pipeline::Evaluation;

/// Bounds above which the command fails, for use in continuous integration.
struct Bounds {
  std::optional<double> relations_m;
  std::optional<double> relations_deg;
  std::optional<double> ate_m;
  std::optional<double> rpe_m;
  std::optional<double> rpe_deg;
};

struct EvalArguments {
  std::vector<std::filesystem::path> trajectories;
  pipeline::EvaluationOptions options;
  double max_time_difference_s = 0.01;
  Bounds bounds;
  bool json = false;
};

/// Counts and names the bounds that were exceeded.
class Gate {
 public:
  explicit Gate(std::string trajectory) : trajectory_(std::move(trajectory)) {}

  void Check(const std::optional<double>& bound, double value, const char* what) {
    // Written so that NaN fails.
    if (!bound || value <= *bound) return;
    fmt::print(stderr, "qwsm: {}: {}: {:.6g} is above {:.6g}\n", trajectory_, what, value, *bound);
    ++failures_;
  }
  int failures() const { return failures_; }

 private:
  std::string trajectory_;
  int failures_ = 0;
};

int CountFailures(const Evaluation& evaluation, const Bounds& bounds) {
  Gate gate(evaluation.trajectory);
  if (evaluation.relations) {
    const RelationsSummary& all = evaluation.relations->all;
    gate.Check(bounds.relations_m, all.translation_m.mean, "mean translation of relations [m]");
    gate.Check(bounds.relations_deg,
               RadiansToDegrees(all.rotation_rad.mean),
               "mean rotation of relations [deg]");
  }
  if (evaluation.absolute_m) gate.Check(bounds.ate_m, evaluation.absolute_m->rmse, "ate rmse [m]");
  if (evaluation.relative) {
    const RelativePoseError& relative = *evaluation.relative;
    gate.Check(bounds.rpe_m, relative.translation_m.rmse, "rpe translation rmse [m]");
    gate.Check(
        bounds.rpe_deg, RadiansToDegrees(relative.rotation_rad.rmse), "rpe rotation rmse [deg]");
  }
  return gate.failures();
}

void CheckArguments(const EvalArguments& arguments) {
  const pipeline::EvaluationOptions& options = arguments.options;
  const Bounds& bounds = arguments.bounds;
  if (!options.relations && !options.truth) {
    throw UsageError("nothing to compare with: --relations FILE, --truth FILE or both are needed");
  }
  if (!options.relations && (options.log || bounds.relations_m || bounds.relations_deg)) {
    throw UsageError("--log and --max-relations... need --relations FILE");
  }
  if (!options.truth && (options.align || bounds.ate_m || bounds.rpe_m || bounds.rpe_deg)) {
    throw UsageError("--align, --max-ate and --max-rpe... need --truth FILE");
  }
}

ExitCode RunEval(const EvalArguments& arguments) {
  CheckArguments(arguments);
  pipeline::EvaluationOptions options = arguments.options;
  options.max_time_difference = std::chrono::duration_cast<std::chrono::nanoseconds>(
      std::chrono::duration<double>(arguments.max_time_difference_s));
  const pipeline::Evaluator evaluator(options);
  std::vector<Evaluation> evaluations;
  for (const auto& file : arguments.trajectories) evaluations.push_back(evaluator.Evaluate(file));
  Print("{}", arguments.json ? EvaluationJson(evaluations) : EvaluationTable(evaluations));
  int failures = 0;
  for (const Evaluation& evaluation : evaluations) {
    failures += CountFailures(evaluation, arguments.bounds);
  }
  return failures == 0 ? ExitCode::kDone : ExitCode::kFailed;
}

void AddBounds(CLI::App& parser, Bounds& bounds) {
  const auto add = [&parser](const char* name, std::optional<double>& bound, const char* help) {
    parser.add_option(name, bound, help)
        ->check(NumberBetween(0.0, 1e9))
        ->group("Bounds (exit code 1)");
  };
  add("--max-relations", bounds.relations_m, "mean translation of relations, in metres");
  add("--max-relations-rotation", bounds.relations_deg, "mean rotation of relations, in degrees");
  add("--max-ate", bounds.ate_m, "rmse of the ATE, in metres");
  add("--max-rpe", bounds.rpe_m, "rmse of the RPE's translation, in metres");
  add("--max-rpe-rotation", bounds.rpe_deg, "rmse of the RPE's rotation, in degrees");
}

}  // namespace

Command AddEvalCommand(CLI::App& program) {
  CLI::App* parser = AddParser(program, "eval", "how good trajectories are");
  auto arguments = std::make_shared<EvalArguments>();
  parser->footer(
      "  qwsm eval results/latest --relations intel.relations --log intel.log.gz\n"
      "  qwsm eval mine.tum theirs.tum --truth truth.tum --align\n"
      "  qwsm eval results/latest --truth truth.tum --max-ate 0.10     exit code 1 above");
  parser->add_option("TRAJECTORY", arguments->trajectories, "TUM files, or folders of results")
      ->required()
      ->type_name("");
  pipeline::EvaluationOptions& options = arguments->options;
  parser
      ->add_option("--relations", options.relations, "true relative poses (Kuemmerle et al. 2009)")
      ->type_name("FILE");
  parser->add_option("--log", options.log, "its odometry carries poses to stamps between scans")
      ->type_name("LOG");
  parser->add_option("--truth", options.truth, "true trajectory (TUM), for ATE and RPE")
      ->type_name("FILE");
  parser->add_flag("--align", options.align, "first move the trajectory onto the truth (no scale)");
  parser
      ->add_option("--max-time-diff",
                   arguments->max_time_difference_s,
                   "seconds between a pose and its truth")
      ->check(NumberBetween(0.0, 1e6))
      ->capture_default_str();
  parser->add_option("--rpe-step", options.relative_step, "poses between the ends of an RPE")
      ->check(CLI::Range(std::size_t{1}, std::size_t{1000000000}))
      ->capture_default_str();
  parser->add_flag("--json", arguments->json, "the same, and more, as JSON");
  AddBounds(*parser, arguments->bounds);
  return {.parser = parser, .run = [arguments] { return RunEval(*arguments); }};
}

}  // namespace qwsm::apps
