// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// kill -9 within a correction of the map gives the map before it or after it, never a mixture.
#include <gtest/gtest.h>

#include <filesystem>
#include <random>
#include <vector>

#include "service/team/service/team_service.hpp"
#include "tests/support/bent_drive.hpp"
#include "tests/support/child_process.hpp"
#include "tests/support/recording_sink.hpp"
#include "tests/support/temporary_folder.hpp"

namespace qwsm::team {
namespace {

constexpr int kKillsOfCorrection = 30;
constexpr std::uint64_t kCorrected = 1'000'000;  // No scan has that number.

TeamServiceOptions Options() {
  TeamServiceOptions options;
  options.team.map_period_s = 0.0;
  return options;
}

std::vector<TeamScan> BentScans() {
  std::vector<TeamScan> scans;
  for (const MappingStep& step : test::BentOfficeLoop().steps) {
    TeamScan& scan = scans.emplace_back();
    scan.key = {.service = "elsewhere-1", .robot = "robot1", .sequence = scans.size()};
    scan.scan = step.relevant_scan;
    scan.map_robot = step.map_robot;
  }
  return scans;
}

/// Tells when a correction is safe.
class EpochTeller final : public TeamSink {
 public:
  explicit EpochTeller(test::ChildProcess::Tell tell) : tell_(std::move(tell)) {}
  void TakeEpoch(const TeamEpoch&) override { tell_(kCorrected); }

 private:
  test::ChildProcess::Tell tell_;
};

class EpochCrash : public ::testing::Test {
 protected:
  void SetUp() override {
    test::RecordingSink sink;
    TeamService service(Options(), sink);
    service.Start();
    for (const TeamScan& scan : scans_) service.TakeIn({scan});
    ASSERT_EQ(sink.epochs().size(), 1U);
    epoch_ = sink.epochs().front();
  }

  /// Takes in all scans, and is killed after so many of them, or a little later.
  /// @return whether a correction was told to be safe.
  bool RunUntilKilled(const std::filesystem::path& journal, std::size_t scans, std::size_t spins) {
    test::ChildProcess child([&](const test::ChildProcess::Tell& tell) {
      EpochTeller sink(tell);
      TeamService service(Options(), sink, journal);
      service.Start();
      for (std::size_t i = 0; i < scans_.size(); ++i) {
        service.TakeIn({scans_[i]});
        tell(i + 1);
      }
      service.WaitUntilIdle();
    });
    bool was_told = false;
    while (const std::optional<std::uint64_t> told = child.Hear()) {
      was_told = was_told || *told == kCorrected;
      if (*told == scans) break;
    }
    for (std::size_t spin = spins; spin > 0; --spin) asm volatile("");
    child.Kill();
    while (const auto told = child.Hear()) was_told = was_told || *told == kCorrected;
    return was_told;
  }

  const std::vector<TeamScan> scans_ = BentScans();
  TeamEpoch epoch_;
};

TEST_F(EpochCrash, MapIsAsBeforeOrAsAfter) {
  std::mt19937 random(7);
  int corrected = 0;
  int uncorrected = 0;
  for (int kill = 0; kill < kKillsOfCorrection; ++kill) {
    SCOPED_TRACE(kill);
    const test::TemporaryFolder folder;
    // Half of the time within the correction, or just behind it.
    const std::size_t scans =
        kill % 2 == 0 ? epoch_.scans.size() - kill / 2 % 2 : 1 + random() % scans_.size();
    const bool was_told = RunUntilKilled(folder.path() / "team.db", scans, random() % 20'000'000);
    test::RecordingSink sink;
    TeamService service(Options(), sink, folder.path() / "team.db");
    const TeamMap::State::View contents = service.MapOf("")->Read();
    const auto restored =
        contents->map.scans().first(std::min(contents->map.scans().size(), epoch_.scans.size()));
    const bool is_corrected =
        !restored.empty() &&
        restored.back().map_robot.T_a_b == epoch_.scans[restored.size() - 1].map_robot.T_a_b;
    EXPECT_TRUE(is_corrected || !was_told);
    for (const RelevantScan& scan : restored) {
      EXPECT_EQ(
          scan.map_robot.T_a_b,
          is_corrected ? epoch_.scans[scan.id].map_robot.T_a_b : scans_[scan.id].map_robot.T_a_b);
    }
    ++(is_corrected ? corrected : uncorrected);
  }
  EXPECT_GT(corrected, 0);
  EXPECT_GT(uncorrected, 0);
}

}  // namespace
}  // namespace qwsm::team
