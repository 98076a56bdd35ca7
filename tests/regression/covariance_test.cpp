// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Simulated drives: the covariances have to predict the errors that are made. NEES of three numbers
// is 3 when they do; asked for is 2 to 4.5. The errors of one drive go together, so that the two
// drives of a test tell the mean to a factor of two; those of single matches are independent.
// `evaluate_covariance` prints the figures.
#include <gtest/gtest.h>

#include <string>

#include "tests/support/consistency.hpp"

namespace qwsm::test {
namespace {

constexpr double kLowest = 2.0;
constexpr double kHighest = 4.5;

bool IsOfFewTrunks(const ConsistencyScenario& scenario) { return scenario.name == "park"; }

TEST(Covariance, PredictsTheErrorsInRoomsAndCorridors) {
  for (const ConsistencyScenario& scenario : ConsistencyScenarios()) {
    if (IsOfFewTrunks(scenario)) continue;  // Too few drives to tell.
    SCOPED_TRACE(scenario.name);
    const ConsistencyResult result = EvaluateConsistency(scenario, ConsistencyTask::kMap, {}, 2);
    EXPECT_EQ(result.without_covariance, 0);
    EXPECT_GT(result.nees.mean, kLowest / 2.0);
    EXPECT_LT(result.nees.mean, kHighest * 1.25);
  }
}

// A door that is paired wrongly must not pass for a hold along the corridor: of the drives there
// the fourth has one.
TEST(Covariance, PredictsTheErrorsOfSingleMatches) {
  for (const ConsistencyScenario& scenario : ConsistencyScenarios()) {
    if (IsOfFewTrunks(scenario)) continue;
    SCOPED_TRACE(scenario.name);
    const int drives = scenario.name == "corridor with ends" ? 4 : 1;
    const ConsistencyResult result =
        EvaluateConsistency(scenario, ConsistencyTask::kLocalize, {}, drives);
    EXPECT_EQ(result.without_covariance, 0);
    EXPECT_GT(result.nees.mean, kLowest);
    EXPECT_LT(result.nees.mean, kHighest * 0.8);
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
