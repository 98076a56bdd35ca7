// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "qwsm/mapping/observation.hpp"
#include "qwsm/mapping/scan_map.hpp"
#include "sim/scenario.hpp"

namespace qwsm::test {

/// A drive of which one half made a map, in which the other half is to be recognised.
struct HalvedRecording {
  std::vector<Observation> observations;
  std::vector<Pose2> T_map_robot;  ///< Where they were taken, as well as is known.
  std::vector<bool> is_of_map;     ///< Whether they are of the half that made the map.
  ScanMap map;

  /// The distance of each observation from the nearest scan that the map was made of.
  std::vector<double> DistancesToMap_m() const;
};

/// A recorded drive in twenty parts, which go to the two halves in turns. Its poses are those of
/// the whole drive once its loops are closed.
HalvedRecording HalvedLog(const std::filesystem::path& path);

/// A simulated drive, of which the first half makes the map. Its poses are the true ones.
HalvedRecording HalvedDrive(const sim::ScenarioOptions& scenario);

/// Makes the map one that another program hands over: free and occupied cells.
/// @throws std::invalid_argument if the map cannot be drawn.
void MakeForeign(HalvedRecording& recording, double cell_m);

/// A zigzag and a straight corridor, there and back.
sim::ScenarioOptions CorridorThereAndBack();
/// Eight rooms on a corridor and three people, gone through twice.
sim::ScenarioOptions OfficeTwice();
/// A kilometre and a half of legs of a corridor, each like the next but one, there and back.
sim::ScenarioOptions AlikeCorridors();

}  // namespace qwsm::test
