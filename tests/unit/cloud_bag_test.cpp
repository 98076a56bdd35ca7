// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/clouds/cloud_bag.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <functional>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "service/pipeline/slam6d/scan_series.hpp"
#include "tests/support/bag_maker.hpp"
#include "tests/support/temporary_folder.hpp"

namespace slam6d::io {
namespace {

using namespace std::chrono_literals;
using qwsm::Timestamp;
using qwsm::io::Transform3;
using qwsm::test::CloudForm;
using qwsm::test::MadeMessage;
using qwsm::test::Ros;

using Points = std::vector<std::array<double, 3>>;

const Points kPoints_m{{1.0, 2.0, 3.0}, {-4.0, 0.5, 0.25}, {5.0, 6.0, -7.0}, {0.0, 0.0, 8.0}};
/// Tilted by 90 degrees about y: it looks down.
const Transform3 kMounting{
    .x_m = 0.5,
    .y_m = 0.0,
    .z_m = 1.0,
    .rotation = {0.0, std::numbers::sqrt2 / 2, 0.0, std::numbers::sqrt2 / 2}};

Timestamp At(int cloud) { return 1000s + cloud * 100ms; }

/// Clouds of a robot that drives forward 10 cm between them.
std::vector<MadeMessage> Drive(Ros ros, const CloudForm& form = {}) {
  std::vector<MadeMessage> drive;
  for (int i = 0; i < 4; ++i) {
    drive.push_back(
        qwsm::test::OdometryMessageOf(ros, "/odom", At(i), "base", {0.1 * i, 0.0, 0.0}));
    drive.push_back(qwsm::test::CloudMessage(ros, "/points", At(i), "velodyne", kPoints_m, form));
  }
  drive.push_back(
      qwsm::test::TransformMessageOf(ros, "/tf_static", 0s, "base", "velodyne", kMounting));
  return drive;
}

class CloudsOfABag : public testing::Test {
 protected:
  CloudBag Open(const std::string& bytes, const CloudBagOptions& options = {}) {
    qwsm::test::WriteBytes(path_, bytes);
    return CloudBag(path_, options, [this](const std::string& what) { told_ += what + "\n"; });
  }
  CloudBag OpenMcap(const std::vector<MadeMessage>& messages, const CloudBagOptions& options = {}) {
    return Open(qwsm::test::McapOf(messages, "zstd"), options);
  }
  std::string FailureOf(const std::function<void()>& action) {
    try {
      action();
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }

  static void ExpectDrive(CloudBag&& bag) {
    ASSERT_EQ(bag.size(), 4U);
    for (int i = 0; i < 4; ++i) {
      const CloudBag::Cloud cloud = bag.Read(static_cast<std::size_t>(i));
      EXPECT_EQ(cloud.stamp, At(i));
      ASSERT_EQ(cloud.points.size(), kPoints_m.size());
      EXPECT_EQ(cloud.points[1], Eigen::Vector3d(-4.0, 0.5, 0.25));
      ASSERT_TRUE(cloud.T_odom_sensor);
      // A point ahead of the sensor is below the robot.
      const Eigen::Vector3d ahead_m = *cloud.T_odom_sensor * Eigen::Vector3d(2.0, 0.0, 0.0);
      EXPECT_TRUE(ahead_m.isApprox(Eigen::Vector3d(0.1 * i + 0.5, 0.0, -1.0), 1e-12)) << ahead_m;
    }
  }

  qwsm::test::TemporaryFolder folder_;
  std::filesystem::path path_ = folder_.path() / "bag";
  std::string told_;
};

TEST_F(CloudsOfABag, AreReadWhateverTheContainerAndTheLayout) {
  for (const CloudForm& form : {CloudForm{},
                                CloudForm{.is_double = true},
                                CloudForm{.is_big_endian = true},
                                CloudForm{.is_double = true, .is_big_endian = true, .rows = 2}}) {
    for (const char* compression : {"none", "bz2", "lz4"}) {
      ExpectDrive(Open(qwsm::test::Ros1BagOf(Drive(Ros::k1, form), compression)));
    }
    for (const char* compression : {"", "zstd", "lz4"}) {
      ExpectDrive(Open(qwsm::test::McapOf(Drive(Ros::k2, form), compression)));
    }
    std::filesystem::remove(path_);
    qwsm::test::WriteDb3(path_, Drive(Ros::k2, form), 3, true);
    ExpectDrive(CloudBag(path_, {}, [](const std::string&) {}));
  }
}

TEST_F(CloudsOfABag, ComeInTheOrderOfTheirStamps) {
  std::vector<MadeMessage> drive = Drive(Ros::k2);
  std::ranges::reverse(drive);
  ExpectDrive(OpenMcap(drive));
}

TEST_F(CloudsOfABag, HaveTheirPoseFromTfAloneBetweenTwoMoments) {
  std::vector<MadeMessage> drive;
  for (int i = 0; i < 3; ++i) {
    const Transform3 moved{.x_m = 0.0, .y_m = 0.2 * i, .z_m = 0.1 * i, .rotation = {}};
    drive.push_back(
        qwsm::test::TransformMessageOf(Ros::k2, "/tf", At(i) - 50ms, "odom", "base", moved));
    drive.push_back(qwsm::test::CloudMessage(Ros::k2, "/points", At(i), "base", kPoints_m));
  }
  CloudBag bag = OpenMcap(drive);
  ASSERT_TRUE(bag.Read(1).T_odom_sensor);
  EXPECT_TRUE(bag.Read(1).T_odom_sensor->translation_m.isApprox(Eigen::Vector3d(0, 0.3, 0.15)));
}

TEST_F(CloudsOfABag, WithoutOdometryAreToldToStartWhereTheMotionLeads) {
  CloudBag bag = OpenMcap({qwsm::test::CloudMessage(Ros::k2, "/points", At(0), "base", kPoints_m)});
  EXPECT_FALSE(bag.Read(0).T_odom_sensor);
  EXPECT_NE(told_.find("neither odometry nor /tf"), std::string::npos) << told_;
}

TEST_F(CloudsOfABag, LackTheBeamsWithoutAnEcho) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Points points_m{{1, 2, 3}, {nan, nan, nan}};
  CloudBag bag = OpenMcap({qwsm::test::CloudMessage(Ros::k2, "/p", At(0), "base", points_m)});
  EXPECT_EQ(bag.Read(0).points.size(), 1U);
}

TEST_F(CloudsOfABag, AreThoseOfTheTopicThatIsAskedFor) {
  std::vector<MadeMessage> team = Drive(Ros::k2);
  for (const MadeMessage& message : Drive(Ros::k2)) {
    if (message.topic == "/tf_static") continue;
    team.push_back(message);
    team.back().topic = "/robot2" + message.topic;
  }
  team.push_back(qwsm::test::CloudMessage(Ros::k2, "/points", At(9), "velodyne", kPoints_m));
  EXPECT_EQ(OpenMcap(team).size(), 5U);
  EXPECT_NE(told_.find("/points is read; choose with --points"), std::string::npos) << told_;
  CloudBag bag = OpenMcap(team, {.points = "robot2/points", .odometry = {}, .every = 2});
  EXPECT_EQ(bag.size(), 2U);
  EXPECT_NE(told_.find("odometry is taken from /robot2/odom"), std::string::npos) << told_;
  EXPECT_NE(FailureOf([&] { OpenMcap(team, {.points = "/camera", .odometry = {}}); })
                .find("no clouds (sensor_msgs/PointCloud2) on '/camera'; it has them on /points, "
                      "/robot2/points"),
            std::string::npos);
}

TEST_F(CloudsOfABag, AreNoneInABagOfOtherThings) {
  const std::string failure = FailureOf([this] {
    OpenMcap({qwsm::test::ScanMessage(Ros::k2, "/scan", At(0), "laser", {1.0F, 2.0F})});
  });
  EXPECT_NE(failure.find(path_.string() + ": has no clouds"), std::string::npos) << failure;
}

/// Where in the bytes of a cloud of ROS 2 its `width` stands.
constexpr std::size_t kWidth = 4 + 8 + 4 + 12 + 4;

TEST_F(CloudsOfABag, OfBillionsOfEmptyRowsTakeNoTime) {
  const MadeMessage empty = qwsm::test::CloudMessage(Ros::k2, "/points", At(0), "velodyne", {});
  MadeMessage rows = empty;
  rows.bytes.replace(kWidth - 4, 8, "\xFF\xFF\xFF\xFF\0\0\0\0", 8);
  const auto ticks_of = [this](const MadeMessage& cloud) {
    const std::clock_t begin = std::clock();
    EXPECT_TRUE(OpenMcap({cloud}).Read(0).points.empty());
    return std::clock() - begin;
  };
  const std::clock_t usual = ticks_of(empty);
  EXPECT_LT(ticks_of(rows), 100 * usual);
}

TEST_F(CloudsOfABag, ThatAreDamagedAreLeftOutAndTold) {
  std::vector<MadeMessage> drive = Drive(Ros::k2);
  drive[3].bytes[kWidth + 2] = '\x7F';  // Absurdly many points.
  drive[5].bytes.resize(drive[5].bytes.size() - 40);
  qwsm::test::WriteBytes(path_, qwsm::test::McapOf(drive, ""));
  const auto places =
      pipeline::FindScans({path_}, {}, [this](const std::string& what) { told_ += what + "\n"; });
  ASSERT_EQ(places.size(), 4U);
  pipeline::ScanSeries series(places, {}, {});
  EXPECT_EQ(series.Next()->cloud.size(), 4U);
  for (int i = 0; i < 2; ++i) {
    const auto damaged = series.Next();
    EXPECT_TRUE(damaged->cloud.empty());
    ASSERT_FALSE(damaged->problems.empty());
    EXPECT_NE(damaged->problems[0].find("(/points): "), std::string::npos) << damaged->problems[0];
  }
  const auto last = series.Next();
  EXPECT_EQ(last->cloud.size(), 4U);
  EXPECT_EQ(last->stamp, At(3));
}

}  // namespace
}  // namespace slam6d::io
