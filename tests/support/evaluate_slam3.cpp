// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// evaluate_slam3 loops|pairs [COUNT [FIRST [PLACE]]] [KEY=VALUE ...]: how good 6D SLAM is in
// simulated places, with the options of `slam6d register`.
//
// loops: closed loops in yards of COUNT seeds; the error of the default, of a chain (one reference,
// no loops, no refinement), how thick the model's walls are over the noise of the scanner (a wall
// seen head-on is 1 thick), and the processor time of the registrations.
// pairs: COUNT pairs of scans that overlap by 5 to 60 %, in all kinds of places: which were
// believed, which should have been, and how honest their covariances are (NEES over degrees of
// freedom: 1 when they are right).
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <numbers>
#include <string>
#include <vector>

#include "service/config/options_io.hpp"
#include "service/options/slam6d/registration_options.hpp"
#include "slam6d/cloud/octree.hpp"
#include "slam6d/graph/ceres_loop_closer.hpp"
#include "tests/support/stops3.hpp"

namespace slam6d::test {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

/// A registration is right within these, or within what its covariance says.
constexpr double kRight_m = 0.10;
constexpr double kRight_rad = 1.0 / kDegrees;
constexpr double kRightNees = 6.0;

struct Arguments {
  std::string task;
  std::uint64_t count = 3;
  std::uint64_t first = 1;
  std::string place;  ///< The kind of place of all pairs; empty for all kinds in turn.
  options::RegistrationOptions options;
};

double ProcessorSeconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

struct TrajectoryError {
  double cm = 0.0;
  double deg = 0.0;
};

/// Root mean squares, the first pose on the true one.
TrajectoryError ErrorOf(const std::vector<Pose3>& poses, const std::vector<Pose3>& truth) {
  TrajectoryError sum;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Pose3 error =
        (truth.front().Inverse() * truth[i]).Inverse() * (poses.front().Inverse() * poses[i]);
    sum.cm += error.translation_m.squaredNorm() * 1e4;
    sum.deg += std::pow(RotationAngle(error.rotation) * kDegrees, 2);
  }
  const auto count = static_cast<double>(poses.size());
  return {.cm = std::sqrt(sum.cm / count), .deg = std::sqrt(sum.deg / count)};
}

double Quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

struct LoopOutcome {
  TrajectoryError error;
  double cpu_s = 0.0;
  int dead_reckoned = 0;
  double nees = 0.0;  ///< Mean over the poses.
  double thickness = 0.0;
};

/// Standard deviation of points about their plane.
double ThicknessM(const PointCloud& points, std::span<const std::uint32_t> members) {
  Eigen::Vector3d mean_m = Eigen::Vector3d::Zero();
  for (const std::uint32_t i : members) mean_m += points[i] / static_cast<double>(members.size());
  Eigen::Matrix3d scatter_m2 = Eigen::Matrix3d::Zero();
  for (const std::uint32_t i : members) {
    const Eigen::Vector3d offset_m = points[i] - mean_m;
    scatter_m2 += offset_m * offset_m.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(scatter_m2);
  return std::sqrt(eigen.eigenvalues()(0) / (static_cast<double>(members.size()) - 3.0));
}

/// The median thickness of what all scans together show, in cubes with enough points to tell, over
/// the noise of the scanner.
double ThicknessOfWalls(const Stops3& stops, const std::vector<Pose3>& poses) {
  constexpr double kCube_m = 0.3;
  constexpr std::size_t kLeastPoints = 60;
  PointCloud model;
  for (std::size_t i = 0; i < poses.size(); ++i) model.Append(poses[i] * stops.scans[i]);
  const Octree octree(model, kCube_m);
  std::vector<double> thickness_m;
  for (std::size_t cube = 0; cube < octree.size(); ++cube) {
    const std::span<const std::uint32_t> members = octree.points(cube);
    if (members.size() >= kLeastPoints) thickness_m.push_back(ThicknessM(model, members));
  }
  return Quantile(thickness_m, 0.5) / sim::PitchingLaserOptions{}.noise_m;
}

LoopOutcome Register(const Stops3& stops, const SlamOptions& options) {
  const graph::CeresLoopCloser closer;
  LoopOutcome outcome;
  const double start_s = ProcessorSeconds();
  Slam slam(options, closer);
  std::vector<Matrix6d> covariances;
  for (std::size_t i = 0; i < stops.scans.size(); ++i) {
    const SlamStep step = slam.Add(stops.scans[i], stops.T_odom_scan[i]);
    outcome.dead_reckoned += step.status == SlamStatus::kDeadReckoned ? 1 : 0;
    if (i == 0) continue;
    const auto count = static_cast<double>(stops.scans.size() - 1);
    outcome.nees += NeesOf(step.T_map_scan, step.covariance, stops.T_world_scan[i]) / count;
  }
  static_cast<void>(slam.Refine());
  outcome.cpu_s = ProcessorSeconds() - start_s;
  outcome.error = ErrorOf(slam.T_map_scan(), stops.T_world_scan);
  outcome.thickness = ThicknessOfWalls(stops, slam.T_map_scan());
  return outcome;
}

SlamOptions Chain(SlamOptions options) {
  options.references = 1;
  options.loop.enabled = false;
  options.refinement.enabled = false;
  return options;
}

void EvaluateLoops(const Arguments& arguments) {
  std::puts("        odometry    truth   default                                   chain");
  std::puts(
      "seed          cm     thick        cm     deg  CPU s  lost  NEES  thick        cm     deg  "
      "CPU s  lost  NEES  thick");
  for (std::uint64_t i = 0; i < arguments.count; ++i) {
    const std::uint64_t seed = arguments.first + i;
    const Stops3 stops = LoopInYard(seed);
    std::printf("%4d %11.1f %9.3f",
                static_cast<int>(seed),
                ErrorOf(stops.T_odom_scan, stops.T_world_scan).cm,
                ThicknessOfWalls(stops, stops.T_world_scan));
    const SlamOptions& slam = arguments.options.slam;
    for (const SlamOptions& options : {slam, Chain(slam)}) {
      const LoopOutcome outcome = Register(stops, options);
      std::printf(" %9.3f %7.4f %6.2f %5d %5.1f %6.3f",
                  outcome.error.cm,
                  outcome.error.deg,
                  outcome.cpu_s,
                  outcome.dead_reckoned,
                  outcome.nees,
                  outcome.thickness);
    }
    std::puts("");
    std::fflush(stdout);
  }
}

/// What became of the pairs of one kind.
struct PairCounts {
  int pairs = 0;
  int accepted = 0;
  int wrong_accepted = 0;
  int right_rejected = 0;
  double cpu_s = 0.0;
  std::vector<double> nees;
  std::vector<double> error_cm;
};

bool IsRight(const Pose3& pose, const Matrix6d& covariance, const Pose3& truth) {
  const Pose3 error = truth.Inverse() * pose;
  const bool is_near =
      error.translation_m.norm() <= kRight_m && RotationAngle(error.rotation) <= kRight_rad;
  if (is_near) return true;
  return covariance.trace() > 0.0 && NeesOf(pose, covariance, truth) <= kRightNees;
}

void Count(const ScanPair3& pair,
           std::uint64_t seed,
           PlaceKind kind,
           const SlamOptions& options,
           PairCounts& counts) {
  const PathLoopCloser closer;
  const Stops3& stops = pair.stops;
  Slam slam(options, closer);
  const double start_s = ProcessorSeconds();
  static_cast<void>(slam.Add(stops.scans[0], stops.T_odom_scan[0]));
  const SlamStep step = slam.Add(stops.scans[1], stops.T_odom_scan[1]);
  const double cpu_s = ProcessorSeconds() - start_s;
  counts.cpu_s += cpu_s;
  const Pose3& truth = stops.T_world_scan[1];
  const bool is_accepted = step.status == SlamStatus::kMatched;
  const bool is_right = IsRight(step.match.T_ref_cur, step.match.covariance, truth);
  const double nees = is_accepted ? NeesOf(step.T_map_scan, step.covariance, truth) : -1.0;
  const Pose3 error = truth.Inverse() * step.match.T_ref_cur;
  ++counts.pairs;
  counts.accepted += is_accepted ? 1 : 0;
  counts.wrong_accepted += is_accepted && !is_right ? 1 : 0;
  counts.right_rejected += !is_accepted && is_right ? 1 : 0;
  if (is_accepted) counts.nees.push_back(nees);
  if (is_accepted) counts.error_cm.push_back(100.0 * error.translation_m.norm());
  const bool is_remarkable = is_accepted != is_right || cpu_s > 1.0 || nees > 10.0;
  if (!is_remarkable) return;
  std::printf(
      "# %s %d overlap %.2f: %s, %s, %.1f cm %.2f deg, NEES %.1f, %zu pairs, %d it, %.2f s\n",
      std::string(kPlaceNames[static_cast<std::size_t>(kind)]).c_str(),
      static_cast<int>(seed),
      pair.overlap,
      is_accepted ? "accepted" : "rejected",
      is_right ? "right" : "wrong",
      100.0 * error.translation_m.norm(),
      kDegrees * RotationAngle(error.rotation),
      nees,
      step.match.pairs,
      step.match.iterations,
      cpu_s);
  std::fflush(stdout);
}

double MeanOf(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / std::max<double>(1.0, static_cast<double>(values.size()));
}

void Print(std::string_view name, const PairCounts& counts) {
  std::printf("%-9s %6d %9d %15d %15d %7.2f %8.2f %9.2f %8.2f %9.1f\n",
              std::string(name).c_str(),
              counts.pairs,
              counts.accepted,
              counts.wrong_accepted,
              counts.right_rejected,
              MeanOf(counts.nees),
              Quantile(counts.nees, 0.5),
              Quantile(counts.error_cm, 0.5),
              Quantile(counts.error_cm, 0.95),
              1e3 * counts.cpu_s / std::max(counts.pairs, 1));
}

void EvaluatePairs(const Arguments& arguments) {
  std::array<PairCounts, kPlaceNames.size()> counts;
  const auto only = static_cast<std::size_t>(
      std::find(kPlaceNames.begin(), kPlaceNames.end(), arguments.place) - kPlaceNames.begin());
  if (!arguments.place.empty() && only == kPlaceNames.size()) {
    throw std::invalid_argument("there is no place '" + arguments.place + "'");
  }
  for (std::uint64_t i = 0; i < arguments.count; ++i) {
    const std::uint64_t seed = arguments.first + i;
    const std::size_t place = arguments.place.empty() ? i % kPlaceNames.size() : only;
    const auto kind = static_cast<PlaceKind>(place);
    const std::optional<ScanPair3> pair = DrawPair(kind, seed, 0.05, 0.6);
    if (pair) Count(*pair, seed, kind, arguments.options.slam, counts[place]);
  }
  std::puts(
      "place      pairs  accepted  wrong accepted  right rejected    NEES   median  median cm  95 "
      "% cm  ms each");
  for (std::size_t kind = 0; kind < counts.size(); ++kind) Print(kPlaceNames[kind], counts[kind]);
}

Arguments Parse(int argc, char** argv) {
  Arguments arguments;
  qwsm::config::OptionSources sources;
  std::vector<std::string> words;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    (word.find('=') != std::string::npos ? sources.settings : words).push_back(word);
  }
  if (!words.empty()) arguments.task = words[0];
  if (words.size() > 1) arguments.count = std::stoull(words[1]);
  if (words.size() > 2) arguments.first = std::stoull(words[2]);
  if (words.size() > 3) arguments.place = words[3];
  arguments.options = qwsm::config::LoadOptions<options::RegistrationOptions>(sources);
  return arguments;
}

}  // namespace
}  // namespace slam6d::test

int main(int argc, char** argv) {
  try {
    const slam6d::test::Arguments arguments = slam6d::test::Parse(argc, argv);
    if (arguments.task == "loops") {
      slam6d::test::EvaluateLoops(arguments);
    } else if (arguments.task == "pairs") {
      slam6d::test::EvaluatePairs(arguments);
    } else {
      throw std::invalid_argument("name what to evaluate");
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr,
                 "evaluate_slam3: %s\nusage: evaluate_slam3 loops|pairs [COUNT [FIRST [PLACE]]] "
                 "[KEY=VALUE ...]\n",
                 error.what());
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
