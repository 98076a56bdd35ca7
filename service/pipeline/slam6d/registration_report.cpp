// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>

#include "service/pipeline/run/progress_display.hpp"
#include "service/pipeline/slam6d/registration_results.hpp"

namespace slam6d::pipeline {
namespace {

using qwsm::pipeline::Json;

/// What is counted over all scans.
struct Figures {
  std::size_t points = 0;
  std::size_t kept_points = 0;  ///< After the thinning of the scans.
  double mean_voxel_m = 0.0;    ///< Of the scans that were thinned.
  std::size_t thinned = 0;
  std::size_t left_open = 0;  ///< Scans whose match leaves motions to the odometry.
  std::size_t loops = 0;
  double path_m = 0.0;
  double mean_overlap = 0.0;
  double mean_rms_m = 0.0;
  double time_s = 0.0;
  double longest_s = 0.0;
};

std::size_t Count(const Registration& registration, SlamStatus status) {
  return static_cast<std::size_t>(std::ranges::count_if(
      registration.scans, [&](const RegisteredScan& scan) { return scan.step.status == status; }));
}

Figures FiguresOf(const Registration& registration) {
  Figures figures;
  const auto matched =
      static_cast<double>(std::max<std::size_t>(Count(registration, SlamStatus::kMatched), 1));
  for (const RegisteredScan& scan : registration.scans) {
    figures.points += scan.cloud.size();
    figures.kept_points += scan.step.points;
    figures.thinned += scan.step.voxel_m > 0.0 ? 1 : 0;
    figures.mean_voxel_m += scan.step.voxel_m;
    figures.loops += scan.step.loops_to.size();
    figures.time_s += scan.time_s;
    figures.longest_s = std::max(figures.longest_s, scan.time_s);
    if (scan.step.status != SlamStatus::kMatched) continue;
    figures.left_open += scan.step.open_motions > 0 ? 1 : 0;
    figures.mean_overlap += scan.step.overlap / matched;
    figures.mean_rms_m += scan.step.match.rms_residual_m / matched;
  }
  figures.mean_voxel_m /= static_cast<double>(std::max<std::size_t>(figures.thinned, 1));
  const std::vector<Pose3>& poses = registration.T_map_scan;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    figures.path_m += (poses[i].translation_m - poses[i - 1].translation_m).norm();
  }
  return figures;
}

}  // namespace

Json MetricsOf(const Registration& registration) {
  const Figures figures = FiguresOf(registration);
  Json json;
  json["scans"] = registration.scans.size();
  json["scans_in_series"] = registration.series_size;
  json["matched"] = Count(registration, SlamStatus::kMatched);
  json["matched_with_open_motions"] = figures.left_open;
  json["dead_reckoned"] = Count(registration, SlamStatus::kDeadReckoned);
  json["unusable"] = Count(registration, SlamStatus::kUnusable);
  json["loops_closed"] = figures.loops;
  json["points"] = figures.points;
  json["points_kept"] = figures.kept_points;
  json["mean_voxel_m"] = figures.mean_voxel_m;
  json["path_length_m"] = figures.path_m;
  json["mean_overlap"] = figures.mean_overlap;
  json["mean_rms_residual_m"] = figures.mean_rms_m;
  json["refinement"]["fits"] = registration.refinement.fits;
  json["refinement"]["settled"] = registration.refinement.settled;
  json["time_registration_s"] = figures.time_s;
  json["time_refinement_s"] = registration.refinement_time_s;
  json["interrupted"] = registration.interrupted;
  return json;
}

std::string SummaryText(const Registration& registration) {
  using qwsm::pipeline::WithThousands;
  const Figures figures = FiguresOf(registration);
  std::string text = fmt::format("scans          {} of {}, {} points\n",
                                 registration.scans.size(),
                                 registration.series_size,
                                 WithThousands(figures.points));
  if (figures.thinned > 0) {
    text += fmt::format("thinned        {} scans to cubes of {:.2f} m, {} points left of all\n",
                        figures.thinned,
                        figures.mean_voxel_m,
                        WithThousands(figures.kept_points));
  }
  text += fmt::format("matched        {}, mean overlap {:.0f} %, mean residual {:.1f} mm\n",
                      Count(registration, SlamStatus::kMatched),
                      100.0 * figures.mean_overlap,
                      1000.0 * figures.mean_rms_m);
  if (figures.left_open > 0) {
    text += fmt::format(
        "left open      {} of these leave motions to odometry: open_motions and cov_* in "
        "scans.csv\n",
        figures.left_open);
  }
  text += fmt::format("dead-reckoned  {}\n", Count(registration, SlamStatus::kDeadReckoned));
  text += fmt::format("unusable       {}\n", Count(registration, SlamStatus::kUnusable));
  text += fmt::format("loops          {} closed\n", figures.loops);
  text += fmt::format("path           {:.1f} m\n", figures.path_m);
  text += fmt::format(
      "time           {:.2f} s registration (longest {:.2f} s)", figures.time_s, figures.longest_s);
  const RefinementResult& refinement = registration.refinement;
  if (refinement.fits > 0) {
    text += fmt::format(", {:.2f} s refinement ({} fits, {})",
                        registration.refinement_time_s,
                        refinement.fits,
                        refinement.settled ? "settled" : "not settled");
  }
  return text + "\n";
}

}  // namespace slam6d::pipeline
