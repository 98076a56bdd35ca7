// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "qwsm/sensor/laser_scan.hpp"
#include "service/dds/entities/wire_types.hpp"
#include "service/team/scans/team_scan.hpp"

/// Scans on the wire. What comes from there is never trusted: here is checked what only the wire
/// can get wrong, the rest where the service takes the scan (qwsm::ObjectionTo).
namespace qwsm::dds {

/// Makes a sample that points into the scan and the name of the frame: write it while both live.
wire::LaserScan ToWire(const LaserScan& scan, const std::string& frame);
/// Says why a sample must not be converted; empty if it may.
std::string_view ObjectionTo(const wire::LaserScan& sample);
/// The scan of a sample, with the laser's place on its robot.
/// @pre ObjectionTo(sample).empty()
LaserScan FromWire(const wire::LaserScan& sample, const Pose2& T_robot_laser);

wire::RelevantScan ToWire(const team::TeamScan& scan, const std::string& map_frame);
std::string_view ObjectionTo(const wire::RelevantScan& sample);
/// The relevant scan of a sample. @pre ObjectionTo(sample).empty()
team::TeamScan FromWire(const wire::RelevantScan& sample);

}  // namespace qwsm::dds
