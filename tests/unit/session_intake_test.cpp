// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What becomes of a robot's scans before one is matched.
#include "service/team/session/session_intake.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "tests/support/room_drive.hpp"

namespace qwsm::team {
namespace {

using namespace std::chrono_literals;

class SessionIntakeTest : public ::testing::Test {
 protected:
  static SessionOptions Options() {
    SessionOptions options;
    options.queue_scans = 3;
    return options;
  }
  void GiveScans(int count) {
    for (int scan = 0; scan < count; ++scan) {
      EXPECT_TRUE(intake_.Enqueue(test::ObservationInRoom(scan).scan));
    }
  }

  std::vector<std::string> told_;
  SessionIntake<Planar> intake_{
      RobotEvents("robot1", [this](const TeamEvent& event) { told_.emplace_back(event.text); }),
      Options()};
};

TEST_F(SessionIntakeTest, TellsOnceOfEachKindOfScanThatIsRefused) {
  const LaserScan good = test::ObservationInRoom(1).scan;
  EXPECT_TRUE(intake_.Enqueue(good));
  LaserScan endless = test::ObservationInRoom(2).scan;
  endless.geometry.range_max_m = 2000.0F;
  for (int i = 0; i < 3; ++i) {
    EXPECT_FALSE(intake_.Enqueue(endless));
    EXPECT_FALSE(intake_.Enqueue(good));
  }
  for (const char* why :
       {"the scan's range maximum is above 1 km", "their stamp is that of an earlier one"}) {
    EXPECT_EQ(std::ranges::count(told_,
                                 std::string("scans are refused: ") + why +
                                     "; whoever publishes them has to mend that"),
              1)
        << why;
  }
}

TEST_F(SessionIntakeTest, TellsSinceWhenNoneHasCome) {
  EXPECT_EQ(intake_.Status().silence, 0s);
  GiveScans(1);
  std::this_thread::sleep_for(2ms);
  EXPECT_GE(intake_.Status().silence, 2ms);
}

TEST_F(SessionIntakeTest, DropsTheOldestScansWhereMoreComeThanCanBeMatched) {
  GiveScans(10);
  EXPECT_EQ(intake_.Status().counts.dropped, 7U);
}

TEST_F(SessionIntakeTest, DropsNoScansThatWaitForOdometry) {
  intake_.ExpectOdometry(true);
  GiveScans(10);
  EXPECT_EQ(intake_.Status().counts.dropped, 0U);
  EXPECT_EQ(intake_.Status().waiting, 10U);
}

TEST_F(SessionIntakeTest, DropsNoScansThatHadToWaitElsewhere) {
  intake_.ExpectWaited(10);
  GiveScans(10);
  EXPECT_EQ(intake_.Status().counts.dropped, 0U);
}

/// A robot whose odometry is not of the time of its scans.
class OdometryApart : public SessionIntakeTest {
 protected:
  void GiveOdometry(int scan, Timestamp ahead_by) {
    const Observation observation = test::ObservationInRoom(scan);
    intake_.TakeOdometry(observation.scan.stamp + ahead_by, *observation.T_odom_robot);
  }
  /// Gives a scan and takes what can be worked on.
  std::optional<SessionIntake<Planar>::Work> Drive(int scan) {
    EXPECT_TRUE(intake_.Enqueue(test::ObservationInRoom(scan).scan));
    return intake_.Take();
  }
  std::ptrdiff_t ToldOf(const std::string& text) const {
    return std::ranges::count_if(
        told_, [&](const std::string& told) { return told.find(text) != std::string::npos; });
  }
};

TEST_F(OdometryApart, ScansThatAreOlderThanAllOfItAreTakenAfterTheFirst) {
  int scan = 0;
  std::optional<SessionIntake<Planar>::Work> work;
  for (; !work && scan < 4000; ++scan) {
    GiveOdometry(scan, 1h);
    work = Drive(scan);
    std::this_thread::sleep_for(1ms);
  }
  ASSERT_TRUE(work);
  EXPECT_GT(intake_.Status().counts.unplaced, 0U) << "the first one's may have been missed";
  EXPECT_FALSE(work->T_odom_robot);
  EXPECT_EQ(ToldOf("without odometry"), 0);
  for (int i = 0; i < 20; ++i) EXPECT_TRUE(Drive(scan++));
  EXPECT_EQ(ToldOf("s before the oldest that is kept; whoever publishes both"), 1);
}

TEST_F(OdometryApart, ScansThatAreNewerThanAllOfItAreToldOf) {
  for (int scan = 0; scan < 20; ++scan) {
    GiveOdometry(scan, -600s);
    const std::optional<SessionIntake<Planar>::Work> work = Drive(scan);
    ASSERT_TRUE(work);
    EXPECT_FALSE(work->lacks_odometry) << "there never was any";
  }
  EXPECT_EQ(ToldOf("they are stamped 600.0 s after the newest of it"), 1);
}

TEST_F(OdometryApart, AGapInItIsNoEndOfIt) {
  for (int scan = 0; scan < 20; ++scan) {
    const bool is_gap = scan >= 5 && scan < 10;
    if (!is_gap) GiveOdometry(scan, 0s);
    const std::optional<SessionIntake<Planar>::Work> work = Drive(scan);
    ASSERT_TRUE(work);
    EXPECT_EQ(work->lacks_odometry, !work->T_odom_robot);
    EXPECT_EQ(work->lacks_odometry, scan > 5 && scan < 10) << "carried on for a moment";
  }
  EXPECT_EQ(ToldOf("without odometry"), 0);
  intake_.ExpectOdometry(false);
  for (int scan = 21; scan < 25; ++scan) EXPECT_FALSE(Drive(scan).value().lacks_odometry);
}

class GyroApart : public OdometryApart, public ::testing::WithParamInterface<int> {};

TEST_P(GyroApart, IsToldOf) {
  intake_.ExpectImu(true);
  for (int scan = 0; scan < 20; ++scan) {
    const LaserScan seen = test::ObservationInRoom(scan).scan;
    for (const Timestamp ahead_by : {-50ms, 0ms, 50ms}) {
      intake_.TakeImu({.stamp = seen.stamp + ahead_by + GetParam() * 1s});
    }
    EXPECT_EQ(Drive(scan).value().gyro_rad.has_value(), GetParam() == 0);
  }
  EXPECT_EQ(ToldOf("without its gyro, whose readings are of another time"),
            GetParam() == 0 ? 0 : 1);
}

INSTANTIATE_TEST_SUITE_P(Clocks, GyroApart, ::testing::Values(0, -5, 5));

}  // namespace
}  // namespace qwsm::team
