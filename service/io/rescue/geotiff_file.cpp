// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/rescue/geotiff_file.hpp"

#include <fmt/format.h>
#include <tiffio.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <memory>
#include <system_error>

#include "service/io/files/atomic_file.hpp"

namespace qwsm::io {
namespace {

// GeoTIFF is TIFF with three tags more, which libtiff is told of here: libgeotiff, which knows
// them, brings a data base of the Earth's coordinate systems, and a robot's map is in none of
// these.
constexpr std::uint32_t kPixelScaleTag = 33550;
constexpr std::uint32_t kTiePointTag = 33922;
constexpr std::uint32_t kGeoKeysTag = 34735;

struct CloseTiff {
  void operator()(TIFF* tiff) const { TIFFClose(tiff); }
};
using TiffHandle = std::unique_ptr<TIFF, CloseTiff>;

void DeclareGeoTags(TIFF* tiff) {
  static std::array<char, 20> scale{"ModelPixelScaleTag"};
  static std::array<char, 20> tie_point{"ModelTiepointTag"};
  static std::array<char, 20> keys{"GeoKeyDirectoryTag"};
  const auto field = [](std::uint32_t tag, TIFFDataType type, std::array<char, 20>& name) {
    return TIFFFieldInfo{tag, TIFF_VARIABLE, TIFF_VARIABLE, type, FIELD_CUSTOM, 1, 1, name.data()};
  };
  static const std::array fields = {field(kPixelScaleTag, TIFF_DOUBLE, scale),
                                    field(kTiePointTag, TIFF_DOUBLE, tie_point),
                                    field(kGeoKeysTag, TIFF_SHORT, keys)};
  TIFFMergeFieldInfo(tiff, fields.data(), static_cast<std::uint32_t>(fields.size()));
}

template <class Value, std::size_t kCount>
void SetNumbers(TIFF* tiff, std::uint32_t tag, const std::array<Value, kCount>& values) {
  TIFFSetField(tiff, tag, static_cast<int>(kCount), values.data());
}

void SetPlace(TIFF* tiff, const GeoPicture& picture) {
  const Eigen::Vector2d& corner_m = picture.top_left_map_m;
  SetNumbers(tiff, kPixelScaleTag, std::array{picture.pixel_m, picture.pixel_m, 0.0});
  SetNumbers(tiff, kTiePointTag, std::array{0.0, 0.0, 0.0, corner_m.x(), corner_m.y(), 0.0});
  // A header (version 1.1.0, three keys), then each key: its number, 0, 1, its value.
  constexpr std::array<std::uint16_t, 16> kGeoKeys = {1,
                                                      1,
                                                      0,
                                                      3,  // Header.
                                                      1024,
                                                      0,
                                                      1,
                                                      32767,  // Model: user-defined.
                                                      1025,
                                                      0,
                                                      1,
                                                      1,  // Pixels are areas.
                                                      3076,
                                                      0,
                                                      1,
                                                      9001};  // Linear unit: metre.
  SetNumbers(tiff, kGeoKeysTag, kGeoKeys);
}

void SetFormat(TIFF* tiff, const PixelImage& image) {
  constexpr std::uint32_t kRowsPerStrip = 64;
  TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, static_cast<std::uint32_t>(image.width_px));
  TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, static_cast<std::uint32_t>(image.height_px));
  TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, 8);
  TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, 3);
  TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_RGB);
  TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
  TIFFSetField(tiff, TIFFTAG_ORIENTATION, ORIENTATION_TOPLEFT);
  TIFFSetField(tiff, TIFFTAG_COMPRESSION, COMPRESSION_LZW);
  TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, kRowsPerStrip);
}

bool WriteRows(TIFF* tiff, const PixelImage& image) {
  const auto width = static_cast<std::size_t>(image.width_px);
  std::vector<std::uint8_t> bytes(3 * width);
  for (std::uint32_t row = 0; row < static_cast<std::uint32_t>(image.height_px); ++row) {
    for (std::size_t px = 0; px < width; ++px) {
      const std::uint32_t pixel = image.pixels[row * width + px];
      bytes[3 * px] = static_cast<std::uint8_t>(pixel >> 16U);
      bytes[3 * px + 1] = static_cast<std::uint8_t>(pixel >> 8U);
      bytes[3 * px + 2] = static_cast<std::uint8_t>(pixel);
    }
    if (TIFFWriteScanline(tiff, bytes.data(), row, 0) < 0) return false;
  }
  return TIFFFlush(tiff) == 1;
}

}  // namespace

void WriteGeoTiff(const std::filesystem::path& path, const GeoPicture& picture) {
  TIFFSetErrorHandler(nullptr);  // What fails is told by an exception.
  TIFFSetWarningHandler(nullptr);
  AtomicFile file(path);
  errno = 0;
  {
    const TiffHandle tiff(TIFFOpen(file.temporary_path().c_str(), "w"));
    bool is_written = false;
    if (tiff) {
      DeclareGeoTags(tiff.get());
      SetFormat(tiff.get(), picture.image);
      SetPlace(tiff.get(), picture);
      is_written = WriteRows(tiff.get(), picture.image);
    }
    if (!is_written) {
      throw WriteError(path.string() +
                       ": cannot be written: " + std::generic_category().message(errno));
    }
  }
  file.Commit();
}

void WriteWorldFile(const std::filesystem::path& path, const GeoPicture& picture) {
  const double pixel_m = picture.pixel_m;
  const Eigen::Vector2d& corner_m = picture.top_left_map_m;
  WriteTextFile(path,
                fmt::format("{:.10f}\n{:.10f}\n{:.10f}\n{:.10f}\n{:.10f}\n{:.10f}\n",
                            pixel_m,
                            0.0,
                            0.0,
                            -pixel_m,
                            corner_m.x() + 0.5 * pixel_m,
                            corner_m.y() - 0.5 * pixel_m));
}

}  // namespace qwsm::io
