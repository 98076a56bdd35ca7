// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What a session does with stamps, odometry and scans before it matches.
#include <gtest/gtest.h>

#include <limits>
#include <numbers>
#include <random>

#include "service/team/session/latency_histogram.hpp"
#include "service/team/session/odometry_buffer.hpp"
#include "service/team/session/scan_queue.hpp"
#include "service/team/session/stamp_guard.hpp"

namespace qwsm::team {
namespace {

using std::chrono::hours;
using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::minutes;
using std::chrono::seconds;

/// This machine's time, in a test.
std::chrono::nanoseconds HalfPastTen() { return hours(10) + minutes(30); }

TEST(StampGuard, TellsDuplicatesAndOvertakenMessagesApart) {
  StampGuard guard;
  EXPECT_EQ(guard.Judge(milliseconds(100)), StampVerdict::kInOrder);
  EXPECT_EQ(guard.Judge(milliseconds(200)), StampVerdict::kInOrder);
  EXPECT_EQ(guard.Judge(milliseconds(200)), StampVerdict::kDuplicate);
  EXPECT_EQ(guard.Judge(milliseconds(150)), StampVerdict::kLate);
  EXPECT_EQ(guard.Judge(milliseconds(150)), StampVerdict::kDuplicate);
  EXPECT_EQ(guard.Judge(milliseconds(100)), StampVerdict::kDuplicate);
  EXPECT_EQ(guard.Judge(milliseconds(300)), StampVerdict::kInOrder);
}

TEST(StampGuard, NeverTakesShortDelaysForAClockThatWasSetBack) {
  StampGuard guard;
  guard.Judge(milliseconds(1000));
  for (int i = 100; i < 1000; ++i) EXPECT_EQ(guard.Judge(milliseconds(i)), StampVerdict::kLate);
}

TEST(StampGuard, FollowsAClockThatWasSetBack) {
  StampGuard guard;
  guard.Judge(hours(10));
  EXPECT_EQ(guard.Judge(hours(9)), StampVerdict::kWrongTime);
  EXPECT_EQ(guard.Judge(hours(9) + milliseconds(100)), StampVerdict::kWrongTime);
  EXPECT_EQ(guard.Judge(hours(9) + milliseconds(200)), StampVerdict::kClockReset);
  EXPECT_EQ(guard.Judge(hours(9) + milliseconds(300)), StampVerdict::kInOrder);
}

TEST(StampGuard, RefusesOneStampFromTheFutureAndGoesOn) {
  StampGuard guard(HalfPastTen);
  guard.Judge(seconds(1));
  EXPECT_EQ(guard.Judge(hours(100'000)), StampVerdict::kWrongTime);
  EXPECT_EQ(guard.Judge(milliseconds(1100)), StampVerdict::kInOrder);
  EXPECT_EQ(guard.Judge(hours(100'000) + seconds(1)), StampVerdict::kWrongTime);
  EXPECT_EQ(guard.Judge(milliseconds(1200)), StampVerdict::kInOrder);
}

TEST(StampGuard, TakesAPauseInALogForNoFuture) {
  StampGuard guard(HalfPastTen);
  guard.Judge(seconds(1));
  EXPECT_EQ(guard.Judge(hours(3)), StampVerdict::kInOrder);
  EXPECT_EQ(guard.Judge(hours(3) + milliseconds(100)), StampVerdict::kInOrder);
  EXPECT_EQ(guard.Judge(hours(11)), StampVerdict::kInOrder);  // Clocks differ.
  EXPECT_EQ(guard.Judge(hours(12) + milliseconds(100)), StampVerdict::kWrongTime);
}

TEST(StampGuard, FollowsAClockThatWasSetForward) {
  StampGuard guard(HalfPastTen);
  guard.Judge(seconds(1));
  EXPECT_EQ(guard.Judge(hours(100'000)), StampVerdict::kWrongTime);
  EXPECT_EQ(guard.Judge(hours(100'000) + milliseconds(100)), StampVerdict::kWrongTime);
  EXPECT_EQ(guard.Judge(hours(100'000) + milliseconds(200)), StampVerdict::kClockReset);
  EXPECT_EQ(guard.Judge(hours(100'000) + milliseconds(300)), StampVerdict::kInOrder);
}

TEST(StampGuard, IsNotFooledByOldMessagesWithoutOrder) {
  StampGuard guard;
  guard.Judge(hours(10));
  for (int i = 0; i < 20; ++i) {
    EXPECT_EQ(guard.Judge(hours(9) - seconds(i)), StampVerdict::kWrongTime);
  }
}

TEST(OdometryBuffer, GivesReadingsBackExactlyAndInterpolatesBetweenThem) {
  OdometryBuffer buffer;
  const Pose2 first{0.1, 0.2, 3.0};
  const Pose2 second{0.3, 0.4, -3.0};
  EXPECT_TRUE(buffer.Add(milliseconds(100), first));
  EXPECT_TRUE(buffer.Add(milliseconds(200), second));
  EXPECT_EQ(buffer.At(milliseconds(100)), first);
  EXPECT_EQ(buffer.At(milliseconds(200)), second);
  const Pose2 between = *buffer.At(milliseconds(150));
  EXPECT_NEAR(between.x_m, 0.2, 1e-12);
  EXPECT_NEAR(between.y_m, 0.3, 1e-12);
  EXPECT_NEAR(std::abs(between.theta_rad), std::numbers::pi, 1e-12);  // Across the cut.
}

TEST(OdometryBuffer, InterpolatesASmoothDriveClosely) {
  const auto pose_at = [](microseconds time) {
    const double s = std::chrono::duration<double>(time).count();
    return Pose2{2.0 * std::cos(s), 2.0 * std::sin(s), NormalizeAngle(s)};
  };
  OdometryBuffer buffer;
  for (int i = 0; i < 1000; ++i) buffer.Add(milliseconds(20 * i), pose_at(milliseconds(20 * i)));
  std::mt19937 random(3);
  std::uniform_int_distribution<int> any_us(0, 19'980'000);
  for (int i = 0; i < 1000; ++i) {
    const microseconds time(any_us(random));
    const Pose2 error = pose_at(time).Inverse() * *buffer.At(time);
    EXPECT_LT(error.translation_m().norm(), 2.0 * 0.02 * 0.02 / 8.0 * 1.01);  // a t^2 / 8.
    EXPECT_LT(std::abs(error.theta_rad), 1e-9);
  }
}

TEST(OdometryBuffer, CarriesMotionOnForAShortTimeOnly) {
  OdometryBuffer buffer;
  buffer.Add(milliseconds(0), {});
  buffer.Add(milliseconds(50), {0.05, 0.0, 0.0});
  EXPECT_FALSE(buffer.Covers(milliseconds(75)));
  EXPECT_NEAR(buffer.At(milliseconds(75))->x_m, 0.075, 1e-12);
  EXPECT_FALSE(buffer.At(milliseconds(200)).has_value());
}

TEST(OdometryBuffer, KnowsNothingBeforeItsFirstReadingOrInAGap) {
  OdometryBuffer buffer;
  EXPECT_FALSE(buffer.At(milliseconds(0)).has_value());
  buffer.Add(milliseconds(100), {});
  buffer.Add(milliseconds(1100), {1.0, 0.0, 0.0});
  EXPECT_FALSE(buffer.At(milliseconds(99)).has_value());
  EXPECT_FALSE(buffer.At(milliseconds(600)).has_value());
}

TEST(OdometryBuffer, SortsLateReadingsInAndRefusesKnownAndBrokenOnes) {
  OdometryBuffer buffer;
  EXPECT_TRUE(buffer.Add(milliseconds(0), {}));
  EXPECT_TRUE(buffer.Add(milliseconds(200), {0.2, 0.0, 0.0}));
  EXPECT_TRUE(buffer.Add(milliseconds(100), {0.5, 0.0, 0.0}));
  EXPECT_FALSE(buffer.Add(milliseconds(100), {9.0, 0.0, 0.0}));
  EXPECT_FALSE(buffer.Add(milliseconds(200), {9.0, 0.0, 0.0}));
  EXPECT_FALSE(buffer.Add(milliseconds(-5), {9.0, 0.0, 0.0}));
  EXPECT_FALSE(buffer.Add(milliseconds(300), {std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0}));
  EXPECT_EQ(buffer.At(milliseconds(100))->x_m, 0.5);
}

TEST(OdometryBuffer, BeginsAnewWhenTheClockIsSetBack) {
  OdometryBuffer buffer;
  buffer.Add(hours(10), {5.0, 0.0, 0.0});
  for (int i = 0; i < 5; ++i) buffer.Add(hours(9) + milliseconds(20 * i), {0.1 * i, 0.0, 0.0});
  EXPECT_NEAR(buffer.At(hours(9) + milliseconds(70))->x_m, 0.35, 1e-12);
  EXPECT_FALSE(buffer.Covers(hours(10)));
}

TEST(OdometryBuffer, IsBounded) {
  OdometryBuffer buffer;
  for (int i = 0; i < 5000; ++i) buffer.Add(milliseconds(10 * i), {});
  EXPECT_FALSE(buffer.At(milliseconds(10)).has_value());
  EXPECT_TRUE(buffer.At(milliseconds(49'000)).has_value());
}

TEST(ScanQueue, DropsTheOldestAndAccountsForEveryScan) {
  std::mt19937 random(4);
  ScanQueue<int> queue(3);
  int pushed = 0;
  int popped = 0;
  int last = -1;
  for (int i = 0; i < 10'000; ++i) {
    if (random() % 2 == 0 || queue.empty()) {
      queue.Push(pushed++);
    } else {
      const int scan = queue.Pop();
      EXPECT_GT(scan, last);
      last = scan;
      ++popped;
    }
    ASSERT_LE(queue.size(), 3U);
    ASSERT_EQ(static_cast<std::uint64_t>(pushed),
              static_cast<std::uint64_t>(popped) + queue.size() + queue.dropped());
  }
}

TEST(ScanQueue, HasRoomForThoseThatHadToWaitUntilTheyAreTaken) {
  ScanQueue<int> queue(2);
  for (int i = 0; i < 10; ++i) queue.Push(i, true);
  EXPECT_EQ(queue.size(), 10U);
  queue.Push(10);  // The newest wins, but the others stay.
  EXPECT_EQ(queue.dropped(), 1U);
  for (int i = 1; i < 10; ++i) EXPECT_EQ(queue.Pop(), i);
  for (int i = 11; i < 14; ++i) queue.Push(i);
  EXPECT_EQ(queue.size(), 2U);
  EXPECT_EQ(queue.dropped(), 3U);
}

TEST(LatencyHistogram, GivesQuantilesWithinFivePercent) {
  LatencyHistogram histogram;
  EXPECT_EQ(histogram.Quantile(0.5), std::chrono::nanoseconds(0));
  for (int i = 1; i <= 10'000; ++i) histogram.Add(microseconds(i));
  EXPECT_NEAR(static_cast<double>(histogram.Quantile(0.5).count()), 5e6, 0.25e6);
  EXPECT_NEAR(static_cast<double>(histogram.Quantile(0.99).count()), 9.9e6, 0.5e6);
  EXPECT_EQ(histogram.Quantile(1.0), microseconds(10'000));
  EXPECT_EQ(histogram.longest(), microseconds(10'000));
  EXPECT_EQ(histogram.count(), 10'000U);
}

}  // namespace
}  // namespace qwsm::team
