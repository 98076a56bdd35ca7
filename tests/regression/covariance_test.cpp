// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Simulated drives: the covariances have to predict the errors that are made. NEES of three numbers
// is 3 when they do; asked for is 2 to 4.5. The errors of one drive go together, so that the two
// drives of a test tell the mean to a factor of two.
// `evaluate_covariance` prints the figures.
#include <gtest/gtest.h>

#include <string>

#include "tests/support/consistency.hpp"

namespace qwsm::test {
namespace {

constexpr double kLowest = 2.0 / 2.0;
constexpr double kHighest = 4.5 * 1.25;

TEST(Covariance, PredictsTheErrorsInRoomsAndCorridors) {
  for (const ConsistencyScenario& scenario : ConsistencyScenarios()) {
    if (scenario.name == "park") continue;  // One trunk in view: too few drives to tell.
    SCOPED_TRACE(scenario.name);
    const ConsistencyResult result = EvaluateConsistency(scenario, ConsistencyTask::kMap, {}, 2);
    EXPECT_EQ(result.without_covariance, 0);
    EXPECT_GT(result.nees.mean, kLowest);
    EXPECT_LT(result.nees.mean, kHighest);
  }
}

TEST(Covariance, IsLargeAlongACorridorWithoutEnds) {
  for (const ConsistencyScenario& scenario : ConsistencyScenarios()) {
    if (scenario.name != "corridor without") continue;
    const ConsistencyResult result = EvaluateConsistency(scenario, ConsistencyTask::kMap, {}, 1);
    EXPECT_GT(result.along_m.sigma, 2.0 * result.across_m.sigma);
    return;
  }
  FAIL() << "there is no such scenario";
}

}  // namespace
}  // namespace qwsm::test
