// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What becomes of a robot's scans before one is matched.
#include "service/team/session/session_intake.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/support/room_drive.hpp"

namespace qwsm::team {
namespace {

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

}  // namespace
}  // namespace qwsm::team
