// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace qwsm::io {

/// A colour: shares of red, green and blue, and how opaque; each in [0, 1].
struct Color {
  double red = 0.0;
  double green = 0.0;
  double blue = 0.0;
  double alpha = 1.0;
};

/// The colour that designers write as three bytes: FromBytes(0, 40, 120).
constexpr Color FromBytes(int red, int green, int blue, double alpha = 1.0) {
  return {red / 255.0, green / 255.0, blue / 255.0, alpha};
}

/// Opaque pixels, row by row from the top: 0xRRGGBB.
struct PixelImage {
  int width_px = 0;
  int height_px = 0;
  std::vector<std::uint32_t> pixels;
};

/// The opaque pixel nearest to a colour.
constexpr std::uint32_t ToPixel(const Color& color) {
  const auto byte = [](double share) { return static_cast<std::uint32_t>(255.0 * share + 0.5); };
  return byte(color.red) << 16U | byte(color.green) << 8U | byte(color.blue);
}

struct Rectangle {
  Eigen::Vector2d corner_px;  ///< Upper left corner.
  Eigen::Vector2d size_px;
};

struct LineStyle {
  Color color;
  double width_px = 1.0;
  double dash_px = 0.0;  ///< Length of dashes and gaps; 0 is a solid line.
};

enum class TextAlignment { kLeft, kCenter, kRight };

struct TextStyle {
  Color color;
  double size_px = 14.0;
  TextAlignment alignment = TextAlignment::kLeft;
  bool bold = false;
  /// Whether the text is turned by a quarter to the left, as along an axis.
  bool upwards = false;
};

/// A picture to draw on, in pixels: x to the right, y down, the origin in the upper-left corner.
class Canvas {
 public:
  /// Makes a white picture.
  Canvas(int width_px, int height_px);
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;
  ~Canvas();

  int width_px() const { return width_px_; }
  int height_px() const { return height_px_; }

  void Fill(const Rectangle& rectangle, const Color& color);
  void FillPolygon(std::span<const Eigen::Vector2d> corners_px, const Color& color);
  /// Draws a line through points; a single point is a dot.
  void Stroke(std::span<const Eigen::Vector2d> points_px, const LineStyle& style);
  void StrokeLine(const Eigen::Vector2d& from_px,
                  const Eigen::Vector2d& to_px,
                  const LineStyle& style);
  /// Draws an image with its upper-left corner at `corner_px`, one pixel for one.
  void Draw(PixelImage image, const Eigen::Vector2d& corner_px);

  /// Writes text of UTF-8, any other bytes as question marks, whose middle line has `anchor_px` where the alignment says.
  void Write(const std::string& text, const Eigen::Vector2d& anchor_px, const TextStyle& style);
  double TextWidth(const std::string& text, const TextStyle& style) const;

  /// Draws what follows within the rectangle only, until Unclip().
  void Clip(const Rectangle& rectangle);
  void Unclip();

  /// The picture as pixels.
  PixelImage Pixels() const;

  /// Writes a PNG or an SVG, as the name ends.
  /// @throws std::invalid_argument for another ending, WriteError where the file cannot be written.
  void Save(const std::filesystem::path& path) const;

 private:
  struct Recording;  // The recording surface of Cairo.
  int width_px_;
  int height_px_;
  std::unique_ptr<Recording> recording_;
};

}  // namespace qwsm::io
