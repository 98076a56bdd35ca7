// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <set>
#include <string>

#include "qwsm/logs/log_reader.hpp"
#include "qwsm/metrics/relations.hpp"
#include "service/io/logs/evaluation_odometry.hpp"
#include "service/io/trajectories/relations_file.hpp"
#include "tests/support/log_text.hpp"

namespace qwsm::io {
namespace {

std::filesystem::path DataFile(const std::string& name) {
  return std::filesystem::path(QWSM_DATA_DIR) / "radish" / name;
}

/// What is known of a log: counts and bearings from its description, "no echo" from looking at it;
/// the error of its raw odometry was computed by another program.
struct KnownLog {
  const char* file;
  std::size_t scans;
  std::size_t odometry_readings;
  std::size_t beams;
  double step_deg;
  float range_max_m;
  const char* relations = nullptr;
  double odometry_error_m = 0.0;
};

class RadishLog : public testing::TestWithParam<KnownLog> {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(DataFile(GetParam().file))) {
      GTEST_SKIP() << DataFile(GetParam().file) << " is not here";
    }
  }
};

TEST_P(RadishLog, IsReadToTheLastScan) {
  const KnownLog& known = GetParam();
  LogOptions strict;
  strict.strict = true;
  const test::LogContent log = test::ReadAll(*OpenLog(DataFile(known.file), strict));
  EXPECT_EQ(log.scans.size(), known.scans);
  EXPECT_EQ(log.odometry.size(), known.odometry_readings);
  EXPECT_EQ(log.report.compression, "gzip");
  EXPECT_TRUE(log.report.unknown_messages.empty());
  for (const ScanReading& reading : log.scans) {
    ASSERT_EQ(reading.scan.size(), known.beams);
    ASSERT_FLOAT_EQ(reading.scan.geometry.range_max_m, known.range_max_m);
    ASSERT_NEAR(RadiansToDegrees(static_cast<double>(reading.scan.geometry.bearing_step_rad)),
                known.step_deg,
                1e-3);
    ASSERT_TRUE(reading.T_odom_robot.has_value());
  }
}

TEST_P(RadishLog, GivesTheKnownErrorOfItsOdometry) {
  const KnownLog& known = GetParam();
  if (known.relations == nullptr) GTEST_SKIP() << "no relations for this log";
  Trajectory odometry;
  for (const ScanReading& reading : test::ReadAll(*OpenLog(DataFile(known.file))).scans) {
    odometry.push_back({reading.scan.stamp, *reading.T_odom_robot});
  }
  const auto relations = ReadRelationsFile(DataFile(known.relations));
  const Trajectory dense = CarryToOdometry(*OpenLog(DataFile(known.file)), odometry);
  const RelationsResult result = EvaluateRelations(relations, dense);
  EXPECT_EQ(result.skipped, 0U);
  EXPECT_NEAR(result.all.translation_m.mean, known.odometry_error_m, 1e-4);
}

INSTANTIATE_TEST_SUITE_P(
    All,
    RadishLog,
    testing::Values(
        KnownLog{"intel.raw-odom.clf.gz", 3461, 13631, 180, 1.0, 81.83F, "intel.relations", 7.3714},
        KnownLog{"mit-csail.raw-odom.clf.gz",
                 406,
                 1988,
                 361,
                 0.5,
                 81.91F,
                 "mit-csail.gmapping.relations",
                 2.0090},
        KnownLog{"edmonton.raw-odom.clf.gz",
                 340,
                 6011,
                 180,
                 1.0,
                 51.16F,
                 "edmonton.gmapping.relations",
                 0.1372},
        KnownLog{
            "aces.raw-odom.clf.gz", 440, 7374, 180, 1.0, 50.0F, "aces.gmapping.relations", 0.9251},
        KnownLog{"belgioioso.raw-odom.clf.gz",
                 395,
                 4047,
                 361,
                 0.5,
                 81.91F,
                 "belgioioso.gmapping.relations",
                 0.0996},
        KnownLog{"coreslam-exp1.clf.gz", 756, 756, 682, 0.35242, 4.0F},
        KnownLog{"dpslam-loop5.log.gz", 551, 551, 181, 1.0, 8.191001F}),
    [](const testing::TestParamInfo<KnownLog>& known) {
      const std::string file = known.param.file;
      std::string name = file.substr(0, file.find('.'));
      std::erase(name, '-');
      return name;
    });

}  // namespace
}  // namespace qwsm::io
