// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/team/service/robot_session.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "qwsm/geometry/frame_covariance.hpp"
#include "qwsm/geometry/position.hpp"
#include "service/team/map/moving_robots.hpp"
#include "service/team/scans/component.hpp"

namespace qwsm::team {
namespace {

using std::chrono::steady_clock;

// How far a robot may have been pushed while nobody looked, and how exact a found place is.
constexpr double kPushed_m = 0.3;
constexpr double kPushed_rad = 0.1;

UncertainPose2 Loosened(UncertainPose2 pose) {
  pose.covariance.diagonal() += Eigen::Vector3d(kPushed_m, kPushed_m, kPushed_rad).cwiseAbs2();
  return pose;
}

}  // namespace

RobotSession::RobotSession(std::string name,
                           const SessionOptions& options,
                           const MapperOptions& mapper,
                           SessionContext context)
    : context_(std::move(context)),
      events_(std::move(name),
              [this](const TeamEvent& event) { context_.sinks.Tell(&TeamSink::TakeEvent, event); }),
      intake_(events_, options),
      tracker_(mapper),
      watch_(mapper.free_space, PlaceWatch::MapKind::kGrowing),
      easing_(context_.correction),
      sequence_(std::max(
          context_.atlas.maps().Of(this->name()).map->LastSequence(context_.service, this->name()),
          SequenceOfNow())) {}

void RobotSession::PlaceAt(const UncertainPose2& map_robot) {
  const std::string_view objection = ObjectionTo(map_robot);
  if (!objection.empty()) return events_.Warn(objection);
  {
    const std::lock_guard lock(mutex_);
    initial_pose_ = map_robot;
  }
  events_.Inform("was told where it is");
}

void RobotSession::RunOne() {
  std::optional<Work> work = intake_.Take();
  if (!work) return;
  const std::optional<Pose2> claimed =
      tracker_.Mount(work->scan, work->T_robot_sensor_claimed, is_placed_);
  HideTeammates(*work);
  Answer(*work, claimed);
}

void RobotSession::Answer(Work& work, const std::optional<Pose2>& claimed_mounting) {
  const auto begun = steady_clock::now();
  const Observation observation{
      .scan = std::move(work.scan), .T_odom_robot = work.T_odom_robot, .gyro_rad = work.gyro_rad};
  work.scan.stamp = observation.scan.stamp;
  is_placed_ = is_placed_ && !work.was_elsewhere;
  ContestedTracker::Tracked tracked = Track(work, observation, claimed_mounting);
  const auto answered = steady_clock::now();
  tracked.step.epoch = static_cast<int>(version_.epoch);
  const MappingStep& step = tracked.step;
  TellNews(tracked.news);
  const SessionCounts counts = Note(work, tracked, answered - begun);
  component_.map->robots().Report(name(), step.map_robot.T_a_b.translation_m(), answered);
  const RobotAnswer answer{.robot = name(),
                           .step = AsTold(step),
                           .component = ComponentName(),
                           .version = version_,
                           .last_relevant = LastRelevantPlace(),
                           .T_odom_robot = work.T_odom_robot,
                           .lacks_odometry = work.lacks_odometry,
                           .told = easing_.Tell(step, work.T_odom_robot),
                           .matching = answered - begun,
                           .latency = answered - work.arrived,
                           .scans = counts.scans,
                           .dropped = counts.dropped};
  context_.sinks.Tell(&TeamSink::TakeAnswer, answer);
  TellWhatIsSeen(step, tracked.points);
  Extend(tracked);
  context_.report(answer);
}

ContestedTracker::Tracked RobotSession::Track(const Work& work,
                                              const Observation& observation,
                                              const std::optional<Pose2>& claimed_mounting) {
  {
    TeamMap::State::View contents = FollowCorrections();
    const MapComponent before = component_;  // Lives as long as the view of it.
    Place();
    if (component_.map != before.map) contents = component_.map->Read();
    // Odometry that moves faster than any robot has begun anew; after an interruption it may have.
    const bool may_be_new = work.odometry_goes_on && work.is_interrupted;
    if (work.odometry_jumped || may_be_new) tracker_.SuspectOdometryReset();
    ContestedTracker::Tracked tracked =
        tracker_.Track(contents->map, observation, claimed_mounting);
    if (!IsLost(contents->map, tracked)) return tracked;
  }
  LoseIt();
  return tracker_.Track(component_.map->Read()->map, observation, claimed_mounting);
}

// What is seen in doubt does not extend the map: it would speak for the place that is in doubt, and
// stay there. Nor is it told as a match.
bool RobotSession::IsLost(const ScanMap& map, ContestedTracker::Tracked& tracked) {
  if (tracker_.is_place_contested() || !IsWatched(map)) return false;
  const PlaceDoubt doubt =
      watch_.Look(map, tracked.points, tracked.step, [this](ScanId scan) { return Counts(scan); });
  if (doubt == PlaceDoubt::kNone) return false;
  if (tracked.step.status == StepStatus::kMatched) tracked.step.status = StepStatus::kExtended;
  tracked.step.reason = "the map contradicts it";
  tracked.step.relevant = false;
  tracked.relevant.clear();
  return doubt == PlaceDoubt::kLost;
}

// A robot alone in a map of its own making contradicts nobody but itself: that is what loops mend,
// as in a map that is made of its log.
bool RobotSession::IsWatched(const ScanMap& map) const {
  const TeamMaps& maps = context_.atlas.maps();
  if (maps.sharing() != MapSharing::kTeam) return false;
  return maps.size() > 1 || map.scans().size() > component_.map->CountOf(name());
}

// Its own way drifts, which loops mend. Whoever began the map is where it says. Others may have
// been told wrongly where they are, and what they saw tells nothing of who comes along later.
bool RobotSession::Counts(ScanId scan) const {
  const ScanKey key = component_.map->KeyOf(scan);
  if (key.robot == name()) return false;
  if (key.robot == component_.map->KeyOf(0).robot) return true;
  return key.service == context_.service && !context_.merger.IsPlaceOpen(key.robot);
}

// What a robot is answered in a frame of its own is no guess at its place in the team's.
MappingStep RobotSession::AsTold(MappingStep step) const {
  if (!IsApart()) return step;
  step.status = StepStatus::kLost;
  step.reason = "in a map of its own";
  return step;
}

// The robot keeps its place beside its last relevant scan, also where that has become part of
// another component. The map as it is then is what the next scan has to be matched with.
TeamMap::State::View RobotSession::FollowCorrections() {
  const std::string component_before = component_.name;
  component_ = context_.atlas.maps().Of(name());
  TeamMap::State::View contents = component_.map->Read();
  const MapVersion now = component_.map->VersionOf(*contents);
  const MapVersion before = std::exchange(version_, now);
  if (before == now) return contents;
  before.map == now.map ? watch_.FollowCorrection() : watch_.BeginInAnotherMap();
  if (!last_relevant_) return contents;
  const std::optional<ScanId> last = component_.map->Find(last_relevant_->key);
  if (!last) {  // Another service has answered the robot since, elsewhere.
    last_relevant_.reset();
    is_placed_ = false;
    return contents;
  }
  const UncertainPose2& map_last = contents->map.scans()[*last].map_robot;
  const Pose2 T_before_robot = tracker_.map_robot().T_a_b;
  tracker_.FollowCorrection(map_last * Since(*nodes_.map_last(), tracker_.map_robot()));
  if (component_.name == component_before) {
    easing_.Correct(T_before_robot, tracker_.map_robot().T_a_b);
  } else {
    easing_.Forget();  // Between frames there is no way.
  }
  nodes_.Follow(map_last);
  return contents;
}

void RobotSession::Extend(ContestedTracker::Tracked& tracked) {
  std::optional<ScanNode> node = nodes_.Take(tracked.step);
  for (TeamScan& scan : tracked.relevant) {
    scan.key = {.service = context_.service, .robot = name(), .sequence = ++sequence_};
    // Of scans that had to wait for the end of a trial odometry alone is known.
    if (node && tracked.relevant.size() == 1) {
      scan.motion = {.odometry = node->odometry, .T_last_this = node->T_last_node};
    }
    scan.is_new_start = std::exchange(is_new_start_, false);
    ExtendWith(scan);
    nodes_.Follow(scan.map_robot);
  }
}

// While the scan was matched, others may have corrected the map.
void RobotSession::ExtendWith(TeamScan& scan) {
  scan.component = ComponentName();
  const std::vector<ScanPoint> points = ToPoints(scan.scan);
  while (!context_.atlas.Extend(scan, points, version_)) {
    const UncertainPose2 robot_scan{.T_a_b = tracker_.map_robot().T_a_b.Inverse() *
                                             scan.map_robot.T_a_b};
    FollowCorrections();
    if (!is_placed_) return;
    scan.component = ComponentName();
    scan.map_robot.T_a_b = (tracker_.map_robot() * robot_scan).T_a_b;
  }
  last_relevant_ = {.key = scan.key, .stamp = scan.scan.stamp};
}

std::optional<RelevantPlace<Planar>> RobotSession::LastRelevantPlace() const {
  if (!last_relevant_) return std::nullopt;
  return RelevantPlace<Planar>{.stamp = last_relevant_->stamp, .map_robot = *nodes_.map_last()};
}

// Only where there is something to be found.
void RobotSession::TellWhatIsSeen(const MappingStep& step, std::span<const ScanPoint> points) {
  if (context_.atlas.maps().size() < 2 || step.status == StepStatus::kDeadReckoned) return;
  context_.merger.See(name(),
                      {.component = component_,
                       .version = version_,
                       .points = {points.begin(), points.end()},
                       .map_robot = step.map_robot});
}

void RobotSession::TellNews(ContestedTracker::News news) {
  switch (news) {
    case ContestedTracker::News::kNone:
      return;
    case ContestedTracker::News::kPlaceContradicted:
      intake_.NoteContradictedPose();
      return events_.Warn(
          "is not where it was told, says the map: it is back where it was tracked");
    case ContestedTracker::News::kMountingContested:
      return events_.Warn(
          "/tf_static has its laser elsewhere while it drives: its scans will tell");
    case ContestedTracker::News::kMountingRefuted:
      intake_.NoteContradictedMounting();
      return events_.Warn("its laser is not where /tf_static has it now, say its scans");
    case ContestedTracker::News::kMountingChanged:
      return events_.Inform("its laser is where /tf_static has it now, say its scans");
  }
}

void RobotSession::Place() {
  std::optional<UncertainPose2> initial_pose;
  {
    const std::lock_guard lock(mutex_);
    initial_pose = std::exchange(initial_pose_, std::nullopt);
  }
  if (initial_pose || !is_placed_) {
    easing_.Forget();
    watch_.BeginAnew();
  }
  if (initial_pose) {
    TakeUp(*initial_pose);
  } else if (is_placed_) {
    return;
  } else if (const std::optional<TeamScan> last = component_.map->LastOf(name())) {
    tracker_.PlaceAt(Loosened(last->map_robot), last->T_odom_robot);
    tracker_.SuspectOdometryReset();
  } else if (context_.start) {
    tracker_.PlaceAt(*context_.start);
    context_.merger.HearPlaceOf(name());
  } else if (!component_.map->Begin()) {
    BeginComponent();
  }
  is_placed_ = true;
}

// What a robot is told is where it is in the map that all share. What it has mapped in a component
// stays there until that is found in the map, too.
void RobotSession::TakeUp(const UncertainPose2& told) {
  context_.merger.HearPlaceOf(name());
  if (IsApart()) {
    context_.atlas.maps().Put(name(), "");
    component_ = context_.atlas.maps().Of(name());
    BeginAnewAt(told);
  } else if (is_placed_) {
    tracker_.PlaceAsTold(told);
  } else {
    tracker_.PlaceAt(told);
  }
}

// Where each robot has a map of its own there is none that it could be apart from.
bool RobotSession::IsApart() const {
  return context_.atlas.maps().sharing() == MapSharing::kTeam && !component_.name.empty();
}

void RobotSession::BeginComponent() {
  component_ = context_.atlas.maps().BeginFor(name());
  component_.map->Begin();
  BeginAnewAt({});
  events_.Inform("begins a map of its own, " + FrameOf(component_.name) +
                 ": nobody knows where in the team's it is");
}

void RobotSession::LoseIt() {
  events_.Warn("is lost: what it sees contradicts the map");
  easing_.Forget();
  BeginComponent();
}

void RobotSession::BeginAnewAt(const UncertainPose2& map_robot) {
  watch_.BeginInAnotherMap();
  version_ = component_.map->version();
  last_relevant_.reset();
  nodes_ = {};
  is_new_start_ = true;
  tracker_.PlaceAt(map_robot);
}

// To a robot in a corridor, another one that comes along is the only thing that tells how far it
// has gone: wrongly, for it moves.
void RobotSession::HideTeammates(Work& work) {
  const std::optional<Pose2> T_odom_last = std::exchange(T_odom_last_, work.T_odom_robot);
  if (!is_placed_) return;
  const bool is_motion_known = work.T_odom_robot && T_odom_last && work.odometry_goes_on;
  const Pose2 T_last_robot =
      is_motion_known ? T_odom_last->Inverse() * *work.T_odom_robot : Pose2{};
  HideRobots(component_.map->robots().OthersThan(name(), steady_clock::now()),
             context_.teammate_radius_m,
             tracker_.map_robot().T_a_b * T_last_robot,
             work.scan);
  HideUnplacedRobots(work);
}

// Robots in other components may be anywhere.
void RobotSession::HideUnplacedRobots(Work& work) {
  const TeamMaps& maps = context_.atlas.maps();
  const bool are_all_placed = maps.sharing() != MapSharing::kTeam || maps.size() < 2;
  if (are_all_placed || !work.T_odom_robot || !work.odometry_goes_on || work.odometry_jumped) {
    return bodies_.Forget();
  }
  HideMovingRobots(context_.teammate_radius_m, *work.T_odom_robot, bodies_, work.scan);
}

SessionCounts RobotSession::Note(const Work& work,
                                 const ContestedTracker::Tracked& tracked,
                                 std::chrono::nanoseconds matching) {
  const MappingStep& step = tracked.step;
  return intake_.NoteAnswer({.stamp = step.stamp,
                             .map_robot = step.map_robot,
                             .arrived = work.arrived,
                             .working = matching,
                             .is_dead_reckoned = step.status == StepStatus::kDeadReckoned,
                             .relevant = tracked.relevant.size(),
                             .has_odometry = work.T_odom_robot.has_value()});
}

}  // namespace qwsm::team
