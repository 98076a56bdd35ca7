// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/pictures/cloud_picture.hpp"

#include <algorithm>
#include <cmath>

#include "service/io/pictures/axis.hpp"
#include "service/io/pictures/canvas.hpp"
#include "slam6d/cloud/bounds.hpp"

namespace slam6d::io {
namespace {

using qwsm::io::Canvas;
using qwsm::io::Color;
using qwsm::io::FromBytes;

constexpr double kLongSide_px = 1400.0;
constexpr double kMargin_px = 50.0;
constexpr double kLeastExtent_m = 1.0;
/// This share of the points at either end of an axis may lie outside.
constexpr double kStrayShare = 0.002;

constexpr Color kPointColor = FromBytes(0, 40, 120);
constexpr Color kPath = FromBytes(220, 60, 20);
constexpr Color kText = FromBytes(60, 60, 60);

/// About so many of the points tell where nearly all of them are.
constexpr std::size_t kWindowSample = 50'000;

Eigen::Vector2d Seen(const Eigen::Vector3d& point_m, CloudView view) {
  return {point_m.x(), view == CloudView::kTop ? point_m.y() : point_m.z()};
}

/// A window as pixels.
class Projection {
 public:
  Projection(const CloudWindow& window, CloudView view) : window_(window), view_(view) {
    const Eigen::Vector2d extent_m = window.high_m - window.low_m;
    px_per_m_ = kLongSide_px / extent_m.maxCoeff();
    size_px_ = (extent_m * px_per_m_).array().ceil().max(40.0);
  }

  const Eigen::Vector2d& size_px() const { return size_px_; }
  double px_per_m() const { return px_per_m_; }

  Eigen::Vector2d ToPixel(const Eigen::Vector3d& point_m) const {
    const Eigen::Vector2d offset_px = (Seen(point_m, view_) - window_.low_m) * px_per_m_;
    return {offset_px.x(), size_px_.y() - offset_px.y()};
  }

 private:
  CloudWindow window_;
  CloudView view_;
  double px_per_m_;
  Eigen::Vector2d size_px_;
};

/// The colour of a pixel by how many points fall into it, up to the most: the logarithm of it.
std::vector<std::uint32_t> Inks(std::uint32_t most) {
  const double full = std::log1p(static_cast<double>(most));
  std::vector<std::uint32_t> inks;
  for (std::uint32_t count = 0; count <= most; ++count) {
    const double share = std::log1p(static_cast<double>(count)) / full;
    const auto mix = [&](double ink) { return 1.0 + std::sqrt(share) * (ink - 1.0); };
    inks.push_back(
        qwsm::io::ToPixel({mix(kPointColor.red), mix(kPointColor.green), mix(kPointColor.blue)}));
  }
  return inks;
}

qwsm::io::PixelImage Shade(const PointCloud& points, const Projection& projection) {
  qwsm::io::PixelImage image;
  image.width_px = static_cast<int>(projection.size_px().x());
  image.height_px = static_cast<int>(projection.size_px().y());
  const auto width = static_cast<std::size_t>(image.width_px);
  std::vector<std::uint32_t> counts(width * static_cast<std::size_t>(image.height_px));
  std::uint32_t most = 1;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector2d at_px = projection.ToPixel(points[i]);
    if (!(at_px.minCoeff() >= 0.0 && at_px.x() < image.width_px && at_px.y() < image.height_px)) {
      continue;
    }
    const std::size_t pixel =
        static_cast<std::size_t>(at_px.y()) * width + static_cast<std::size_t>(at_px.x());
    most = std::max(most, ++counts[pixel]);
  }
  const std::uint32_t darkest = std::min(most, 100U);
  const std::vector<std::uint32_t> inks = Inks(darkest);
  image.pixels.reserve(counts.size());
  for (const std::uint32_t count : counts) image.pixels.push_back(inks[std::min(count, darkest)]);
  return image;
}

void WriteScale(const Projection& projection, const Eigen::Vector2d& corner_px, Canvas& canvas) {
  const double length_m = qwsm::io::RoundUpToNice(0.08 * kLongSide_px / projection.px_per_m());
  const Eigen::Vector2d end_px = corner_px + Eigen::Vector2d(length_m * projection.px_per_m(), 0.0);
  canvas.StrokeLine(corner_px, end_px, {.color = kText, .width_px = 3.0});
  canvas.Write(qwsm::io::LengthLabel(length_m),
               end_px + Eigen::Vector2d(10.0, 0.0),
               {.color = kText, .size_px = 16.0});
}

}  // namespace

CloudWindow WindowOf(const CloudScene& scene, CloudView view) {
  std::vector<double> across;
  std::vector<double> up;
  const std::size_t step = scene.points.size() / kWindowSample + 1;
  for (std::size_t i = 0; i < scene.points.size(); i += step) {
    const Eigen::Vector2d seen = Seen(scene.points[i], view);
    across.push_back(seen.x());
    up.push_back(seen.y());
  }
  const Bounds bounds_across = BoundsOf(std::move(across), kStrayShare);
  const Bounds bounds_up = BoundsOf(std::move(up), kStrayShare);
  CloudWindow window{.low_m = {bounds_across.low, bounds_up.low},
                     .high_m = {bounds_across.high, bounds_up.high}};
  for (const Eigen::Vector3d& stop_m : scene.path_m) {
    window.low_m = window.low_m.cwiseMin(Seen(stop_m, view));
    window.high_m = window.high_m.cwiseMax(Seen(stop_m, view));
  }
  window.low_m.array() -= 0.5 * kLeastExtent_m;
  window.high_m.array() += 0.5 * kLeastExtent_m;
  return window;
}

void WriteCloudPicture(const std::filesystem::path& file,
                       const CloudScene& scene,
                       CloudView view,
                       const CloudWindow& window) {
  const Projection projection(window, view);
  const Eigen::Vector2d corner_px(kMargin_px, kMargin_px);
  const Eigen::Vector2d size_px = projection.size_px() + 2.0 * corner_px;
  Canvas canvas(static_cast<int>(size_px.x()), static_cast<int>(size_px.y()));
  canvas.Draw(Shade(scene.points, projection), corner_px);
  std::vector<Eigen::Vector2d> path_px;
  for (const Eigen::Vector3d& stop_m : scene.path_m) {
    path_px.push_back(corner_px + projection.ToPixel(stop_m));
  }
  canvas.Stroke(path_px, {.color = kPath, .width_px = 1.5});
  for (const Eigen::Vector2d& stop_px : path_px) {
    canvas.Stroke({&stop_px, 1}, {.color = kPath, .width_px = 6.0});
  }
  canvas.Write(scene.title, {kMargin_px, 0.5 * kMargin_px}, {.color = kText, .size_px = 18.0});
  WriteScale(projection, {kMargin_px, size_px.y() - 0.5 * kMargin_px}, canvas);
  canvas.Save(file);
}

}  // namespace slam6d::io
