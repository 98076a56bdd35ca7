// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/journal/epoch_codec.hpp"

#include "service/io/journal/pose_codec.hpp"

namespace qwsm::io {
namespace {

// Scans begin with a number below 4; see EncodeScan().
constexpr std::uint32_t kEpochMark = 0x326f7065;
constexpr std::uint32_t kOneMapMark = 0x706f6365;  // Of journals that know of one map only.
// At least two lengths, a number, a pose and its covariance.
constexpr std::size_t kLeastBytes = 2 * sizeof(std::uint32_t) + 13 * sizeof(double);

}  // namespace

std::string EncodeEpoch(std::span<const JournaledPose> poses) {
  BinaryWriter writer;
  writer.Add(kEpochMark);
  writer.Add(static_cast<std::uint64_t>(poses.size()));
  for (const JournaledPose& pose : poses) {
    writer.Add(std::string_view(pose.service));
    writer.Add(std::string_view(pose.robot));
    writer.Add(pose.sequence);
    writer.Add(std::string_view(pose.component));
    AddPose(writer, pose.map_robot);
  }
  return writer.bytes();
}

bool IsEpoch(std::string_view contents) {
  if (contents.size() < sizeof(kEpochMark)) return false;
  const std::uint32_t mark = BinaryReader(contents).Unsigned32();
  return mark == kEpochMark || mark == kOneMapMark;
}

std::vector<JournaledPose> DecodeEpoch(std::string_view contents) {
  if (!IsEpoch(contents)) throw BinaryError("it is no correction of a map");
  BinaryReader reader(contents);
  const bool names_components = reader.Unsigned32() == kEpochMark;
  std::vector<JournaledPose> poses(reader.Count(kLeastBytes));
  for (JournaledPose& pose : poses) {
    pose.service = reader.Text();
    pose.robot = reader.Text();
    pose.sequence = reader.Unsigned64();
    if (names_components) pose.component = reader.Text();
    pose.map_robot = ReadUncertainPose(reader);
  }
  if (reader.remaining() > 0) throw BinaryError("there is more in it than a correction");
  return poses;
}

}  // namespace qwsm::io
