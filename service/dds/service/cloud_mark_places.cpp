// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/dds/service/cloud_mark_places.hpp"

#include <string>
#include <vector>

namespace qwsm::dds {

void CloudMarkPlaces::TakeMap(const team::CloudMap& map) {
  std::vector<team::ScanPlace> places;
  for (const team::CloudMap::Stop& stop : map.path) {
    const Eigen::Vector3d& p_map_m = stop.T_map_robot.translation_m;
    const double yaw_rad = slam6d::RollPitchYaw(stop.T_map_robot.rotation).z();
    places.push_back({.robot = std::string(map.robot),
                      .stamp = stop.stamp,
                      .T_map_robot = {p_map_m.x(), p_map_m.y(), yaw_rad}});
  }
  marks_.Place(places);
}

}  // namespace qwsm::dds
