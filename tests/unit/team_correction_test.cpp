// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The map of a team is corrected while robots drive. What drifted comes from another service, whose
// scans are taken in as they are.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "service/io/maps/map_file.hpp"
#include "service/team/service/team_service.hpp"
#include "tests/support/bent_drive.hpp"
#include "tests/support/recording_sink.hpp"
#include "tests/support/temporary_folder.hpp"

namespace qwsm::team {
namespace {

/// A team's service, and what it has told when it is destroyed.
struct Listened {
  explicit Listened(const std::filesystem::path& journal = {})
      : service({.team = Options(), .mapper = {}, .rendering = {}}, sink, journal) {
    service.Start();
  }

  static TeamOptions Options() {
    TeamOptions options;
    options.map_period_s = 0.0;
    return options;
  }
  std::vector<UncertainPose2> Poses() {
    std::vector<UncertainPose2> poses;
    for (const RelevantScan& scan : service.MapOf("")->Read()->map.scans()) {
      poses.push_back(scan.map_robot);
    }
    return poses;
  }
  std::string Map() { return io::EncodeMap(service.MapOf("")->Read()->map); }

  test::RecordingSink sink;
  TeamService service;
};

std::vector<TeamScan> ScansOf(const test::Answers& answers) {
  std::vector<TeamScan> scans;
  for (const MappingStep& step : answers.steps) {
    TeamScan& scan = scans.emplace_back();
    scan.key = {.service = "elsewhere-1", .robot = "robot1", .sequence = scans.size()};
    scan.scan = step.relevant_scan;
    scan.map_robot = step.map_robot;
  }
  return scans;
}

void TakeIn(TeamService& service, const std::vector<TeamScan>& scans) {
  for (const TeamScan& scan : scans) service.TakeIn({scan});
  service.WaitUntilIdle();
}

void TakeIn(TeamService& service, const TeamEpoch& epoch) {
  service.TakeIn(epoch);
  service.WaitUntilIdle();
}

class TeamCorrection : public ::testing::Test {
 protected:
  const test::Answers answers_ = test::BentOfficeLoop();
  const std::vector<TeamScan> scans_ = ScansOf(answers_);
};

TEST_F(TeamCorrection, PutsScansWhereTheyBelongAndTellsAllOfThem) {
  Listened one;
  TakeIn(one.service, scans_);
  const std::vector<TeamEpoch> epochs = one.sink.epochs();
  ASSERT_FALSE(epochs.empty());
  const TeamEpoch& last = epochs.back();
  EXPECT_EQ(last.rank.service, one.service.identity());
  EXPECT_EQ(last.rank.number, epochs.size());
  const double before_m = test::WorstError_m(test::PathOf(answers_.steps), answers_.T_map_true);
  EXPECT_LT(test::WorstError_m(one.Poses(), answers_.T_map_true), 0.5 * before_m);
  for (std::size_t i = 0; i < last.scans.size(); ++i) {
    EXPECT_EQ(last.scans[i].key, scans_[i].key);
    EXPECT_EQ(last.scans[i].map_robot.T_a_b, one.Poses()[i].T_a_b);
  }
}

TEST_F(TeamCorrection, ComesBackFromTheJournalAsItWas) {
  test::TemporaryFolder folder;
  std::string before;
  {
    Listened one(folder.path() / "team.db");
    TakeIn(one.service, scans_);
    ASSERT_FALSE(one.sink.epochs().empty());
    before = one.Map();
  }
  Listened again(folder.path() / "team.db");
  EXPECT_EQ(again.Map(), before);
  EXPECT_EQ(again.sink.relevant().back().map_robot.T_a_b, again.Poses().back().T_a_b);
}

TEST_F(TeamCorrection, IsTheSameForAServiceThatOnlyHearsOfIt) {
  Listened finds;
  Listened hears;
  TakeIn(finds.service, scans_);
  ASSERT_FALSE(finds.sink.epochs().empty());
  // Too few at a time for a look of its own.
  std::vector<TeamScan> few(scans_.begin(), scans_.begin() + 7);
  hears.service.TakeIn(few);
  TakeIn(hears.service, finds.sink.epochs().back());
  EXPECT_EQ(hears.Poses().front().T_a_b, finds.Poses().front().T_a_b);
  ASSERT_EQ(hears.sink.epochs().size(), 1U);  // For those who come later.
  EXPECT_EQ(hears.sink.epochs().back().rank, finds.sink.epochs().back().rank);
  // What it names is put there when it comes.
  hears.service.TakeIn({scans_[7]});
  EXPECT_EQ(hears.Poses()[7].T_a_b, finds.Poses()[7].T_a_b);
}

TEST_F(TeamCorrection, IsToldAgainToThoseWhoWereAwayWhenItWasFound) {
  test::TemporaryFolder folder;
  // Too few at a time for a look of its own.
  const std::vector<TeamScan> few(scans_.begin(), scans_.begin() + 7);
  {
    Listened hears(folder.path() / "hears.db");
    hears.service.TakeIn(few);
  }
  EpochRank rank;
  Pose2 corrected;
  {
    Listened finds(folder.path() / "finds.db");
    TakeIn(finds.service, scans_);
    ASSERT_FALSE(finds.sink.epochs().empty());
    rank = finds.sink.epochs().back().rank;
    corrected = finds.Poses()[6].T_a_b;
  }
  Listened finds(folder.path() / "finds.db");
  Listened hears(folder.path() / "hears.db");
  EXPECT_TRUE(hears.sink.epochs().empty()) << "there was none";
  EXPECT_FALSE(hears.Poses()[6].T_a_b == corrected);
  ASSERT_EQ(finds.sink.epochs().size(), 1U);
  EXPECT_EQ(finds.sink.epochs().back().rank, rank);
  TakeIn(hears.service, finds.sink.epochs().back());
  EXPECT_EQ(hears.Poses()[6].T_a_b, corrected);
}

TEST_F(TeamCorrection, OfTwoThatWereFoundAtOnceTheGreaterCounts) {
  Listened one;
  one.service.TakeIn({scans_.begin(), scans_.begin() + 4});
  const auto told = [&](const std::string& service, double x_m) {
    const UncertainPose2 there{.T_a_b = {.x_m = x_m}};
    TeamEpoch epoch;
    epoch.rank = {.number = 1, .service = service};
    epoch.scans = {{.key = scans_[0].key, .T_map_robot_before = {}, .map_robot = there}};
    return epoch;
  };
  TakeIn(one.service, told("b", 2.0));
  EXPECT_EQ(one.Poses()[0].T_a_b.x_m, 2.0);
  TakeIn(one.service, told("a", 1.0));
  EXPECT_EQ(one.Poses()[0].T_a_b.x_m, 2.0);
}

// Scans that another service does not know of keep their place beside those that it does, and it
// is told of them.
TEST_F(TeamCorrection, TakesScansAlongThatNobodyNamed) {
  Listened one;
  one.service.TakeIn({scans_.begin(), scans_.begin() + 4});
  const UncertainPose2 moved = UncertainPose2{.T_a_b = {.x_m = 5.0}} * scans_[1].map_robot;
  TeamEpoch epoch;
  epoch.rank = {.number = 3, .service = "elsewhere-1"};
  epoch.scans = {{.key = scans_[1].key, .T_map_robot_before = {}, .map_robot = moved}};
  TakeIn(one.service, epoch);
  EXPECT_EQ(one.Poses()[0].T_a_b, scans_[0].map_robot.T_a_b);
  EXPECT_NEAR(one.Poses()[3].T_a_b.x_m, scans_[3].map_robot.T_a_b.x_m + 5.0, 1e-9);
  ASSERT_EQ(one.sink.epochs().size(), 1U);
  EXPECT_EQ(one.sink.epochs().back().rank.number, 4U);
  EXPECT_EQ(one.sink.epochs().back().rank.service, one.service.identity());
}

}  // namespace
}  // namespace qwsm::team
