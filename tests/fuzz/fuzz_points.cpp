// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

#include "service/io/clouds/cloud_codec.hpp"
#include "service/io/clouds/scan_points.hpp"
#include "service/io/clouds/trajectory3_file.hpp"
#include "service/io/clouds/uos_scan.hpp"
#include "service/io/files/binary.hpp"
#include "slam6d/geometry/position.hpp"
#include "tests/fuzz/expect.hpp"
#include "tests/fuzz/input_file.hpp"

namespace {

using qwsm::test::Expect;
using qwsm::test::InputFile;
using namespace slam6d;
using namespace slam6d::io;

void ReadPoints(const std::filesystem::path& file) {
  const ScanPoints points = ReadScanPoints(file);
  for (std::size_t i = 0; i < points.cloud.size(); ++i) Expect(IsPosition(points.cloud[i]));
  Expect((points.skipped_lines > 0) == !points.first_problem.empty());
}

void ReadPoseOfUos(const std::filesystem::path& file) { Expect(IsPosition(ReadUosPose(file))); }
void ReadFramesOfUos(const std::filesystem::path& file) { Expect(IsPosition(ReadUosFrames(file))); }
void ReadTum(const std::filesystem::path& file) {
  for (const auto& [number, pose] : ReadPoses(file)) Expect(IsPosition(pose));
}

/// A kind of file, by the first letter of the input.
struct Reading {
  char letter;
  InputFile file;
  void (*read)(const std::filesystem::path&);
};

const Reading& ReadingFor(char letter) {
  static const std::array<Reading, 8> kReadings{{{'y', InputFile("a.ply"), ReadPoints},
                                                 {'c', InputFile("a.pcd"), ReadPoints},
                                                 {'x', InputFile("a.xyz"), ReadPoints},
                                                 {'k', InputFile("a.bin"), ReadPoints},
                                                 {'u', InputFile("a.3d"), ReadPoints},
                                                 {'p', InputFile("a.pose"), ReadPoseOfUos},
                                                 {'f', InputFile("a.frames"), ReadFramesOfUos},
                                                 {'t', InputFile("a.tum"), ReadTum}}};
  for (const Reading& reading : kReadings) {
    if (reading.letter == letter) return reading;
  }
  return kReadings[static_cast<unsigned char>(letter) % kReadings.size()];
}

void Decode(std::string_view bytes) {
  try {
    const JournaledCloud scan = DecodeCloud(bytes);
    Expect(EncodeCloud(scan).size() == bytes.size());
  } catch (const qwsm::io::BinaryError&) {
  }
}

}  // namespace

/// A letter that says what kind of file, then any bytes as that file: never a crash, never an
/// exception but one that names the file; only points and poses that may be. And the bytes as a
/// scan of a journal.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  Decode(bytes);
  if (bytes.empty()) return 0;
  const Reading& reading = ReadingFor(bytes.front());
  reading.file.Write(std::string_view(bytes).substr(1));
  try {
    reading.read(reading.file.path());
  } catch (const std::runtime_error& error) {
    Expect(std::string_view(error.what()).find(reading.file.path().string()) !=
           std::string_view::npos);
  }
  return 0;
}
