// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What goes over the wire and comes back: the same to the last bit, or refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "qwsm/sensor/scan_limits.hpp"
#include "service/dds/wire/diagnostics.hpp"
#include "service/dds/wire/epoch_conversion.hpp"
#include "service/dds/wire/planar.hpp"
#include "service/dds/wire/robot_names.hpp"
#include "service/dds/wire/scan_conversion.hpp"
#include "service/dds/wire/static_transforms.hpp"

namespace qwsm::dds {
namespace {

using std::numbers::pi;

TEST(Planar, GivesHeadingsBackToTheLastBit) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any(-pi, pi);
  for (int i = 0; i < 20'000; ++i) {
    const double theta_rad = any(random);
    ASSERT_EQ(YawOf(QuaternionOf(theta_rad)), theta_rad) << "case " << i;
  }
  for (const double theta_rad : {0.0, 1e-300, -1e-9, 1e-5, pi, -3.14159, 0.5 * pi}) {
    EXPECT_EQ(YawOf(QuaternionOf(theta_rad)), theta_rad);
  }
}

TEST(Planar, ReadsYawOfTiltedRotations) {
  // Yaw 0.5 after a roll of 0.3: q = q_z * q_x.
  const double z = std::sin(0.25);
  const double w = std::cos(0.25);
  const double s = std::sin(0.15);
  const double c = std::cos(0.15);
  const wire::Quaternion tilted{w * s, z * s, z * c, w * c};
  EXPECT_NEAR(YawOf(tilted), 0.5, 1e-12);
  EXPECT_NEAR(UprightnessOf(tilted), std::cos(0.3), 1e-12);
}

TEST(Planar, GivesStampsBack) {
  for (const std::int64_t ns :
       {0LL, 1LL, 999'999'999LL, 1'000'000'000LL, -1LL, 1'700'000'000'123'456'789LL}) {
    EXPECT_EQ(FromWire(ToWire(Timestamp(ns))), Timestamp(ns));
  }
  EXPECT_FALSE(FromWire(wire::Time{.sec = 1, .nanosec = 1'000'000'000}));
}

TEST(RobotNames, FindRobotsByTheirTopics) {
  EXPECT_EQ(RobotNames::RobotOf("rt/robot1/scan", "scan"), "robot1");
  EXPECT_EQ(RobotNames::RobotOf("rt/team/robot1/scan", "scan"), "team/robot1");
  EXPECT_EQ(RobotNames::RobotOf("rt/scan", "scan"), "");
  EXPECT_FALSE(RobotNames::RobotOf("rt/robot1/rescan", "scan"));
  EXPECT_FALSE(RobotNames::RobotOf("scan", "scan"));
  EXPECT_FALSE(RobotNames::RobotOf("rt/../../etc/scan", "scan"));
  EXPECT_FALSE(RobotNames::RobotOf("rt//etc/scan", "scan"));
  EXPECT_EQ(RobotNames("/robot1/").Topic("scan"), "/robot1/scan");
  EXPECT_EQ(RobotNames("").Topic("scan"), "/scan");
  EXPECT_EQ(RobotNames("robot1").Frame("odom"), "robot1/odom");
}

/// Takes a message with one transform. @param source of it.
void Take(StaticTransforms& transforms,
          std::string parent,
          std::string child,
          const wire::Vector3& origin,
          const wire::Quaternion& turn,
          const Guid& source = {}) {
  wire::TransformStamped transform{};
  transform.header = HeaderOf({}, parent);
  transform.child_frame_id = Borrow(child);
  transform.transform = {origin, turn};
  wire::TFMessage message{};
  message.transforms = {._maximum = 1, ._length = 1, ._buffer = &transform, ._release = false};
  transforms.Take(message, source);
}

TEST(StaticTransforms, FollowFramesAskWhoKnowsThemAndRefuseCircles) {
  StaticTransforms transforms;
  Guid source{};
  const auto add = [&](const char* parent, const char* child, const Pose2& pose) {
    Take(
        transforms, parent, child, {pose.x_m, pose.y_m, 0.0}, QuaternionOf(pose.theta_rad), source);
  };
  add("base_link", "mast", {1.0, 0.0, pi / 2});
  add("mast", "laser", {0.5, 0.0, 0.0});
  const auto found = transforms.Find("base_link", "laser");
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->x_m, 1.0, 1e-12);
  EXPECT_NEAR(found->y_m, 0.5, 1e-12);
  EXPECT_EQ(transforms.Find("base_link", "base_link"), Pose2{});
  EXPECT_FALSE(transforms.Find("base_link", "camera"));
  EXPECT_FALSE(transforms.has_rivals());
  const Guid own = source;
  source.front() = 1;
  add("mast", "laser", {9.0, 0.0, 0.0});
  EXPECT_TRUE(transforms.has_rivals());
  EXPECT_NEAR(transforms.Find("base_link", "laser")->y_m, 9.0, 1e-12);
  EXPECT_NEAR(transforms.Find("base_link", "laser", {own})->y_m, 0.5, 1e-12);
  add("b", "a", {});
  add("a", "b", {});
  EXPECT_FALSE(transforms.Find("base_link", "a"));
}

// A laser that hangs from a mast, which stands on a robot above the floor.
TEST(StaticTransforms, TellHowHighAFrameIs) {
  StaticTransforms transforms;
  const auto add = [&](const char* parent,
                       const char* child,
                       const wire::Vector3& origin,
                       const wire::Quaternion& turn) {
    Take(transforms, parent, child, origin, turn);
  };
  add("base_footprint", "base_link", {0.0, 0.0, 0.125}, {0.0, 0.0, 0.0, 1.0});
  add("base_link", "mast", {0.0, 0.0, 0.5}, {1.0, 0.0, 0.0, 0.0});
  add("mast", "laser", {0.1, 0.0, 0.25}, {0.0, 0.0, 0.0, 1.0});
  EXPECT_NEAR(transforms.FindHeight_m("base_footprint", "laser").value(), 0.375, 1e-12);
  EXPECT_NEAR(transforms.FindHeight_m("base_link", "laser").value(), 0.25, 1e-12);
  EXPECT_FALSE(transforms.FindHeight_m("base_footprint", "camera"));
}

// A laser that hangs upside down below a mast, one that looks down, and one that two tilts level.
TEST(StaticTransforms, PlaceLasersThatAreUpsideDownAndNoneThatIsTilted) {
  StaticTransforms transforms;
  const auto add = [&](const char* parent,
                       const char* child,
                       const wire::Vector3& origin,
                       const wire::Quaternion& turn) {
    Take(transforms, parent, child, origin, turn);
  };
  const double half = std::sqrt(0.5);
  add("base_link", "mast", {1.0, 0.0, 0.5}, {0.0, 0.0, half, half});
  add("mast", "below", {0.0, 0.0, -0.1}, {1.0, 0.0, 0.0, 0.0});
  add("below", "laser", {0.0, 0.5, 0.0}, {0.0, 0.0, 0.0, 1.0});
  const std::optional<Pose2> below = transforms.Find("base_link", "laser");
  ASSERT_TRUE(below);
  EXPECT_NEAR(below->x_m, 1.5, 1e-12);
  EXPECT_NEAR(below->y_m, 0.0, 1e-12);
  EXPECT_NEAR(below->theta_rad, pi / 2, 1e-12);
  add("base_link", "tilted", {0.2, 0.0, 0.0}, {0.0, std::sin(0.1), 0.0, std::cos(0.1)});
  EXPECT_FALSE(transforms.Find("base_link", "tilted"));
  add("tilted", "level", {0.0, 0.0, 0.0}, {0.0, -std::sin(0.1), 0.0, std::cos(0.1)});
  EXPECT_NEAR(transforms.Find("base_link", "level").value().x_m, 0.2, 1e-12);
}

TEST(Health, OfARobotThatIsThereAndSilentIsNotGood) {
  team::TeamStatus status;
  status.robots.resize(1);
  team::RobotStatus& robot = status.robots.front();
  robot.state = team::RobotState::kTracked;
  robot.silence = std::chrono::seconds(2);
  EXPECT_EQ(HealthOf(status, {}).back().level, HealthLevel::kOk);
  EXPECT_EQ(HealthOf(status, {}).back().message, "tracked");
  robot.silence = std::chrono::seconds(42);
  EXPECT_EQ(HealthOf(status, {}).back().level, HealthLevel::kWarning);
  EXPECT_EQ(HealthOf(status, {}).back().message, "tracked, silent");
  const std::vector<Health> health = HealthOf(status, {});
  EXPECT_NE(std::ranges::find(health.back().values,
                              std::pair<std::string, std::string>("silent_s", "42")),
            health.back().values.end());
  robot.state = team::RobotState::kLost;
  EXPECT_EQ(HealthOf(status, {}).back().level, HealthLevel::kStale);
}

class WireScan : public ::testing::Test {
 protected:
  static LaserScan Scan() {
    return {.stamp = Timestamp(1'234'567'890'123'456'789),
            .geometry = {.first_bearing_rad = -1.5F,
                         .bearing_step_rad = 0.1F,
                         .range_min_m = 0.02F,
                         .range_max_m = 30.0F,
                         .T_robot_laser = {0.1, -0.2, 0.3}},
            .ranges_m = {1.0F, std::numeric_limits<float>::infinity(), 0.0F, std::nanf("")}};
  }

  std::string frame_ = "laser";
};

TEST_F(WireScan, ComesBackAsItWas) {
  const LaserScan scan = Scan();
  const wire::LaserScan sample = ToWire(scan, frame_);
  ASSERT_TRUE(ObjectionTo(sample).empty());
  const LaserScan back = FromWire(sample, scan.geometry.T_robot_laser);
  EXPECT_EQ(back.stamp, scan.stamp);
  EXPECT_EQ(back.geometry, scan.geometry);
  ASSERT_EQ(back.size(), scan.size());
  EXPECT_EQ(back.ranges_m[1], scan.ranges_m[1]);
  EXPECT_TRUE(std::isnan(back.ranges_m[3]));
}

TEST_F(WireScan, OfARangeWithoutLimitReachesAsFarAsAny) {
  wire::LaserScan sample = ToWire(Scan(), frame_);
  sample.range_max = std::numeric_limits<float>::infinity();
  EXPECT_EQ(qwsm::ObjectionTo(FromWire(sample, {})), "");
  sample.range_max = std::nanf("");
  EXPECT_NE(qwsm::ObjectionTo(FromWire(sample, {})), "");
}

TEST_F(WireScan, TellsHowLongItTook) {
  LaserScan scan = Scan();
  EXPECT_EQ(ToWire(scan, frame_).time_increment, 0.0F);
  scan.sweep = std::chrono::milliseconds(30);
  wire::LaserScan sample = ToWire(scan, frame_);
  EXPECT_EQ(sample.time_increment, 0.01F);
  EXPECT_NEAR(Seconds(FromWire(sample, {}).sweep), 0.03, 1e-8);
  for (const float nonsense : {-0.01F, 0.5F, std::nanf(""), 1e30F}) {
    sample.time_increment = nonsense;
    EXPECT_EQ(FromWire(sample, {}).sweep.count(), 0);
  }
}

TEST_F(WireScan, IsRefusedWhereItMakesNoSense) {
  const LaserScan scan = Scan();
  wire::LaserScan sample = ToWire(scan, frame_);
  sample.header.stamp.nanosec = 2'000'000'000;
  EXPECT_EQ(ObjectionTo(sample), "its stamp is no time");
  sample = ToWire(scan, frame_);
  std::string none;
  sample.header.frame_id = Borrow(none);
  EXPECT_EQ(ObjectionTo(sample), "its frame_id is empty");
  sample = ToWire(scan, frame_);
  sample.ranges._length = 4'000'000'000U;
  EXPECT_EQ(ObjectionTo(sample), "it has more than 100000 ranges");
  sample.ranges._length = 0;
  EXPECT_EQ(ObjectionTo(sample), "it has no ranges");
}

TEST_F(WireScan, RelevantOneComesBackWithItsPlace) {
  team::TeamScan scan;
  scan.key = {.service = "qwsm-1", .robot = "robot1", .sequence = 7};
  scan.scan = Scan();
  scan.map_robot.T_a_b = {3.0, 4.0, -2.5};
  scan.T_odom_robot = Pose2{1.0, 2.0, 0.5};
  scan.map_robot.covariance << 3, 1, 0, 1, 2, 0, 0, 0, 1;
  const std::string map = "map";
  const wire::RelevantScan sample = ToWire(scan, map);
  ASSERT_TRUE(ObjectionTo(sample).empty());
  const team::TeamScan back = FromWire(sample);
  EXPECT_EQ(back.key, scan.key);
  EXPECT_EQ(back.map_robot.T_a_b, scan.map_robot.T_a_b);
  EXPECT_EQ(back.map_robot.covariance, scan.map_robot.covariance);
  EXPECT_EQ(back.T_odom_robot, scan.T_odom_robot);
  EXPECT_EQ(back.scan.geometry, scan.scan.geometry);
}

// A component's name becomes that of a topic.
TEST_F(WireScan, RelevantOneIsRefusedWhereANameInItIsNoNamespace) {
  team::TeamScan scan;
  scan.key = {.service = "qwsm-1", .robot = "robot1", .sequence = 7};
  scan.scan = Scan();
  const std::string good = "map_robot_2";
  const std::string evil = "map_robot-2";
  EXPECT_EQ(ObjectionTo(ToWire(scan, good)), "");
  EXPECT_EQ(ObjectionTo(ToWire(scan, evil)), "its frame_id is no map's");
  scan.key.robot = "robot 1";
  EXPECT_EQ(ObjectionTo(ToWire(scan, good)), "its robot's name is no namespace");
}

TEST(WireEpoch, IsRefusedWhereItNamesWhatCannotBe) {
  team::TeamEpoch epoch{.rank = {.number = 1, .service = "qwsm-1"}, .stamp = {}, .scans = {}};
  epoch.scans.push_back({.key = {.service = "qwsm-1", .robot = "robot1", .sequence = 7}});
  const auto objection = [&epoch] { return ObjectionTo(EpochSample(epoch).sample()); };
  EXPECT_EQ(objection(), "");
  epoch.rank.number = std::numeric_limits<std::uint64_t>::max();
  EXPECT_EQ(objection(), "its number is higher than any count");
  epoch.rank.number = 1;
  epoch.scans.front().component = "robot-2";
  EXPECT_EQ(objection(), "a frame in it is no map's");
  epoch.scans.front() = {.key = {.service = "qwsm-1", .robot = "robot-1", .sequence = 7}};
  EXPECT_EQ(objection(), "a robot's name in it is no namespace");
}

}  // namespace
}  // namespace qwsm::dds
