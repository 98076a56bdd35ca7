// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Corrected trajectories of whole recorded logs against stored bounds, with the one configuration
// that everything comes with.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "tests/support/program.hpp"

namespace qwsm::test {
namespace {

namespace fs = std::filesystem;

struct Bound {
  std::string log;
  std::string relations;
  std::string max_translation_m;
  std::string max_rotation_deg;
};

class CorrectedLog : public ::testing::TestWithParam<Bound> {};

TEST_P(CorrectedLog, IsConsistentAsAWhole) {
  const Bound& bound = GetParam();
  const fs::path data = fs::path(QWSM_DATA_DIR) / "radish";
  const fs::path log = data / (bound.log + ".clf.gz");
  if (!fs::exists(log)) GTEST_SKIP() << "no " << log;
  const TemporaryFolder folder;
  const fs::path results = folder.path() / "results";
  const Outcome mapped = RunProgram({"map", log, "--output", results, "--quiet"});
  ASSERT_EQ(mapped.exit_code, 0) << mapped.errors;
  const Outcome evaluated = RunProgram({"eval",
                                        results,
                                        "--relations",
                                        data / bound.relations,
                                        "--log",
                                        log,
                                        "--max-relations",
                                        bound.max_translation_m,
                                        "--max-relations-rotation",
                                        bound.max_rotation_deg});
  EXPECT_EQ(evaluated.exit_code, 0) << evaluated.output << evaluated.errors;
}

INSTANTIATE_TEST_SUITE_P(
    Radish,
    CorrectedLog,
    ::testing::Values(
        Bound{"intel.full", "intel.full.relations", "0.0142", "0.225"},
        Bound{"aces.full", "aces.relations", "0.0362", "0.31"},
        Bound{"mit-csail.full", "mit-csail.graph.relations", "0.0297", "0.316"},
        Bound{"fhw.raw-odom", "fhw.gmapping.relations", "0.052", "0.70"},
        Bound{"belgioioso.raw-odom", "belgioioso.gmapping.relations", "0.0245", "0.312"}),
    [](const auto& test) { return test.param.log.substr(0, test.param.log.find_first_of(".-")); });

}  // namespace
}  // namespace qwsm::test
