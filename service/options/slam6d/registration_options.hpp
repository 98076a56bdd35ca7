// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "service/graph/loop_distribution.hpp"
#include "service/io/clouds/cloud_bag.hpp"
#include "service/io/clouds/scan_points.hpp"
#include "slam6d/mapping/slam.hpp"

namespace slam6d::options {

/// All options of `slam6d register`.
struct RegistrationOptions {
  io::PointFileOptions files{};
  io::CloudBagOptions bag{};
  /// A scan is taken to be in other units if its points are so many times as far off as those of
  /// the others, or as near.
  double max_range_ratio = 20.0;
  SlamOptions slam{};
  graph::LoopDistribution loop_error = graph::LoopDistribution::kLeastSquares;
  ReductionOptions model{};  ///< Reduction of the merged cloud.
};

template <class Visitor>
void Describe(Visitor& visit, RegistrationOptions& o) {
  visit("files", o.files, {.help = "units of files of points"});
  visit("bag", o.bag, {.help = "what is read of bags"});
  visit("max_range_ratio",
        o.max_range_ratio,
        {.help = "a scan so many times as wide as the others, or as narrow, is left out",
         .min = 2,
         .max = 1e9});
  visit("slam", o.slam, {.help = "registration of the scans"});
  visit("loop_error", o.loop_error, {.help = "how the error of a loop is spread over its scans"});
  visit("model", o.model, {.help = "thinning of the merged cloud"});
}

}  // namespace slam6d::options
