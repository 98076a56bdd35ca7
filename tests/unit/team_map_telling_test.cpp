// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cstdint>
#include <stdexcept>

#include "service/team/service/team_service.hpp"
#include "tests/support/recording_sink.hpp"
#include "tests/support/team_in_room.hpp"

namespace qwsm::team {
namespace {

using test::Give;
using test::StatusOf;

/// Has no way to tell a map.
class MaplessSink final : public test::RecordingSink {
 public:
  void TakeMap(const MapPicture&) override { throw std::runtime_error("no topic for it"); }
};

TEST(TeamService, SaysThatAMapCannotBeToldAndGoesOn) {
  MaplessSink sink;
  TeamServiceOptions options = test::LosslessOptions();
  options.team.map_period_s = 0.01;
  TeamService service(options, sink);
  service.Start();
  for (int scan = 0; !sink.HasEvent("service: map: the map cannot be told: no topic for it");
       ++scan) {
    ASSERT_LT(scan, 10'000);
    Give(service, "robot1", scan, 1);
    service.WaitUntilIdle();
  }
  const std::uint64_t answered = StatusOf(service, "robot1").counts.answered;
  Give(service, "robot2", 0, 1);
  service.WaitUntilIdle();
  EXPECT_GT(answered, 0U);
  EXPECT_EQ(StatusOf(service, "robot2").counts.answered, 1U);
}

}  // namespace
}  // namespace qwsm::team
