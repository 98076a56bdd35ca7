// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Robots that are carried while they map: neither scans nor odometry know of the way.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "qwsm/correction/self_correcting_mapper.hpp"
#include "qwsm/metrics/relations.hpp"
#include "service/io/trajectories/relations_file.hpp"
#include "tests/support/carried.hpp"
#include "tests/support/recorded_log.hpp"

namespace qwsm::test {
namespace {

namespace fs = std::filesystem;

struct MappedLog {
  Trajectory trajectory;
  std::size_t losses = 0;
  bool is_lost = false;  ///< In the end.
};

MappedLog Mapped(const std::vector<Observation>& observations) {
  MappedLog mapped;
  SelfCorrectingMapper mapper;
  for (const Observation& observation : observations) mapper.Process(observation);
  mapped.losses = mapper.losses();
  mapped.is_lost = mapper.belief() != nullptr;
  const std::vector<UncertainPose2> map_robot = mapper.Correct().map_robot;
  for (std::size_t i = 0; i < observations.size(); ++i) {
    mapped.trajectory.push_back(
        {.stamp = observations[i].scan.stamp, .T_map_robot = map_robot[i].T_a_b});
  }
  return mapped;
}

double Error_m(const std::vector<Relation>& relations, const Trajectory& trajectory) {
  return EvaluateRelations(relations, trajectory).all.translation_m.mean;
}

void ExpectFoundAgain(const std::string& log, const std::string& relations, const LogGap& gap) {
  const fs::path data = fs::path(QWSM_DATA_DIR) / "radish";
  if (!fs::exists(data / log)) GTEST_SKIP() << "no " << log;
  const std::vector<Relation> truth = io::ReadRelationsFile(data / relations);
  const std::vector<Observation> unbroken = ObservationsOf(data / log);
  const MappedLog whole = Mapped(unbroken);
  EXPECT_EQ(whole.losses, 0U);
  const MappedLog carried = Mapped(Carried(unbroken, gap));
  EXPECT_EQ(carried.losses, 1U);
  EXPECT_FALSE(carried.is_lost);
  EXPECT_LT(Error_m(truth, carried.trajectory), 1.3 * Error_m(truth, whole.trajectory));
}

TEST(CarriedWhileMapping, IsFoundAgainInIntel) {
  ExpectFoundAgain("intel.full.clf.gz", "intel.full.relations", {.first = 3000, .scans = 2000});
}

TEST(CarriedWhileMapping, IsFoundAgainInMitCsail) {
  ExpectFoundAgain("mit-csail.full.clf.gz", "mit-csail.graph.relations", {.first = 824, .scans = 238});
}

}  // namespace
}  // namespace qwsm::test
