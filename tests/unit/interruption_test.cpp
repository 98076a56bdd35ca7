// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/run/interruption.hpp"

#include <gtest/gtest.h>
#include <signal.h>

namespace qwsm::pipeline {
namespace {

TEST(Interruption, CtrlCIsNoted) {
  const Interruption interruption("noted\n");
  EXPECT_FALSE(interruption.requested());
  raise(SIGINT);
  EXPECT_TRUE(interruption.requested());
}

TEST(Interruption, OneWithinAnotherTakesTheCtrlCOfItsTime) {
  const Interruption run("the run\n");
  {
    const Interruption page("the page\n");
    raise(SIGINT);
    EXPECT_TRUE(page.requested());
  }
  EXPECT_FALSE(run.requested());
  raise(SIGINT);  // The first one for the run, which goes on.
  EXPECT_TRUE(run.requested());
}

TEST(Interruption, WhoeverIsToIgnoreCtrlCStillEndsWhenTold) {
  ASSERT_NE(signal(SIGINT, SIG_IGN), SIG_ERR);
  {
    const Interruption interruption;
    raise(SIGINT);
    EXPECT_FALSE(interruption.requested());
    raise(SIGTERM);
    EXPECT_TRUE(interruption.requested());
  }
  EXPECT_EQ(signal(SIGINT, SIG_DFL), SIG_IGN);
}

}  // namespace
}  // namespace qwsm::pipeline
