// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/pictures/png_writer.hpp"

#include <png.h>
#include <zlib.h>

#include <bit>
#include <csetjmp>
#include <stdexcept>
#include <string>

namespace qwsm::io {
namespace {

// libpng's way to tell of an error is a jump back to setjmp().
[[noreturn]] void Fail(png_structp png, png_const_charp message) {
  *static_cast<std::string*>(png_get_error_ptr(png)) = message;
  png_longjmp(png, 1);
}

void Ignore(png_structp, png_const_charp) {}

void WriteBytes(png_structp png, png_bytep bytes, std::size_t count) {
  auto& stream = *static_cast<std::ostream*>(png_get_io_ptr(png));
  stream.write(reinterpret_cast<const char*>(bytes), static_cast<std::streamsize>(count));
}

void Flush(png_structp) {}

/// What libpng needs for one picture.
class Encoder {
 public:
  explicit Encoder(std::ostream& stream)
      : png_(png_create_write_struct(PNG_LIBPNG_VER_STRING, &message_, Fail, Ignore)) {
    if (png_ != nullptr) info_ = png_create_info_struct(png_);
    if (info_ == nullptr) throw std::runtime_error("PNG: out of memory");
    png_set_write_fn(png_, &stream, WriteBytes, Flush);
  }
  Encoder(const Encoder&) = delete;
  Encoder& operator=(const Encoder&) = delete;
  ~Encoder() { png_destroy_write_struct(&png_, &info_); }

  void Write(const PixelRows& rows) {
    if (!HasWritten(rows)) throw std::runtime_error("PNG: " + message_);
  }
  void WriteCells(int width_px, std::span<const std::uint8_t> cells) {
    if (!HasWrittenCells(width_px, cells)) throw std::runtime_error("PNG: " + message_);
  }

 private:
  // Nothing here has a destructor, which a jump would pass over.
  bool HasWritten(const PixelRows& rows) {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;  // NOLINT(cert-err52-cpp)
    SetHeader(rows.width_px, rows.height_px, 8, PNG_COLOR_TYPE_RGB);
    png_set_filter(png_, PNG_FILTER_TYPE_BASE, PNG_FILTER_UP);
    png_set_compression_strategy(png_, Z_RLE);
    png_write_info(png_, info_);
    constexpr bool kBlueFirst = std::endian::native == std::endian::little;
    png_set_filler(png_, 0, kBlueFirst ? PNG_FILLER_AFTER : PNG_FILLER_BEFORE);
    if (kBlueFirst) png_set_bgr(png_);
    for (int y = 0; y < rows.height_px; ++y) {
      png_write_row(png_, rows.first + y * rows.stride_bytes);
    }
    png_write_end(png_, nullptr);
    return true;
  }

  bool HasWrittenCells(int width_px, std::span<const std::uint8_t> cells) {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;  // NOLINT(cert-err52-cpp)
    const auto width = static_cast<std::size_t>(width_px);
    SetHeader(width_px, static_cast<int>(cells.size() / width), 2, PNG_COLOR_TYPE_GRAY);
    png_write_info(png_, info_);
    png_set_packing(png_);
    for (std::size_t first = 0; first < cells.size(); first += width) {
      png_write_row(png_, cells.data() + first);
    }
    png_write_end(png_, nullptr);
    return true;
  }

  void SetHeader(int width_px, int height_px, int bits, int colors) {
    png_set_IHDR(png_,
                 info_,
                 static_cast<png_uint_32>(width_px),
                 static_cast<png_uint_32>(height_px),
                 bits,
                 colors,
                 PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
  }

  std::string message_;
  png_structp png_;
  png_infop info_ = nullptr;
};

}  // namespace

void WritePng(std::ostream& stream, const PixelRows& rows) { Encoder(stream).Write(rows); }

void WriteCellsPng(std::ostream& stream, int width_px, std::span<const std::uint8_t> cells) {
  Encoder(stream).WriteCells(width_px, cells);
}

}  // namespace qwsm::io
