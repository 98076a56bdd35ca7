// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <numbers>
#include <string>

#include "qwsm/mapping/mapper.hpp"
#include "qwsm/mapping/occupancy_grid.hpp"
#include "service/config/describe.hpp"
#include "service/dds/entities/network_options.hpp"
#include "service/team/service/team_options.hpp"
#include "service/view/view_options.hpp"

namespace qwsm::options {

/// Options for reading logs. What a log states, or lets infer, needs no option: 0 leaves it at
/// that.
struct LogOptions {
  bool strict = false;
  double range_max_m = 0.0;
  double field_of_view_rad = 0.0;
  bool mirrored = false;
  double sweep_s = -1.0;
  double laser_height_m = 0.0;
  double stamp_offset_s = 0.0;
  std::string scan;
  std::string odometry;
  std::string robot;
};

template <class Visitor>
void Describe(Visitor& visit, LogOptions& o) {
  visit("strict", o.strict, {.help = "stop at a malformed line instead of skipping it"});
  visit("range_max_m",
        o.range_max_m,
        {.help = "range of the laser; 0: as the log says or shows", .min = 0, .max = 1000});
  visit("field_of_view_rad",
        o.field_of_view_rad,
        {.help = "of the laser; 0: as the log says or its beams suggest",
         .min = 0,
         .max = 2.0 * std::numbers::pi});
  visit("mirrored",
        o.mirrored,
        {.help = "the laser is upside down, or counts its beams from the other side"});
  visit("sweep_s",
        o.sweep_s,
        {.help = "of a bag: time from first to last beam, as the robot moves; -1: as messages say",
         .min = -1,
         .max = 1});
  visit("laser_height_m",
        o.laser_height_m,
        {.help = "of a bag: above the floor, which a robot that leans sees; 0: as /tf_static says",
         .min = 0,
         .max = 10});
  visit("stamp_offset_s",
        o.stamp_offset_s,
        {.help = "of a bag: what is added to the stamps of scans, to fit those of odometry",
         .min = -3600,
         .max = 3600});
  visit("scan", o.scan, {.help = "of a bag: topics of scans, with commas; empty: all lasers'"});
  visit(
      "odometry", o.odometry, {.help = "of a bag: topic of odometry, or /tf; empty: the robot's"});
  visit("robot", o.robot, {.help = "of a bag of several robots: the namespace of one"});
}

/// Options for correcting the map where loops are closed.
struct GraphOptions {
  bool enabled = true;
};

template <class Visitor>
void Describe(Visitor& visit, GraphOptions& o) {
  visit("enabled",
        o.enabled,
        {.help = "correct path and map once loops are closed; false: incremental, as the papers"});
}

/// All options of the program `qwsm`.
struct ProgramOptions {
  LogOptions log;
  MapperOptions mapper;
  GraphOptions graph;
  OccupancyGridOptions rendering;
  dds::NetworkOptions network;
  team::TeamOptions team;
  view::ViewOptions view;
};

template <class Visitor>
void Describe(Visitor& visit, ProgramOptions& o) {
  visit("log", o.log, {.help = "reading of logs"});
  visit("mapper", o.mapper, {.help = "matching scans and extending the map"});
  visit("graph", o.graph, {.help = "correcting the map where loops are closed"});
  visit("rendering", o.rendering, {.help = "the occupancy map that is drawn of the result"});
  visit("network", o.network, {.help = "DDS, by which robots and services talk"});
  visit("team", o.team, {.help = "the service for robots on the network"});
  visit("view", o.view, {.help = "the page of 'qwsm serve --view'"});
}

}  // namespace qwsm::options

namespace qwsm::config {

// Made once, in program_options.cpp: the compiler takes long over some hundred options.
extern template OptionGroup GroupOf(options::ProgramOptions& options);

}  // namespace qwsm::config
