// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/pictures/canvas.hpp"

#include <cairo-svg.h>
#include <cairo.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <deque>
#include <numbers>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "service/io/files/atomic_file.hpp"
#include "service/io/pictures/png_writer.hpp"

namespace qwsm::io {
namespace {

struct DestroySurface {
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
};
struct DestroyContext {
  void operator()(cairo_t* context) const { cairo_destroy(context); }
};
using Surface = std::unique_ptr<cairo_surface_t, DestroySurface>;
using Context = std::unique_ptr<cairo_t, DestroyContext>;

cairo_status_t WriteSvg(void* stream, const unsigned char* bytes, unsigned int count) {
  auto& out = *static_cast<std::ostream*>(stream);
  out.write(reinterpret_cast<const char*>(bytes), count);
  return out ? CAIRO_STATUS_SUCCESS : CAIRO_STATUS_WRITE_ERROR;
}

void ThrowIfFailed(cairo_status_t status, const std::filesystem::path& path) {
  if (status == CAIRO_STATUS_SUCCESS) return;
  throw WriteError(path.string() + ": cannot be written: " + cairo_status_to_string(status));
}

void Select(cairo_t* context, const Color& color) {
  cairo_set_source_rgba(context, color.red, color.green, color.blue, color.alpha);
}

void SelectFont(cairo_t* context, const TextStyle& style) {
  cairo_select_font_face(context,
                         "sans-serif",
                         CAIRO_FONT_SLANT_NORMAL,
                         style.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(context, style.size_px);
}

/// Length of the character of UTF-8 that a text begins with; 0 where it begins with none.
std::size_t LengthOfCharacter(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const std::size_t length = byte(0) < 0x80   ? 1
                             : byte(0) < 0xC2 ? 0
                             : byte(0) < 0xE0 ? 2
                             : byte(0) < 0xF0 ? 3
                             : byte(0) < 0xF5 ? 4
                                              : 0;
  if (length > text.size()) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0U) != 0x80U) return 0;
  }
  if (length < 3) return length;
  // Written with too many bytes, half of a pair of UTF-16, or beyond Unicode.
  const unsigned second = byte(1);
  const bool is_refused = (byte(0) == 0xE0 && second < 0xA0) ||
                          (byte(0) == 0xED && second > 0x9F) ||
                          (byte(0) == 0xF0 && second < 0x90) || (byte(0) == 0xF4 && second > 0x8F);
  return is_refused ? 0 : length;
}

/// The text that Cairo is given, which draws nothing more once it was given what is no UTF-8.
std::string Drawable(std::string_view text) {
  std::string drawable;
  while (!text.empty()) {
    const std::size_t length = LengthOfCharacter(text);
    if (length == 0) {
      drawable += '?';
    } else {
      drawable += text.substr(0, length);
    }
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return drawable;
}

void Trace(cairo_t* context, std::span<const Eigen::Vector2d> points_px) {
  cairo_new_path(context);
  for (const Eigen::Vector2d& point_px : points_px) {
    cairo_line_to(context, point_px.x(), point_px.y());
  }
}

void TraceRectangle(cairo_t* context, const Rectangle& rectangle) {
  const auto& [corner_px, size_px] = rectangle;
  cairo_new_path(context);
  cairo_rectangle(context, corner_px.x(), corner_px.y(), size_px.x(), size_px.y());
}

PixelRows RowsOf(cairo_surface_t* surface) {
  cairo_surface_flush(surface);
  return {.width_px = cairo_image_surface_get_width(surface),
          .height_px = cairo_image_surface_get_height(surface),
          .first = cairo_image_surface_get_data(surface),
          .stride_bytes = cairo_image_surface_get_stride(surface)};
}

void Replay(cairo_surface_t* recording, cairo_surface_t* target) {
  const Context context(cairo_create(target));
  cairo_set_source_surface(context.get(), recording, 0.0, 0.0);
  cairo_paint(context.get());
}

}  // namespace

// Drawing is recorded, and replayed on the surface of the format it is saved in.
struct Canvas::Recording {
  explicit Recording(int width_px, int height_px) {
    const cairo_rectangle_t extent = {
        0.0, 0.0, static_cast<double>(width_px), static_cast<double>(height_px)};
    surface.reset(cairo_recording_surface_create(CAIRO_CONTENT_COLOR_ALPHA, &extent));
    context.reset(cairo_create(surface.get()));
  }
  Recording(const Recording&) = delete;
  Recording& operator=(const Recording&) = delete;
  /// An SVG surface of Cairo 1.16 never lets go of what was painted on it: what was recorded is
  /// freed here, whoever holds it.
  ~Recording() { cairo_surface_finish(surface.get()); }

  /// An image that was drawn: the recording refers to it.
  struct DrawnImage {
    explicit DrawnImage(PixelImage drawn)
        : image(std::move(drawn)),
          surface(cairo_image_surface_create_for_data(
              reinterpret_cast<unsigned char*>(image.pixels.data()),
              CAIRO_FORMAT_RGB24,
              image.width_px,
              image.height_px,
              cairo_format_stride_for_width(CAIRO_FORMAT_RGB24, image.width_px))) {}

    PixelImage image;
    Surface surface;
  };

  std::deque<DrawnImage> images;
  Surface surface;
  Context context;
};

Canvas::Canvas(int width_px, int height_px)
    : width_px_(width_px),
      height_px_(height_px),
      recording_(std::make_unique<Recording>(width_px, height_px)) {
  cairo_set_line_join(recording_->context.get(), CAIRO_LINE_JOIN_ROUND);
  cairo_set_line_cap(recording_->context.get(), CAIRO_LINE_CAP_ROUND);
  Fill({.corner_px = {0.0, 0.0}, .size_px = {width_px, height_px}}, {1.0, 1.0, 1.0});
}

Canvas::~Canvas() = default;

void Canvas::Fill(const Rectangle& rectangle, const Color& color) {
  TraceRectangle(recording_->context.get(), rectangle);
  Select(recording_->context.get(), color);
  cairo_fill(recording_->context.get());
}

void Canvas::FillPolygon(std::span<const Eigen::Vector2d> corners_px, const Color& color) {
  Trace(recording_->context.get(), corners_px);
  cairo_close_path(recording_->context.get());
  Select(recording_->context.get(), color);
  cairo_fill(recording_->context.get());
}

void Canvas::Stroke(std::span<const Eigen::Vector2d> points_px, const LineStyle& style) {
  cairo_t* const context = recording_->context.get();
  Trace(context, points_px);
  if (points_px.size() == 1) cairo_close_path(context);  // A dot.
  Select(context, style.color);
  cairo_set_line_width(context, style.width_px);
  cairo_set_dash(context, &style.dash_px, style.dash_px > 0.0 ? 1 : 0, 0.0);
  cairo_stroke(context);
}

void Canvas::StrokeLine(const Eigen::Vector2d& from_px,
                        const Eigen::Vector2d& to_px,
                        const LineStyle& style) {
  const std::array points_px = {from_px, to_px};
  Stroke(points_px, style);
}

void Canvas::Draw(PixelImage image, const Eigen::Vector2d& corner_px) {
  cairo_surface_t* const pixels = recording_->images.emplace_back(std::move(image)).surface.get();
  cairo_set_source_surface(recording_->context.get(), pixels, corner_px.x(), corner_px.y());
  cairo_paint(recording_->context.get());
}

double Canvas::TextWidth(const std::string& text, const TextStyle& style) const {
  SelectFont(recording_->context.get(), style);
  cairo_text_extents_t extents;
  cairo_text_extents(recording_->context.get(), Drawable(text).c_str(), &extents);
  return extents.x_advance;
}

void Canvas::Write(const std::string& text,
                   const Eigen::Vector2d& anchor_px,
                   const TextStyle& style) {
  cairo_t* const context = recording_->context.get();
  const double width_px = TextWidth(text, style);
  const double shift_px = style.alignment == TextAlignment::kLeft     ? 0.0
                          : style.alignment == TextAlignment::kCenter ? -0.5 * width_px
                                                                      : -width_px;
  constexpr double kMiddleShare = 0.35;  // Height of an x's middle, as a share of the size.
  cairo_save(context);
  cairo_translate(context, anchor_px.x(), anchor_px.y());
  if (style.upwards) cairo_rotate(context, -0.5 * std::numbers::pi);
  cairo_move_to(context, shift_px, kMiddleShare * style.size_px);
  Select(context, style.color);
  cairo_show_text(context, Drawable(text).c_str());
  cairo_restore(context);
}

void Canvas::Clip(const Rectangle& rectangle) {
  cairo_save(recording_->context.get());
  TraceRectangle(recording_->context.get(), rectangle);
  cairo_clip(recording_->context.get());
}

void Canvas::Unclip() { cairo_restore(recording_->context.get()); }

PixelImage Canvas::Pixels() const {
  const Surface drawn(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width_px_, height_px_));
  Replay(recording_->surface.get(), drawn.get());
  const PixelRows rows = RowsOf(drawn.get());
  PixelImage image{.width_px = width_px_, .height_px = height_px_, .pixels = {}};
  const auto width = static_cast<std::size_t>(width_px_);
  image.pixels.resize(width * static_cast<std::size_t>(height_px_));
  constexpr std::uint32_t kColorBits = 0xFFFFFFU;  // Cairo leaves the others undefined.
  for (int y = 0; y < height_px_; ++y) {
    const auto* const row =
        reinterpret_cast<const std::uint32_t*>(rows.first + y * rows.stride_bytes);
    std::transform(row,
                   row + width,
                   image.pixels.begin() + static_cast<std::ptrdiff_t>(y) * width_px_,
                   [](std::uint32_t pixel) { return pixel & kColorBits; });
  }
  return image;
}

void Canvas::Save(const std::filesystem::path& path) const {
  const std::string extension = path.extension().string();
  if (extension != ".png" && extension != ".svg") {
    throw std::invalid_argument(path.string() + ": pictures end in .png or .svg");
  }
  ThrowIfFailed(cairo_status(recording_->context.get()), path);
  AtomicFile file(path);
  if (extension == ".svg") {
    const Surface svg(
        cairo_svg_surface_create_for_stream(WriteSvg, &file.stream(), width_px_, height_px_));
    Replay(recording_->surface.get(), svg.get());
    cairo_surface_finish(svg.get());
    ThrowIfFailed(cairo_surface_status(svg.get()), path);
  } else {
    const Surface pixels(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width_px_, height_px_));
    Replay(recording_->surface.get(), pixels.get());
    ThrowIfFailed(cairo_surface_status(pixels.get()), path);
    WritePng(file.stream(), RowsOf(pixels.get()));
    file.ThrowIfFailed();
  }
  file.Commit();
}

}  // namespace qwsm::io
