// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "qwsm/sensor/imu_reading.hpp"
#include "service/io/bags/assembly/bag_faults.hpp"
#include "service/io/bags/assembly/odometry_track.hpp"
#include "service/io/bags/assembly/transform_tree.hpp"
#include "service/io/bags/containers/bag_files.hpp"

namespace qwsm::io {

/// Where a message stands in a bag, and when what it tells was measured.
struct MessagePlace {
  Timestamp stamp{};
  std::uint64_t sequence = 0;  ///< Number of the message in the bag, counted from 1.
  MessageAddress address;
  std::uint32_t file = 0;
  std::uint32_t topic = 0;  ///< Index among the file's topics.
};

/// The scans of one laser on a topic.
struct ScanTopic {
  std::string frame;
  std::vector<MessagePlace> places;
};

/// A topic of odometry.
struct OdometryTopic {
  std::string child_frame;
  OdometryTrack track;
};

/// A topic of an inertial sensor.
struct ImuTopic {
  std::string frame;
  std::vector<ImuReading> readings;  ///< In the order of the bag, about the sensor's axes.
};

/// What a bag holds: read once from begin to end, and kept but for the scans themselves.
///
/// Messages may stand in any order, and what says where a laser sits may come last: so all are
/// seen before the first scan is given.
struct BagContents {
  std::vector<OpenBagFile> files;
  /// By topic; lasers on one topic, told apart by their frames, as "/scan", "/scan[rear]" ...
  std::map<std::string, ScanTopic> scans;
  std::map<std::string, OdometryTopic> odometry;
  std::map<std::string, ImuTopic> imus;
  std::map<std::string, OdometryTrack> truth;       ///< Topics of a simulator's ground truth.
  std::map<std::string, TransformTree> transforms;  ///< By namespace: "" or "/robot1".
};

/// The namespace of a topic: "/robot1" of "/robot1/scan" and "/robot1/scan[rear]", "" of "/scan".
std::string NamespaceOf(std::string_view topic);

/// Hands over every message of a bag, file after file.
/// @param files takes the files, which can be asked for any message again.
/// @param take (topic, message, number of the file).
/// @throws std::runtime_error naming the file where one cannot be opened or is no bag.
void ForEachMessage(
    const std::filesystem::path& path,
    BagFaults& faults,
    std::vector<OpenBagFile>& files,
    const std::function<void(const BagTopic&, const BagMessage&, std::uint32_t)>& take);

/// Reads all messages of bags that are parts of one recording. What they are is counted in the
/// report. @throws LogError naming the file where one cannot be opened or is no bag.
BagContents Survey(std::span<const std::filesystem::path> paths,
                   LogReport& report,
                   BagFaults& faults);

/// The bytes of a message behind the compression that rosbag2 may give each.
/// @throws MessageError where it is damaged.
std::string_view PlainMessage(std::string_view bytes, std::string& buffer);

}  // namespace qwsm::io
