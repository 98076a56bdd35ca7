// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/team/service/epoch_intake.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <future>
#include <string>
#include <vector>

namespace qwsm::team {
namespace {

TeamEpoch EpochBy(const std::string& service, std::uint64_t number) {
  return {.rank = {.number = number, .service = service}, .stamp = {}, .scans = {}};
}

/// An intake whose first correction takes until somebody lets it end.
class EpochIntakeTest : public ::testing::Test {
 protected:
  void PutFirst() {
    intake_.Put(EpochBy("a", 1));
    begun_.get_future().wait();
  }

  std::promise<void> begun_;
  std::promise<void> may_end_;
  std::vector<std::string> taken_;
  EpochIntake intake_{[this](const TeamEpoch& epoch) {
    taken_.push_back(epoch.rank.service + std::to_string(epoch.rank.number));
    if (taken_.size() > 1) return;
    begun_.set_value();
    may_end_.get_future().wait();
  }};
};

TEST_F(EpochIntakeTest, WhoBringsCorrectionsDoesNotWaitForThem) {
  PutFirst();
  intake_.Put(EpochBy("a", 2));
  intake_.Put(EpochBy("b", 2));
  intake_.Put(EpochBy("a", 3));  // Names all that 2 does.
  intake_.Put(EpochBy("c", 1));
  EXPECT_EQ(taken_, std::vector<std::string>{"a1"});
  may_end_.set_value();
  intake_.WaitUntilIdle();
  EXPECT_EQ(taken_, (std::vector<std::string>{"a1", "b2", "a3", "c1"}));
}

TEST_F(EpochIntakeTest, LeavesOutWhatWaitsWhenItStops) {
  PutFirst();
  intake_.Put(EpochBy("b", 2));
  const auto stopped = std::async(std::launch::async, [this] { intake_.Stop(); });
  may_end_.set_value();
  stopped.wait();
  intake_.WaitUntilIdle();
  EXPECT_EQ(taken_.front(), "a1");
  EXPECT_LE(taken_.size(), 2U);
}

}  // namespace
}  // namespace qwsm::team
