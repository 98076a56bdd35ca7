// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/run/interruption.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <cerrno>

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

TEST(Interruption, OnlyAPersonQuitsAndHasToAskTwice) {
  const Interruption interruption;
  raise(SIGTERM);
  EXPECT_TRUE(interruption.requested());
  raise(SIGTERM);  // `timeout` signals the program and its group.
  raise(SIGHUP);
  raise(SIGINT);  // So does a launcher: all of this is one request.
}

TEST(Interruption, ATerminalThatIsGoneEndsWhoWasNotStartedToOutliveIt) {
  {
    const Interruption interruption;
    raise(SIGHUP);
    EXPECT_TRUE(interruption.requested());
  }
  ASSERT_EQ(signal(SIGHUP, SIG_IGN), SIG_DFL);
  {
    const Interruption interruption;
    raise(SIGHUP);
    EXPECT_FALSE(interruption.requested());
  }
  EXPECT_EQ(signal(SIGHUP, SIG_DFL), SIG_IGN);
}

TEST(Interruption, WhoHasResultsToWriteOutlivesItsReaders) {
  {
    const Interruption writes;
    raise(SIGPIPE);
    EXPECT_FALSE(writes.requested());
  }
  const Interruption prints("", Interruption::WithoutReaders::kEnds);
  EXPECT_EQ(signal(SIGPIPE, SIG_DFL), SIG_DFL);
}

TEST(Interruption, LeavesTheErrorOfTheCallThatItCameInto) {
  const Interruption interruption("noted\n");
  const int standard_error = dup(STDERR_FILENO);
  close(STDERR_FILENO);
  errno = ENOSPC;
  raise(SIGINT);
  const int error_number = errno;
  dup2(standard_error, STDERR_FILENO);
  close(standard_error);
  EXPECT_EQ(error_number, ENOSPC);
}

}  // namespace
}  // namespace qwsm::pipeline
