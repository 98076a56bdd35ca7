// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/correction/self_correcting_mapper.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "qwsm/correction/anchored_path.hpp"
#include "qwsm/geometry/frame_covariance.hpp"
#include "qwsm/mapping/scan_locator.hpp"

namespace qwsm {
namespace {

// While nobody knows whether a robot was carried, so many of its scans are kept as they are.
constexpr std::size_t kKeptAsTheyAre = 1000;
// Of more, those of a robot that has not moved farther show nothing new.
constexpr double kAtRest_m = 0.05;
constexpr double kAtRest_rad = 0.05;

bool IsAtRest(const Pose2& moved) {
  return moved.translation_m().norm() < kAtRest_m && std::abs(moved.theta_rad) < kAtRest_rad;
}

ScanId NearestScan(const ScanMap& map, const Pose2& T_map_robot) {
  const auto squared_distance_m2 = [&](const RelevantScan& scan) {
    return (scan.map_robot.T_a_b.translation_m() - T_map_robot.translation_m()).squaredNorm();
  };
  return std::ranges::min_element(map.scans(), {}, squared_distance_m2)->id;
}

}  // namespace

SelfCorrectingMapper::SelfCorrectingMapper(const MapperOptions& options, WorkBeside beside)
    : options_(options),
      mapper_(options),
      corrector_(options, std::move(beside), ChainsOf::kOneRobot),
      path_(std::make_unique<AnchoredPath>()),
      watch_(options) {}

SelfCorrectingMapper::~SelfCorrectingMapper() = default;

MappingStep SelfCorrectingMapper::Process(const Observation& observation) {
  return lost_ ? Search(observation) : Map(observation);
}

MappingStep SelfCorrectingMapper::Map(const Observation& observation) {
  if (corrector_.IsLookDue()) {
    if (auto corrected = corrector_.LookAgain()) {
      GoOnIn(std::move(*corrected), observation.scan.stamp);
    }
  }
  MappingStep step = mapper_.Process(observation);
  step.epoch = static_cast<int>(epochs_.size());
  const PlaceDoubt doubt = watch_.Look(mapper_.map(), observation.scan, step);
  Note(observation, step.map_robot.T_a_b, path_->size());
  Take(step);
  if (doubt == PlaceDoubt::kLost) return Lose();
  if (doubt == PlaceDoubt::kInDoubt && step.status == StepStatus::kMatched) {
    step.status = StepStatus::kExtended;
    step.reason = "the map contradicts it";
  }
  return step;
}

// A robot that rests is asked no more until it drives on, for hours if need be: what it sees
// meanwhile is kept without readings, as if nothing was in view.
void SelfCorrectingMapper::Note(const Observation& observation,
                                const Pose2& T_map_robot,
                                std::size_t answers_before) {
  if (!watch_.is_asking()) {
    doubtful_ = {};
    return;
  }
  const bool begins = doubtful_.observations.empty() && !doubtful_.lost;
  if (begins) doubtful_.answers_before = answers_before;
  doubtful_.observations.push_back(observation);
  if (doubtful_.observations.size() > kKeptAsTheyAre &&
      IsAtRest(doubtful_.T_map_kept.Inverse() * T_map_robot)) {
    doubtful_.observations.back().scan.ranges_m = std::vector<float>();
  } else {
    doubtful_.T_map_kept = T_map_robot;
  }
}

void SelfCorrectingMapper::Take(const MappingStep& step, const std::optional<FoundBeside>& found) {
  path_->Take(step, nodes_.map_last());
  auto node = nodes_.Take(step);
  if (!node) return;
  node->robot = components_ - 1;
  node->found = found;
  corrector_.Add(std::move(*node));
}

// What was seen since the view broke is seen anew, in a frame of its own.
MappingStep SelfCorrectingMapper::Lose() {
  ++losses_;
  const bool was_found = watch_.is_asking_of_found_place();
  lost_ ? GiveUp() : TakeBack(static_cast<ScanId>(watch_.scans_before()));
  Doubtful doubtful = std::exchange(doubtful_, {});
  BeginLost(doubtful);
  watch_.BeginAnew(lost_->local().map());
  MappingStep step;
  for (const Observation& observation : doubtful.observations) {
    step = was_found ? FollowLost(observation) : Process(observation);
  }
  return step;
}

// Who was found where he is not goes on in what he had mapped.
void SelfCorrectingMapper::BeginLost(Doubtful& doubtful) {
  if (!doubtful.lost) {
    lost_.emplace(options_);
    return;
  }
  lost_ = std::move(doubtful.lost);
  lost_->LookAnew();
  lost_steps_ = std::move(doubtful.lost_steps);
}

// By these scans the robot was found where it is not: it is not looked for by them again.
MappingStep SelfCorrectingMapper::FollowLost(const Observation& observation) {
  MappingStep step = lost_->Follow(observation);
  step.epoch = static_cast<int>(epochs_.size());
  lost_steps_.push_back(step);
  return AsLost(std::move(step), lost_->belief());
}

// All is as it was before the view broke. @param first scan of the map since then.
void SelfCorrectingMapper::TakeBack(ScanId first) {
  mapper_.ForgetSince(first);
  corrector_.ForgetSince(first);
  path_->ForgetSince(doubtful_.answers_before, first);
  for (MapEpoch& epoch : epochs_) {
    if (epoch.map_node.size() > first) epoch.map_node.resize(first);
  }
  nodes_ = {};
  nodes_.Follow(mapper_.map().scans().back().map_robot);
}

// A robot that is lost once more before it was found.
void SelfCorrectingMapper::GiveUp() {
  lost_steps_.resize(doubtful_.answers_before);
  TakeUnplaced();
  lost_steps_.clear();
}

// They keep their place beside the last node.
void SelfCorrectingMapper::TakeUnplaced() {
  const UncertainPose2 map_last = nodes_.map_last().value_or(UncertainPose2{});
  for (const MappingStep& step : lost_steps_) {
    MappingStep unplaced = AsLost(step, lost_->belief());
    unplaced.map_robot = map_last * step.map_robot;
    path_->Take(unplaced, map_last);
  }
}

MappingStep SelfCorrectingMapper::Search(const Observation& observation) {
  MappingStep step = lost_->Follow(observation);
  lost_->LookFor(mapper_.map(), observation.scan, step);
  step.epoch = static_cast<int>(epochs_.size());
  const PlaceDoubt doubt = watch_.Look(lost_->local().map(), observation.scan, step);
  Note(observation, step.map_robot.T_a_b, lost_steps_.size());
  if (doubt == PlaceDoubt::kLost) return Lose();
  lost_steps_.push_back(step);
  if (lost_->is_found()) return Find(observation);
  return AsLost(std::move(step), lost_->belief());
}

// The place was found by a few points of the scan; all of them tell it better. It is as uncertain
// as the part of the map that they fit.
MappingStep SelfCorrectingMapper::Find(const Observation& observation) {
  LostRobot lost = *std::exchange(lost_, std::nullopt);
  std::vector<MappingStep> lost_steps = std::exchange(lost_steps_, {});
  const std::vector<ScanPoint> points = ToPoints(observation.scan);
  const MatchResult match =
      ScanLocator(options_.locator).Locate(mapper_.map(), points, lost.map_found());
  const Pose2& T_map_robot = match.T_ref_cur;
  const Eigen::Matrix3d of_map =
      mapper_.map().CovarianceUnder(points, T_map_robot).At(T_map_robot.translation_m());
  const UncertainPose2 map_robot{.T_a_b = T_map_robot, .covariance = of_map + match.covariance};
  const std::size_t scans_before = mapper_.map().scans().size();
  const std::size_t answers_before = path_->size();
  const ScanId beside = NearestScan(mapper_.map(), T_map_robot);
  const UncertainPose2 beside_map{.T_a_b = mapper_.map().scans()[beside].map_robot.T_a_b.Inverse()};
  Join(std::span(lost_steps).first(lost_steps.size() - 1),
       lost.FrameFor(map_robot),
       {beside, beside_map * lost.FrameFor(match.pose())});
  mapper_.PlaceAt(match.pose());
  MappingStep step = mapper_.Process(observation);
  step.epoch = static_cast<int>(epochs_.size());
  Take(step);
  step.reason = "found again";
  watch_.AskOfFoundPlace(mapper_.map(), scans_before);
  doubtful_ = {.answers_before = answers_before,
               .observations = {},
               .lost = std::move(lost),
               .lost_steps = std::move(lost_steps)};
  return step;
}

// @param local the robot's own frame, as seen from a node of the map.
void SelfCorrectingMapper::Join(std::span<const MappingStep> lost_steps,
                                const UncertainPose2& map_local,
                                const FoundBeside& local) {
  ++components_;
  bool begins = true;
  for (MappingStep step : lost_steps) {
    std::optional<FoundBeside> found;
    if (std::exchange(begins, false)) {
      step.closed_loop = true;
      found = {local.node, local.node_robot * step.map_relevant};
    }
    step.map_robot = map_local * step.map_robot;
    step.map_relevant = map_local * step.map_relevant;
    if (step.relevant) mapper_.Extend(step.relevant_scan, step.map_relevant);
    Take(step, found);
  }
}

// The robot keeps its place beside its last relevant scan.
void SelfCorrectingMapper::GoOnIn(CorrectedMap corrected, Timestamp stamp) {
  const UncertainPose2& map_last = corrected.map_node.back();
  const UncertainPose2 map_robot = map_last * Since(*nodes_.map_last(), mapper_.map_robot());
  watch_.Move(map_robot.T_a_b * mapper_.map_robot().T_a_b.Inverse());
  mapper_.GoOnIn(std::move(corrected.map), map_robot);
  nodes_.Follow(map_last);
  epochs_.push_back({.stamp = stamp, .map_node = std::move(corrected.map_node)});
}

Correction SelfCorrectingMapper::Correct() {
  Correction correction = corrector_.Correct();
  const std::size_t placed = path_->size();
  if (lost_) TakeUnplaced();
  correction.map_robot = path_->At(correction.map_node);
  path_->ForgetSince(placed, static_cast<NodeId>(correction.map_node.size()));
  return correction;
}

FinishedDrive SelfCorrectingMapper::Finish() {
  ForgetPoints();
  Correction correction = Correct();
  path_.reset();
  std::vector<RelevantScan> scans = std::move(corrector_).ScansAt(correction.map_node);
  return {.correction = std::move(correction), .scans = std::move(scans)};
}

}  // namespace qwsm
