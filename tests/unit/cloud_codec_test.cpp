// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/clouds/cloud_codec.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "service/io/files/binary.hpp"

namespace slam6d::io {
namespace {

JournaledCloud Scan() {
  JournaledCloud scan;
  scan.cloud.push_back({1.0 / 3.0, -2.0e-7, 12345.678901234567});
  scan.cloud.push_back({0.0, -0.0, 1e-300});
  scan.T_odom_sensor = {.rotation = RotationFromRollPitchYaw({0.1, 0.2, 0.3}),
                        .translation_m = {1.0, 2.0, 1.0 / 7.0}};
  scan.T_odom_robot = scan.T_odom_sensor.Inverse();
  return scan;
}

TEST(CloudCodec, GivesScansBackToTheLastBit) {
  const JournaledCloud scan = Scan();
  const JournaledCloud decoded = DecodeCloud(EncodeCloud(scan));
  ASSERT_EQ(decoded.cloud.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(decoded.cloud[i], scan.cloud[i]);
  EXPECT_EQ(decoded.T_odom_sensor.rotation, scan.T_odom_sensor.rotation);
  EXPECT_EQ(decoded.T_odom_sensor.translation_m, scan.T_odom_sensor.translation_m);
  ASSERT_TRUE(decoded.T_odom_robot.has_value());
  EXPECT_EQ(decoded.T_odom_robot->rotation, scan.T_odom_robot->rotation);
  EXPECT_FALSE(decoded.T_slam_odom.has_value());
}

TEST(CloudCodec, RefusesScansCutOffAnywhere) {
  const std::string bytes = EncodeCloud(Scan());
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_THROW(DecodeCloud(bytes.substr(0, size)), qwsm::io::BinaryError) << size;
  }
  EXPECT_THROW(DecodeCloud(bytes + "x"), qwsm::io::BinaryError);
}

TEST(CloudCodec, RefusesPosesThatAreNone) {
  JournaledCloud scan = Scan();
  scan.T_robot_sensor.translation_m.x() = std::numeric_limits<double>::infinity();
  EXPECT_THROW(DecodeCloud(EncodeCloud(scan)), qwsm::io::BinaryError);
}

}  // namespace
}  // namespace slam6d::io
