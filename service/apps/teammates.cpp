// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/apps/teammates.hpp"

#include <utility>

#include "service/team/map/moving_robots.hpp"
#include "service/team/service/team_options.hpp"

namespace qwsm::apps {

pipeline::Answer WithoutTeammates(pipeline::Answer answer) {
  return [answer = std::move(answer),
          bodies = MovingBodies(),
          radius_m = team::TeamOptions().teammate_radius_m](Observation observation) mutable {
    if (observation.T_odom_robot) {
      team::HideMovingRobots(radius_m, *observation.T_odom_robot, bodies, observation.scan);
    } else {
      bodies.Forget();
    }
    return answer(observation);
  };
}

}  // namespace qwsm::apps
