// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/team/map/team_corrector.hpp"

#include <functional>
#include <future>
#include <memory>
#include <utility>

#include "qwsm/mapping/motion_model.hpp"
#include "service/team/map/yielding.hpp"

namespace qwsm::team {
namespace {

std::function<void()> BeginOnAnotherThread(std::function<void()> work, bool yields) {
  auto done = std::make_shared<std::future<void>>(
      std::async(std::launch::async, [work = std::move(work), yields] {
        if (yields) YieldToOthers();
        work();
      }));
  return [done] { done->get(); };
}

}  // namespace

TeamCorrector::TeamCorrector(const MapperOptions& options)
    : noise_(options.motion), corrector_(options, [this](std::function<void()> look) {
        // Of one robot a look that is late is waited for, and must not wait for anybody itself.
        return BeginOnAnotherThread(std::move(look), chains_ > 1);
      }) {}

void TeamCorrector::Take(const TeamScan& scan) {
  const auto [known, is_first] = last_.try_emplace({scan.key.robot, scan.component});
  Last& last = known->second;
  const bool begins = is_first || scan.is_new_start;
  if (begins) last.chain = chains_++;
  ScanNode node{.scan = scan.scan,
                .map_robot = scan.map_robot,
                .odometry = {},
                .T_last_node = {},
                .robot = last.chain};
  if (!begins) {
    const ScanMotion motion = scan.motion ? *scan.motion : MotionSince(last, scan);
    node.odometry = motion.odometry;
    node.T_last_node = motion.T_last_this;
  } else if (scan.motion) {
    node.odometry = scan.motion->odometry;
  }
  last.node = nodes_++;
  last.map_robot = scan.map_robot;
  last.T_odom_robot = scan.T_odom_robot;
  corrector_.Add(std::move(node));
}

// What is known of scans out of the journal, and of other services' scans.
ScanMotion TeamCorrector::MotionSince(const Last& last, const TeamScan& scan) const {
  const Pose2 T_last_this = last.map_robot.T_a_b.Inverse() * scan.map_robot.T_a_b;
  MotionModel model(noise_);
  model.Remember(T_last_this, last.T_odom_robot);
  return {.odometry = model.Predict(scan.T_odom_robot).adapted, .T_last_this = T_last_this};
}

std::optional<CorrectedMap> TeamCorrector::LookIfDue() {
  if (!corrector_.IsLookDue()) return std::nullopt;
  std::optional<CorrectedMap> corrected = corrector_.LookAgain();
  if (corrected) Follow(corrected->map_node);
  return corrected;
}

void TeamCorrector::Adopt(std::span<const UncertainPose2> map_node) {
  corrector_.Adopt(map_node);
  Follow(map_node);
}

void TeamCorrector::Follow(std::span<const UncertainPose2> map_node) {
  for (auto& [robot, last] : last_) last.map_robot = map_node[last.node];
}

}  // namespace qwsm::team
