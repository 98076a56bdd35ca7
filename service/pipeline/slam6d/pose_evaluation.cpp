// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/slam6d/pose_evaluation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>
#include <stdexcept>

#include "service/config/text_table.hpp"
#include "service/pipeline/text/json.hpp"
#include "slam6d/icp/closed_form.hpp"

namespace slam6d::pipeline {
namespace {

using qwsm::pipeline::Json;

constexpr double kDegreesPerRadian = 180.0 / std::numbers::pi;

/// Stamps may be so many seconds apart, as for `qwsm eval` and others: truth has a clock, and a
/// rate, of its own. Numbers of scans are never as near to each other.
constexpr double kMostApart = 0.01;

struct PosePair3 {
  Pose3 estimate;
  Pose3 truth;
};

std::string NumbersText(const io::NumberedPoses& poses) {
  if (poses.empty()) return "none";
  return fmt::format("{} to {}", poses.begin()->first, poses.rbegin()->first);
}

/// The pose of the number, or of the nearest stamp; null where none is near enough.
const Pose3* PoseAt(const io::NumberedPoses& poses, double number) {
  auto nearest = poses.lower_bound(number);
  if (nearest != poses.begin()) {
    const auto before = std::prev(nearest);
    const bool is_nearer =
        nearest == poses.end() || number - before->first < nearest->first - number;
    if (is_nearer) nearest = before;
  }
  if (nearest == poses.end() || !(std::abs(nearest->first - number) <= kMostApart)) return nullptr;
  return &nearest->second;
}

std::vector<PosePair3> PairUp(const io::NumberedPoses& estimate, const io::NumberedPoses& truth) {
  std::vector<PosePair3> pairs;
  for (const auto& [number, pose] : estimate) {
    const Pose3* const true_pose = PoseAt(truth, number);
    if (true_pose != nullptr) pairs.push_back({pose, *true_pose});
  }
  if (pairs.empty()) {
    throw std::runtime_error(
        fmt::format("no scan has a pose in both trajectories: here their numbers, or stamps, are "
                    "{}, those of the truth {}; equal ones are compared, of stamps within 0.01 s",
                    NumbersText(estimate),
                    NumbersText(truth)));
  }
  return pairs;
}

std::vector<double> NumbersIn(const io::NumberedPoses& poses) {
  std::vector<double> numbers;
  for (const auto& [number, pose] : poses) numbers.push_back(number);
  return numbers;
}

/// Every tenth pose of a drive covers it; the first tenth of its poses does not.
double CoveredShare(const io::NumberedPoses& estimate, const io::NumberedPoses& truth) {
  const double all = truth.rbegin()->first - truth.begin()->first;
  if (!(all > 0.0)) return 1.0;
  const auto is_common = [&](const auto& numbered) {
    return PoseAt(estimate, numbered.first) != nullptr;
  };
  const auto first = std::find_if(truth.begin(), truth.end(), is_common);
  const auto last = std::find_if(truth.rbegin(), truth.rend(), is_common);
  return (last->first - first->first) / all;
}

/// The motion that lays the estimate over the truth.
Pose3 AlignmentOf(const std::vector<PosePair3>& pairs, PoseAlignment alignment) {
  if (alignment == PoseAlignment::kNone) return {};
  if (alignment == PoseAlignment::kFirst) {
    return pairs.front().truth * pairs.front().estimate.Inverse();
  }
  PairMoments moments{.count = static_cast<double>(pairs.size())};
  for (const PosePair3& pair : pairs) {
    moments.center_ref_m += pair.truth.translation_m / moments.count;
    moments.center_cur_m += pair.estimate.translation_m / moments.count;
  }
  for (const PosePair3& pair : pairs) {
    moments.H_m2 += (pair.estimate.translation_m - moments.center_cur_m) *
                    (pair.truth.translation_m - moments.center_ref_m).transpose();
  }
  const std::optional<Pose3> best = AlignPairs(moments, ClosedForm::kSvd);
  if (!best) throw std::runtime_error("the positions lie on a line: --align best needs others");
  return *best;
}

}  // namespace

PoseErrors Compare(const io::NumberedPoses& estimated,
                   const io::NumberedPoses& true_poses,
                   PoseAlignment alignment) {
  const io::NumberedPoses truth = io::Renumbered(true_poses, NumbersIn(estimated));
  const io::NumberedPoses estimate = io::Renumbered(estimated, NumbersIn(truth));
  const std::vector<PosePair3> pairs = PairUp(estimate, truth);
  const Pose3 T_truth_estimate = AlignmentOf(pairs, alignment);
  PoseErrors errors{
      .poses = pairs.size(), .true_poses = truth.size(), .covered = CoveredShare(estimate, truth)};
  const auto count = static_cast<double>(pairs.size());
  double sum_m2 = 0.0;
  double sum_rad2 = 0.0;
  for (const PosePair3& pair : pairs) {
    const Pose3 error = pair.truth.Inverse() * (T_truth_estimate * pair.estimate);
    const double distance_m = error.translation_m.norm();
    const double angle_rad = RotationAngle(error.rotation);
    sum_m2 += distance_m * distance_m;
    sum_rad2 += angle_rad * angle_rad;
    errors.mean_m += distance_m / count;
    errors.mean_rad += angle_rad / count;
    errors.max_m = std::max(errors.max_m, distance_m);
    errors.max_rad = std::max(errors.max_rad, angle_rad);
  }
  errors.rmse_m = std::sqrt(sum_m2 / count);
  errors.rmse_rad = std::sqrt(sum_rad2 / count);
  return errors;
}

std::string ErrorTable(std::span<const NamedErrors> all) {
  std::vector<std::vector<std::string>> rows{
      {"metric", "unit", "poses", "rmse", "mean", "max", "trajectory"}};
  const auto add =
      [&](const char* metric, const char* unit, const NamedErrors& named, auto values) {
        std::vector<std::string> row{metric, unit, fmt::format("{}", named.errors.poses)};
        for (const double value : values) row.push_back(fmt::format("{:.5f}", value));
        row.push_back(named.name);
        rows.push_back(std::move(row));
      };
  for (const NamedErrors& named : all) {
    const PoseErrors& e = named.errors;
    add("ate translation", "m", named, std::array{e.rmse_m, e.mean_m, e.max_m});
    add("ate rotation",
        "deg",
        named,
        std::array{e.rmse_rad * kDegreesPerRadian,
                   e.mean_rad * kDegreesPerRadian,
                   e.max_rad * kDegreesPerRadian});
  }
  return qwsm::config::FormatTable(rows);
}

std::string ErrorJson(std::span<const NamedErrors> all) {
  Json list = Json::Array();
  for (const NamedErrors& named : all) {
    const PoseErrors& e = named.errors;
    Json json;
    json["trajectory"] = named.name;
    json["poses"] = e.poses;
    json["true_poses"] = e.true_poses;
    json["ate"]["rmse_m"] = e.rmse_m;
    json["ate"]["mean_m"] = e.mean_m;
    json["ate"]["max_m"] = e.max_m;
    json["ate"]["rmse_deg"] = e.rmse_rad * kDegreesPerRadian;
    json["ate"]["mean_deg"] = e.mean_rad * kDegreesPerRadian;
    json["ate"]["max_deg"] = e.max_rad * kDegreesPerRadian;
    list.Add(std::move(json));
  }
  return list.Text();
}

}  // namespace slam6d::pipeline
