// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/png_writer.hpp"

#include <png.h>

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace qwsm::io {
namespace {

std::vector<std::uint8_t> ToRgb(const std::vector<std::uint32_t>& pixels) {
  std::vector<std::uint8_t> rgb;
  rgb.reserve(3 * pixels.size());
  for (const std::uint32_t pixel : pixels) {
    for (const unsigned shift : {16U, 8U, 0U}) {
      rgb.push_back(static_cast<std::uint8_t>(pixel >> shift & 0xFFU));
    }
  }
  return rgb;
}

}  // namespace

void WritePng(std::ostream& stream, const PixelImage& image) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = static_cast<png_uint_32>(image.width_px);
  png.height = static_cast<png_uint_32>(image.height_px);
  png.format = PNG_FORMAT_RGB;
  png.flags = PNG_IMAGE_FLAG_FAST;
  const std::vector<std::uint8_t> rgb = ToRgb(image.pixels);
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(png);
  std::string bytes(size, '\0');
  if (png_image_write_to_memory(&png, bytes.data(), &size, 0, rgb.data(), 0, nullptr) == 0) {
    throw std::runtime_error(std::string("PNG: ") + png.message);
  }
  stream.write(bytes.data(), static_cast<std::streamsize>(size));
}

}  // namespace qwsm::io
