// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "qwsm/sensor/laser_scan.hpp"
#include "service/io/bags/messages/transform3.hpp"

/// Bags as others write them: variants that our own writers do not have.
namespace qwsm::test {

/// A message to be put into a bag.
struct MadeMessage {
  std::string topic;
  std::string type;  ///< As the bag's ROS writes it.
  std::string bytes;
};

/// Which ROS serialises: ROS 1 without alignment, ROS 2 in CDR.
enum class Ros { k1, k2 };

MadeMessage ScanMessage(Ros ros,
                        const std::string& topic,
                        Timestamp stamp,
                        const std::string& frame,
                        const std::vector<float>& ranges_m,
                        float time_step_s = 0.0F);
MadeMessage OdometryMessageOf(Ros ros,
                              const std::string& topic,
                              Timestamp stamp,
                              const std::string& child,
                              const Pose2& pose);
MadeMessage ImuMessageOf(Ros ros,
                         const std::string& topic,
                         Timestamp stamp,
                         const std::string& frame,
                         double turn_rate_rad_s,
                         const std::array<double, 3>& acceleration_mps2 = {});
MadeMessage TransformMessageOf(Ros ros,
                               const std::string& topic,
                               Timestamp stamp,
                               const std::string& frame,
                               const std::string& child,
                               const io::Transform3& transform);

/// How a cloud is laid out: as drivers do it, an intensity stands behind each point.
struct CloudForm {
  bool is_double = false;      ///< Coordinates of 64 bits instead of 32.
  bool is_big_endian = false;  ///< Of the data; the message around it stays as it is.
  std::uint32_t rows = 1;      ///< With some bytes between them where there are several.
};

/// A sensor_msgs/PointCloud2. @pre the points fill the rows.
MadeMessage CloudMessage(Ros ros,
                         const std::string& topic,
                         Timestamp stamp,
                         const std::string& frame,
                         std::span<const std::array<double, 3>> points_m,
                         const CloudForm& form = {});

/// A bag of ROS 1, chunks packed with "none", "bz2" or "lz4"; "unchunked" puts messages outside of
/// chunks. Of the index at its end there are the connections.
std::string Ros1BagOf(std::span<const MadeMessage> messages,
                      std::string_view compression,
                      std::size_t messages_per_chunk = 2);

/// An MCAP file, chunks packed with "", "lz4" or "zstd"; "unchunked" puts messages outside of
/// chunks. It has neither index nor summary.
std::string McapOf(std::span<const MadeMessage> messages,
                   std::string_view compression,
                   std::size_t messages_per_chunk = 2);

/// A database of rosbag2 of schema 1 to 4, each message packed with zstd where asked for.
void WriteDb3(const std::filesystem::path& file,
              std::span<const MadeMessage> messages,
              int schema,
              bool packs_messages = false);

void WriteBytes(const std::filesystem::path& file, std::string_view bytes);
std::string ReadBytes(const std::filesystem::path& file);

}  // namespace qwsm::test
