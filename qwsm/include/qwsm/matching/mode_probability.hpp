// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "qwsm/matching/match_result.hpp"
#include "qwsm/search/likelihood_pyramid.hpp"
#include "qwsm/sensor/scan_points.hpp"

namespace qwsm {

/// How probable it is that a match ended at the right one of all poses that its prediction allows.
///
/// A scan of few points may agree with the map at several of them, for one tree is like another, or
/// rightly at none, where all that it shows is new. The posterior is sampled around prediction and
/// answer, and each sample is weighed by both laws (the balance heuristic of Veach & Guibas 1995);
/// what of it lies around the answer is the probability. Deterministic: the samples are always the
/// same.
///
/// @param points that were matched.
/// @param match that ended, with the prediction it was given.
/// @return 0..1. Of a scan with many points it is 1, unasked: no wrong pose explains nearly all. So
///         it is where the prediction leaves no doubt.
double ProbabilityOfMode(const LikelihoodPyramid& map,
                         std::span<const ScanPoint> points,
                         const MatchResult& match);

}  // namespace qwsm
