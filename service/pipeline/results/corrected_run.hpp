// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

#include "qwsm/correction/joint_correction.hpp"
#include "qwsm/correction/self_correcting_mapper.hpp"
#include "service/io/pictures/trajectory_picture.hpp"

namespace qwsm::pipeline {

/// What a map comes to.
struct MapFigures {
  PointQuadtreeStatistics points;
  std::size_t scans = 0;
};
MapFigures FiguresOf(const ScanMap& map);

/// What is left of a run once its map is corrected.
struct CorrectedRun {
  Correction correction;
  std::vector<RelevantScan> scans;  ///< At their corrected poses; MapOf() makes them searchable.
  MapFigures answered_in;           ///< Of the map that the last scans were matched to.
  std::vector<MapEpoch> epochs;     ///< The corrections while the robot drove.
};

/// Counts the loops that came to each end.
struct LoopCounts {
  std::size_t accepted = 0;
  std::size_t found = 0;
  std::size_t epochs = 0;  ///< How often the map was corrected by them while the robot drove.
};
LoopCounts CountLoops(const Correction& correction, std::size_t epochs);

/// The answers of a drive, to be corrected together with those of others.
std::vector<StampedAnswer> AnswersOf(std::span<const io::PathPose> path);

/// Corrects a run once more when it is over.
CorrectedRun CorrectAtTheEnd(SelfCorrectingMapper& mapper);

/// Writes loops.csv, a line per loop that was found, and the graph as graph.g2o and graph.toro.
/// @param scans that are the nodes. @throws io::WriteError.
void WriteLoops(const std::filesystem::path& folder,
                const Correction& correction,
                std::span<const RelevantScan> scans);

/// Writes epochs.csv, a line per relevant scan in each correction while the robot drove, where
/// there were any. @throws io::WriteError.
void WriteEpochs(const std::filesystem::path& folder, const CorrectedRun& run);

/// The loops of a correction as lines between the places that they join.
std::vector<io::LoopLine> LoopLines(const Correction& correction);

}  // namespace qwsm::pipeline
