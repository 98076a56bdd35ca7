// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/maps/pgm_file.hpp"

#include <cctype>
#include <istream>
#include <limits>
#include <stdexcept>
#include <string>

#include "service/io/files/atomic_file.hpp"
#include "service/io/files/file_error.hpp"

namespace qwsm::io {
namespace {

// The next number of the header; -1 where there is none or it is absurd. Comments run from # to the
// end of the line.
int HeaderNumber(std::istream& stream) {
  stream >> std::ws;
  while (stream.peek() == '#') {
    stream.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
    stream >> std::ws;
  }
  int number = -1;
  if (std::isdigit(stream.peek()) == 0) return -1;
  return stream >> number ? number : -1;
}

}  // namespace

void WritePgm(const std::filesystem::path& path, const GreyImage& image) {
  AtomicFile file(path);
  file.stream() << "P5\n" << image.width_px << ' ' << image.height_px << "\n255\n";
  file.stream().write(reinterpret_cast<const char*>(image.pixels.data()),
                      static_cast<std::streamsize>(image.pixels.size()));
  file.Commit();
}

GreyImage ReadPgm(const std::filesystem::path& path) {
  const auto fail = [&path](const std::string& what) {
    throw std::runtime_error(path.string() + ": " + what);
  };
  std::ifstream file = OpenForReading(path);
  std::string magic(2, '\0');
  if (!file.read(magic.data(), 2) || magic != "P5") {
    fail("is no binary PGM picture (P5); ImageMagick makes one of others: convert map.png map.pgm");
  }
  const int width_px = HeaderNumber(file);
  const int height_px = HeaderNumber(file);
  const int white = HeaderNumber(file);
  if (width_px < 1 || height_px < 1) fail("has no size");
  if (white != 255) fail("has not 8 bits per pixel");
  file.ignore(1);  // The white space that ends the header.

  const auto size = static_cast<std::uintmax_t>(width_px) * static_cast<std::uintmax_t>(height_px);
  // Before memory is taken for what a header claims.
  if (size > std::filesystem::file_size(path)) fail("ends early");
  GreyImage image{.width_px = width_px, .height_px = height_px, .pixels = {}};
  image.pixels.resize(size);
  file.read(reinterpret_cast<char*>(image.pixels.data()), static_cast<std::streamsize>(size));
  if (!file) fail("ends early");
  return image;
}

}  // namespace qwsm::io
