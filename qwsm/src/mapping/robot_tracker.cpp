// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/mapping/robot_tracker.hpp"

#include <cmath>
#include <optional>
#include <utility>

#include "odometry_failure.hpp"
#include "pose_in_map.hpp"
#include "qwsm/geometry/position.hpp"
#include "qwsm/mapping/place_evidence.hpp"

namespace qwsm {
namespace {

ScanLocatorOptions LocatorOptions(const MapperOptions& options) {
  ScanLocatorOptions locator = options.locator;
  if (options.matcher == MatcherKind::kIcp) locator.matcher.weighting = PairWeighting::kIdentity;
  return locator;
}

}  // namespace

RobotTracker::RobotTracker(const MapperOptions& options)
    : options_(options),
      motion_(options.motion),
      locator_(LocatorOptions(options)),
      lasers_(options.motion),
      loop_detector_(locator_.options()),
      submap_(options.submap),
      seen_free_(options.free_space) {}

void RobotTracker::PlaceAt(const UncertainPose2& map_robot,
                           const std::optional<Pose2>& T_odom_robot) {
  motion_.Remember({}, T_odom_robot);
  gyro_.Restart(T_odom_robot);
  calibration_.Restart(T_odom_robot);
  slip_.Interrupt();
  LeavePath();
  map_last_ = local_last_ = map_robot;
  lasers_.Clear();
  has_initial_pose_ = true;
  stands_at_initial_pose_ = !T_odom_robot;
  held_.reset();
  bodies_.Forget();
}

void RobotTracker::FollowCorrection(const UncertainPose2& map_robot) {
  const Pose2 T_new_old = map_robot.T_a_b * map_last_.T_a_b.Inverse();
  const UncertainPose2 new_old{.T_a_b = T_new_old};
  map_last_ = map_robot;
  local_last_ = new_old * local_last_;
  lasers_.Move(T_new_old);
  if (held_) held_->map_robot = new_old * held_->map_robot;
  if (held_) held_->local = new_old * held_->local;
  submap_.Move(T_new_old);
  seen_free_.Move(T_new_old);
  bodies_.Move(T_new_old);
  dead_reckoning_.Move(T_new_old);
  if (apart_) apart_->Move(T_new_old);
  slip_.Interrupt();
}

TrackedScan RobotTracker::Track(const ScanMap& map, const Observation& told) {
  const Observation observation = bodies_.HiddenIn(told);
  const std::optional<Pose2> T_by_gyro = gyro_.Follow(observation);
  const std::optional<Pose2> T_odom_robot = calibration_.Follow(T_by_gyro, gyro_.leads());
  motion_.SetHeadingByGyro(gyro_.leads());
  Sighting sighting = LookTwice(map, observation, T_odom_robot);
  MappingStep& step = sighting.step;
  const Observation& still = sighting.observation;
  LearnMotion(sighting, map.scans().size());
  const bool odometry_is_new = is_odometry_suspect_ && sighting.dropped_odometry;
  odometry_is_new ? bodies_.Forget() : bodies_.Place(step.map_robot.T_a_b);
  // A scan whose pose is dead-reckoned extends the map like any other once the robot has moved on:
  // beyond the surfaces mapped so far no scan can be matched, and the map would end there for good.
  // The covariance of the pose goes with its points.
  const bool has_moved_on = !apart_ && HasMovedOn(still.scan, sighting.points, step);
  const bool extends = has_moved_on && (options_.extend_map || step.status == StepStatus::kFirst);
  if (extends) CloseLoop(map, still.scan, sighting.points, step);
  slip_.Learn(observation, sighting.velocity, step);
  Remember(sighting, has_moved_on);
  Extend(extends, still, sighting.points, step);
  if (has_moved_on) seen_free_.Add(still.scan, step.map_robot.T_a_b);
  return {.step = std::move(step),
          .scan = std::move(sighting.observation.scan),
          .points = std::move(sighting.points)};
}

// How the robot moved while the scan was taken the scan itself tells best: where it is found to be
// taken is learned as if for good, and by that its beams are moved anew.
RobotTracker::Sighting RobotTracker::LookTwice(const ScanMap& map,
                                               const Observation& observation,
                                               const std::optional<Pose2>& T_odom_robot) const {
  Sighting first = Look(map, slip_.Mended(observation), T_odom_robot, observation.gyro_rad);
  if (!first.velocity) return first;
  SlipEstimator slip = slip_;
  slip.Learn(observation, first.velocity, first.step);
  StillScan still = slip.Mended(observation);
  const bool has_learned = still.velocity != first.velocity;
  return has_learned ? Look(map, std::move(still), T_odom_robot, observation.gyro_rad) : first;
}

RobotTracker::Sighting RobotTracker::Look(const ScanMap& map,
                                          StillScan still,
                                          const std::optional<Pose2>& T_odom_robot,
                                          const std::optional<double>& gyro_rad) const {
  Sighting sighting{.observation = {.scan = std::move(still.scan),
                                    .T_odom_robot = T_odom_robot,
                                    .gyro_rad = gyro_rad},
                    .velocity = still.velocity};
  sighting.points = ToPoints(sighting.observation.scan);
  sighting.step.stamp = sighting.observation.scan.stamp;
  map.empty() ? Begin(sighting) : Locate(map, sighting);
  return sighting;
}

// The map that the first scan begins has the same error as its pose.
void RobotTracker::Begin(Sighting& sighting) const {
  MappingStep& step = sighting.step;
  step.reason = "first scan";
  step.map_robot = FirstPose(sighting.observation);
  step.match.T_ref_cur = step.map_robot.T_a_b;
  if (sighting.points.empty()) step.local_covariance = step.map_robot.covariance;
}

// Where the robot was placed, or has driven to since without seeing anything. Without an initial
// pose the first one is the odometry's, so that both frames begin together.
UncertainPose2 RobotTracker::FirstPose(const Observation& observation) const {
  const std::optional<Pose2>& T_odom_robot = observation.T_odom_robot;
  if (!has_initial_pose_) return {.T_a_b = T_odom_robot.value_or(Pose2{})};
  const bool is_first_since_placed = lasers_.empty();
  if (is_first_since_placed || !T_odom_robot) return map_last_;
  const double share = lasers_.ShareOfPeriod(observation.scan);
  return map_last_ * motion_.Predict(T_odom_robot, share).conservative;
}

void RobotTracker::Locate(const ScanMap& map, Sighting& sighting) const {
  const Observation& observation = sighting.observation;
  const std::span<const ScanPoint> points = sighting.points;
  MappingStep& step = sighting.step;
  const double share = lasers_.ShareOfPeriod(observation.scan);
  PosePrediction last_robot = stands_at_initial_pose_
                                  ? PosePrediction::Unmoved()
                                  : motion_.Predict(observation.T_odom_robot, share);
  // No robot drives out of all maps: its odometry has failed.
  const bool is_in_map = IsPosition((map_last_ * last_robot.conservative).T_a_b);
  if (!is_in_map) last_robot = PosePrediction::Unmoved();
  step.match = LocateNear(map, observation, points, PathOfMatches() * last_robot);
  sighting.dropped_odometry = DropFailedOdometry(map, observation, points, last_robot, step);
  if (!sighting.dropped_odometry) {
    sighting.apart = ComparePaths(map, points, last_robot.adapted, step.match);
  }
  step.odometry_motion = last_robot.adapted;
  step.odometry_adds_up = gyro_.leads() && !sighting.dropped_odometry &&
                          !IsFarFrom(local_last_ * last_robot.adapted, step.match.pose());
  step.map_robot = map_last_ * last_robot.conservative;
  step.local_covariance = (local_last_ * last_robot.conservative).covariance;
  const UncertainPose2 last_in_map{.T_a_b = map_last_.T_a_b};
  Judge(map, points, (last_in_map * last_robot.conservative).covariance, step);
  JudgePaths(sighting);
  sighting.last_robot = last_robot;
}

// What a scan tells of the motion before it. The first one tells nothing.
void RobotTracker::LearnMotion(const Sighting& sighting, std::size_t scans) {
  if (!sighting.last_robot) return;
  const MappingStep& step = sighting.step;
  const UncertainPose2& last_robot = sighting.last_robot->adapted;
  if (sighting.dropped_odometry) dead_reckoning_.Clear();
  apart_ = sighting.apart;
  if (step.status == StepStatus::kMatched) {
    motion_.Adapt(local_last_ * last_robot,
                  ToldAlone(step.match),
                  sighting.observation.T_odom_robot,
                  lasers_.ShareOfPeriod(sighting.observation.scan));
  }
  const bool is_found = step.status != StepStatus::kDeadReckoned;
  dead_reckoning_.Follow(last_robot,
                         apart_ ? apart_->by_odometry().T_a_b : step.map_robot.T_a_b,
                         is_found ? InformationAdded(step.match) : Eigen::Matrix3d::Zero(),
                         scans);
  if (!apart_ || !apart_->is_decided()) return;
  if (!apart_->is_by_odometry()) dead_reckoning_.Clear();
  apart_.reset();
}

// Where the robot would be if it had moved as before, the scan may agree with the map much better.
// @return whether it does, and odometry is not believed.
bool RobotTracker::DropFailedOdometry(const ScanMap& map,
                                      const Observation& observation,
                                      std::span<const ScanPoint> points,
                                      PosePrediction& last_robot,
                                      MappingStep& step) const {
  if (!observation.T_odom_robot) return true;
  const double share = lasers_.ShareOfPeriod(observation.scan);
  const OdometryDoubt doubt{.may_have_begun_anew = is_odometry_suspect_,
                            .is_surprising = motion_.IsSurprising(observation.T_odom_robot, share),
                            .is_impossible = IsTooFast(last_robot.conservative.T_a_b,
                                                       lasers_.SinceLast(observation.scan))};
  const OdometryFailure failure(map, points, step.match, doubt);
  if (!failure.IsPossible()) return false;
  const PosePrediction without_odometry = motion_.Predict(std::nullopt, share);
  const UncertainPose2 predicted = local_last_ * without_odometry.conservative;
  const auto other =
      locator_.LocateExplaining(map, points, predicted, failure.LeastToShow(), seen_free_);
  if (!other || !failure.IsShownBy(*other)) return false;
  last_robot = without_odometry;
  step.match = *other;
  return true;
}

// Near where the robot is by odometry and by what its other lasers have just told; by odometry
// alone where that explains much more of the scan.
MatchResult RobotTracker::LocateNear(const ScanMap& map,
                                     const Observation& observation,
                                     std::span<const ScanPoint> points,
                                     const PosePrediction& predicted) const {
  const std::optional<UncertainPose2> told = lasers_.ToldByOthers(observation);
  if (!told) return locator_.Locate(map, points, predicted, seen_free_);
  const MatchResult match = locator_.Locate(map, points, Fused(predicted, *told), seen_free_);
  if (match.overlap >= locator_.options().confident_overlap) return match;
  const MatchResult alone = locator_.Locate(map, points, predicted, seen_free_);
  return alone.overlap > match.overlap + locator_.options().widen_gain ? alone : match;
}

// The last matches may have been wrong, each a little, or this one by far, beside an odometry that
// has proved to be better than that.
// @param match is that where odometry has the robot, if that is believed.
// @return both paths, if either may be right.
std::optional<PathsApart> RobotTracker::ComparePaths(const ScanMap& map,
                                                     std::span<const ScanPoint> points,
                                                     const UncertainPose2& last_robot,
                                                     MatchResult& match) const {
  const std::optional<UncertainPose2> reckoned =
      apart_ ? apart_->by_odometry() * last_robot : dead_reckoning_.Predict(last_robot);
  if (!reckoned || !IsFarFrom(*reckoned, match.pose())) return std::nullopt;
  const double max_moving_share = options_.free_space.max_moving_share;
  const auto there = locator_.LocateWithin(
      map, points, *reckoned, LeastToDoubt(points, match, max_moving_share), seen_free_);
  if (!there || IsFarFrom(*reckoned, there->pose()) || !IsFarFrom(there->pose(), match.pose())) {
    return std::nullopt;
  }
  const auto before = static_cast<ScanId>(dead_reckoning_.scans_before());
  const auto end_at = [&](const MatchResult& pose) -> PathEnd {
    return {pose, PlaceEvidence::ExplainedBefore(map, points, pose.T_ref_cur, before)};
  };
  const UncertainPose2 expected = PathOfMatches() * last_robot;
  auto apart =
      PathsApart::Weigh(points, apart_, expected, end_at(match), end_at(*there), max_moving_share);
  const bool stays =
      apart ? apart->is_by_odometry() : !apart_ && !IsSlipTold(points, expected, match, *there);
  if (stays) match = *there;
  return apart;
}

// While two poses may be right, none is one that the map confirms.
void RobotTracker::JudgePaths(Sighting& sighting) const {
  MappingStep& step = sighting.step;
  if (step.status == StepStatus::kDeadReckoned) return;
  const bool is_by_odometry = sighting.apart && sighting.apart->is_by_odometry();
  const bool was_by_odometry = apart_ && apart_->is_by_odometry();
  step.closed_loop = is_by_odometry != was_by_odometry;
  if (!sighting.apart) return;
  step.status = StepStatus::kExtended;
  step.reason = is_by_odometry ? "where odometry has it" : "not where odometry has it";
}

// The verdicts of Visser et al. (2009, section 4): a good correspondence is the pose, a bad one
// leaves dead reckoning. Departing from them, a correspondence below a threshold does not extend
// the map by itself; the thresholds of their section 3 on how far the robot moved do, see
// HasMovedOn(). To let it changed no figure of the five recorded logs (scripts/evaluate).
void RobotTracker::Judge(const ScanMap& map,
                         std::span<const ScanPoint> points,
                         const Eigen::Matrix3d& motion_covariance,
                         MappingStep& step) const {
  const MatchResult& match = step.match;
  step.status = StepStatus::kDeadReckoned;
  if (!HasMatched(match)) {
    step.reason = Name(match.status);
    return;
  }
  const UncertainPose2 predicted = step.map_robot;
  PoseInMap found = InMap(map, points, predicted.covariance, motion_covariance, match);
  // What the baselines find they believe.
  const double probability = options_.matcher == MatcherKind::kQWsm
                                 ? ProbabilityOfPose(map, points, match, found.sigma_m)
                                 : 1.0;
  if (probability < 0.5) {
    step.reason = "may as well be elsewhere";
    return;
  }
  step.status = StatusOf(match);
  step.reason =
      step.status == StepStatus::kExtended ? "much of the scan is new" : "agrees with the map";
  const UncertainPose2 locally_predicted{.T_a_b = predicted.T_a_b,
                                         .covariance = step.local_covariance};
  found.map_robot.covariance +=
      UncertainPose2::WithSigmas({}, options_.match_floor_m, options_.match_floor_rad).covariance;
  step.map_robot = {.T_a_b = match.T_ref_cur,
                    .covariance = CovarianceOfEither(found.map_robot, probability, predicted)};
  step.local_covariance = CovarianceOfEither(match.pose(), probability, locally_predicted);
}

StepStatus RobotTracker::StatusOf(const MatchResult& match) const {
  return match.overlap < options_.extended_below_overlap ? StepStatus::kExtended
                                                         : StepStatus::kMatched;
}

// By what the scan alone tells: the pose is by the gyro as well.
void RobotTracker::LearnOdometry(const Sighting& sighting) {
  const std::optional<UncertainPose2> look = lasers_.last_look();
  if (!look || sighting.step.status == StepStatus::kFirst) return;
  gyro_.Learn(NormalizeAngle(look->T_a_b.theta_rad - local_last_.T_a_b.theta_rad),
              std::sqrt(look->covariance(2, 2) + local_last_.covariance(2, 2)));
  if (sighting.dropped_odometry || sighting.step.status != StepStatus::kMatched) return;
  calibration_.Learn(local_last_, sighting.step.odometry_motion, *look);
}

void RobotTracker::Remember(const Sighting& sighting, bool has_moved_on) {
  const Observation& observation = sighting.observation;
  const MappingStep& step = sighting.step;
  const bool is_first = step.status == StepStatus::kFirst;
  const std::optional<Pose2> T_map_before =
      lasers_.empty() ? map_last_.T_a_b : lasers_.LastPoseOf(observation.scan);
  if (is_first) {
    motion_.Remember({}, observation.T_odom_robot);
  } else if (T_map_before) {
    motion_.Remember(T_map_before->Inverse() * step.map_robot.T_a_b, observation.T_odom_robot);
  } else {
    motion_.RememberOdometry(observation.T_odom_robot);
  }
  lasers_.Note(observation, step, has_moved_on);
  LearnOdometry(sighting);
  map_last_ = step.map_robot;
  local_last_ = {.T_a_b = step.map_robot.T_a_b, .covariance = step.local_covariance};
  has_initial_pose_ = has_initial_pose_ && is_first && !has_moved_on;
  stands_at_initial_pose_ = has_initial_pose_ && !observation.T_odom_robot;
  is_odometry_suspect_ = false;
}

}  // namespace qwsm
