// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Clouds that come over the wire: the same to the last bit, or refused.
#include "service/dds/wire/cloud_conversion.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "service/dds/wire/registration_report.hpp"
#include "service/dds/wire/spatial.hpp"

namespace qwsm::dds {
namespace {

using slam6d::PointCloud;

PointCloud Draw(int points) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> coordinate(-50.0, 50.0);
  PointCloud cloud;
  for (int i = 0; i < points; ++i) {
    const double x = coordinate(random);
    const double y = coordinate(random);
    cloud.push_back({x, y, coordinate(random)});
  }
  return cloud;
}

TEST(CloudConversion, GivesPointsBackToTheLastBit) {
  const PointCloud cloud = Draw(1000);
  const std::string frame = "laser";
  const CloudSample sample(cloud, CloudPrecision::kDouble, std::chrono::seconds(7), frame);
  ASSERT_EQ(ObjectionTo(sample.sample()), "");
  const team::CloudScan scan = FromWire(sample.sample());
  EXPECT_EQ(scan.stamp, std::chrono::seconds(7));
  ASSERT_EQ(scan.cloud.size(), cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) ASSERT_EQ(scan.cloud[i], cloud[i]);
}

TEST(CloudConversion, RoundsToSinglePrecisionWhereThatIsWanted) {
  const PointCloud cloud = Draw(100);
  const std::string frame = "laser";
  const CloudSample sample(cloud, CloudPrecision::kSingle, {}, frame);
  EXPECT_EQ(sample.sample().point_step, 12U);
  const team::CloudScan scan = FromWire(sample.sample());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    EXPECT_EQ(scan.cloud[i], cloud[i].cast<float>().cast<double>());
  }
}

/// A cloud of 2 x 3 points with an intensity before the coordinates and padding behind the rows.
class ForeignCloud {
 public:
  static constexpr std::uint32_t kStep = 20;
  static constexpr std::uint32_t kRow = 3 * kStep + 5;

  ForeignCloud() : bytes_(2 * kRow, 0xee) {
    for (int i = 0; i < 6; ++i) Set(i, {static_cast<float>(i), 1.0F, -1.0F});
    sample.header = {.stamp = {.sec = 1, .nanosec = 5}, .frame_id = frame_.data()};
    sample.height = 2;
    sample.width = 3;
    sample.point_step = kStep;
    sample.row_step = kRow;
    Point();
  }

  void Set(int i, const std::array<float, 3>& xyz) {
    std::memcpy(bytes_.data() + i / 3 * kRow + i % 3 * kStep + 4, xyz.data(), sizeof xyz);
  }
  void Resize(std::size_t size) {
    bytes_.resize(size);
    Point();
  }

  wire::PointCloud2 sample{};
  std::vector<sensor_msgs_msg_dds__PointField_> fields{
      {.name = names_[0].data(), .offset = 0, .datatype = 7, .count = 1},
      {.name = names_[3].data(), .offset = 12, .datatype = 7, .count = 1},
      {.name = names_[2].data(), .offset = 8, .datatype = 7, .count = 1},
      {.name = names_[1].data(), .offset = 4, .datatype = 7, .count = 1}};

 private:
  void Point() {
    const auto size = static_cast<std::uint32_t>(bytes_.size());
    const auto count = static_cast<std::uint32_t>(fields.size());
    sample.fields = {count, count, fields.data(), false};
    sample.data = {size, size, bytes_.data(), false};
  }

  static inline std::array<std::string, 4> names_{"intensity", "x", "y", "z"};
  std::string frame_ = "velodyne";
  std::vector<std::uint8_t> bytes_;
};

TEST(CloudConversion, ReadsLayoutsOfOthers) {
  ForeignCloud cloud;
  ASSERT_EQ(ObjectionTo(cloud.sample), "");
  const team::CloudScan scan = FromWire(cloud.sample);
  ASSERT_EQ(scan.cloud.size(), 6U);
  EXPECT_EQ(scan.cloud[4], Eigen::Vector3d(4.0, 1.0, -1.0));
}

TEST(CloudConversion, LeavesOutPointsThatAreNone) {
  ForeignCloud cloud;
  cloud.Set(1, {std::numeric_limits<float>::quiet_NaN(), 0.0F, 0.0F});
  cloud.Set(5, {0.0F, 0.0F, std::numeric_limits<float>::infinity()});
  ASSERT_EQ(ObjectionTo(cloud.sample), "");
  EXPECT_EQ(FromWire(cloud.sample).cloud.size(), 4U);
}

TEST(CloudConversion, ObjectsToCloudsOfNaNOnly) {
  ForeignCloud cloud;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (int i = 0; i < 6; ++i) cloud.Set(i, {nan, nan, nan});
  EXPECT_NE(team::ObjectionTo(FromWire(cloud.sample)), "");
}

TEST(CloudConversion, RefusesWhatDoesNotFitItself) {
  struct Case {
    const char* why;
    std::function<void(ForeignCloud&)> spoil;
  };
  const std::vector<Case> cases{
      {"stamp", [](ForeignCloud& c) { c.sample.header.stamp.nanosec = 1'000'000'000; }},
      {"frame_id is empty", [](ForeignCloud& c) { c.sample.header.frame_id[0] = '\0'; }},
      {"no fields", [](ForeignCloud& c) { c.fields[3].name = c.fields[0].name; }},
      {"no fields", [](ForeignCloud& c) { c.sample.fields._length = 0; }},
      {"not FLOAT32", [](ForeignCloud& c) { c.fields[1].datatype = 5; }},
      {"not FLOAT32", [](ForeignCloud& c) { c.fields[1].datatype = 255; }},
      {"more than one element", [](ForeignCloud& c) { c.fields[2].count = 1'000'000; }},
      {"beyond point_step", [](ForeignCloud& c) { c.fields[2].offset = 17; }},
      {"beyond point_step", [](ForeignCloud& c) { c.fields[2].offset = 0xfffffffe; }},
      {"beyond point_step",
       [](ForeignCloud& c) {
         c.fields[1] = {c.fields[1].name, 16, 8, 1};
       }},
      {"no points", [](ForeignCloud& c) { c.sample.width = 0; }},
      {"20 million", [](ForeignCloud& c) { c.sample.width = c.sample.height = 0xffffffff; }},
      {"beyond point_step", [](ForeignCloud& c) { c.sample.point_step = 0; }},
      {"row_step", [](ForeignCloud& c) { c.sample.point_step = 0x80000000; }},
      {"row_step", [](ForeignCloud& c) { c.sample.row_step = 59; }},
      {"not as long", [](ForeignCloud& c) { c.sample.height = 3; }},
      {"not as long", [](ForeignCloud& c) { c.Resize(2 * ForeignCloud::kRow - 1); }},
      {"not as long", [](ForeignCloud& c) { c.Resize(0); }},
      {"big-endian", [](ForeignCloud& c) { c.sample.is_bigendian = true; }},
  };
  for (std::size_t i = 0; i < cases.size(); ++i) {
    ForeignCloud cloud;
    cases[i].spoil(cloud);
    EXPECT_NE(ObjectionTo(cloud.sample).find(cases[i].why), std::string::npos)
        << "case " << i << ": " << ObjectionTo(cloud.sample);
  }
}

TEST(Spatial, GivesPosesThatWereSentOnceBackToTheLastBit) {
  std::mt19937 random(4);
  std::normal_distribution<double> any;
  for (int i = 0; i < 10'000; ++i) {
    const wire::Pose sent{{any(random), any(random), any(random)},
                          {any(random), any(random), any(random), any(random)}};
    const slam6d::Pose3 pose = SpatialPose(sent);
    const slam6d::Pose3 again = SpatialPose(ToWire(pose));
    ASSERT_EQ(again.rotation, pose.rotation);
    ASSERT_EQ(again.translation_m, pose.translation_m);
  }
}

TEST(RegistrationReport, ComesBackAsItWas) {
  RegistrationReport report{.robot = "robot1",
                            .stamp = std::chrono::milliseconds(1234),
                            .map_robot = {},
                            .status = slam6d::SlamStatus::kMatched,
                            .reason = "converged",
                            .points = 5,
                            .loops_to = {3, 7}};
  report.map_robot.covariance(0, 5) = 0.25;
  const std::optional<RegistrationReport> back = FromWire(ToWire(report, "map"));
  ASSERT_TRUE(back);
  EXPECT_EQ(back->robot, "robot1");
  EXPECT_EQ(back->stamp, report.stamp);
  EXPECT_EQ(back->loops_to, report.loops_to);
  EXPECT_EQ(back->map_robot.covariance, report.map_robot.covariance);
  wire::RegistrationReport broken = ToWire(report, "map");
  broken.status = 200;
  EXPECT_FALSE(FromWire(broken));
}

}  // namespace
}  // namespace qwsm::dds
