// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/bag_maker.hpp"

#include <bzlib.h>
#include <lz4frame.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>

#include "service/io/bags/containers/chunk_codec.hpp"
#include "service/io/bags/writing/cdr_writer.hpp"
#include "service/io/bags/writing/ros_encoding.hpp"
#include "service/io/files/binary.hpp"
#include "service/io/journal/sqlite_database.hpp"

namespace qwsm::test {
namespace {

using io::BinaryWriter;
using std::literals::operator""sv;

std::string PackedWith(std::string_view compression, const std::string& bytes) {
  if (compression == "zstd") return io::CompressZstd(bytes);
  if (compression == "lz4") {
    std::string packed(LZ4F_compressFrameBound(bytes.size(), nullptr), '\0');
    packed.resize(
        LZ4F_compressFrame(packed.data(), packed.size(), bytes.data(), bytes.size(), nullptr));
    return packed;
  }
  if (compression == "bz2") {
    auto size = static_cast<unsigned>(bytes.size() + bytes.size() / 50 + 1000);
    std::string packed(size, '\0');
    BZ2_bzBuffToBuffCompress(packed.data(),
                             &size,
                             const_cast<char*>(bytes.data()),
                             static_cast<unsigned>(bytes.size()),
                             9,
                             0,
                             0);
    packed.resize(size);
    return packed;
  }
  return bytes;
}

/// The same fields in either serialisation.
class Fields {
 public:
  explicit Fields(Ros ros) : ros_(ros) {}

  template <class Number>
  void Add(Number value) {
    ros_ == Ros::k1 ? ros1_.Add(value) : cdr_.Add(value);
  }
  void AddBytes(std::string_view bytes) {
    ros_ == Ros::k1 ? ros1_.AddBytes(bytes) : cdr_.AddBytes(bytes);
  }
  void AddHeader(Timestamp stamp, const std::string& frame) {
    const auto seconds = std::chrono::floor<std::chrono::seconds>(stamp);
    if (ros_ == Ros::k1) Add(std::uint32_t{7});  // Sequence number.
    Add(static_cast<std::uint32_t>(seconds.count()));
    Add(static_cast<std::uint32_t>((stamp - seconds).count()));
    Add(std::string_view(frame));
  }
  void AddTransform(const io::Transform3& transform) {
    for (const double value : {transform.x_m, transform.y_m, transform.z_m}) Add(value);
    const Quaternion& q = transform.rotation;
    for (const double value : {q.x, q.y, q.z, q.w}) Add(value);
  }
  const std::string& bytes() const { return ros_ == Ros::k1 ? ros1_.bytes() : cdr_.bytes(); }

 private:
  Ros ros_;
  BinaryWriter ros1_;
  io::CdrWriter cdr_;
};

std::string TypeIn(Ros ros, const std::string& package, const std::string& name) {
  return package + (ros == Ros::k1 ? "/" : "/msg/") + name;
}

std::string NumberBytes(double value, const CloudForm& form) {
  std::string bytes(form.is_double ? sizeof(double) : sizeof(float), '\0');
  const auto single = static_cast<float>(value);
  std::memcpy(
      bytes.data(), form.is_double ? static_cast<const void*>(&value) : &single, bytes.size());
  if (form.is_big_endian) std::ranges::reverse(bytes);
  return bytes;
}

/// The data of a cloud, row after row.
std::string CloudData(std::span<const std::array<double, 3>> points_m, const CloudForm& form) {
  std::string data;
  const std::size_t columns = points_m.size() / form.rows;
  for (std::size_t i = 0; i < points_m.size(); ++i) {
    for (const double value_m : points_m[i]) data += NumberBytes(value_m, form);
    data += NumberBytes(0.5, form);  // Intensity.
    if (form.rows > 1 && (i + 1) % columns == 0) data += "row";
  }
  return data;
}

using HeaderFields = std::vector<std::pair<std::string_view, std::string>>;

std::string U32(std::uint32_t value) {
  BinaryWriter bytes;
  bytes.Add(value);
  return bytes.bytes();
}

std::string FieldList(const HeaderFields& fields) {
  BinaryWriter bytes;
  for (const auto& [name, value] : fields) {
    bytes.Add(std::string_view(std::string(name) + "=" + value));
  }
  return bytes.bytes();
}

std::string Ros1Record(const HeaderFields& header, std::string_view body) {
  BinaryWriter record;
  record.Add(std::string_view(FieldList(header)));
  record.Add(body);
  return record.bytes();
}

std::string McapRecord(std::uint8_t opcode, std::string_view body) {
  BinaryWriter record;
  record.Add(opcode);
  record.Add(static_cast<std::uint64_t>(body.size()));
  record.AddBytes(body);
  return record.bytes();
}

/// A message, and before the first of its topic what declares it.
std::string McapRecords(const MadeMessage& message, std::map<std::string, std::uint16_t>& topics) {
  std::string records;
  const auto [topic, is_new] =
      topics.try_emplace(message.topic, static_cast<std::uint16_t>(topics.size() + 1));
  if (is_new) {
    BinaryWriter schema;
    schema.Add(topic->second);
    schema.Add(std::string_view(message.type));
    schema.Add("ros2msg"sv);
    schema.Add(""sv);
    BinaryWriter channel;
    channel.Add(topic->second);
    channel.Add(topic->second);
    channel.Add(std::string_view(message.topic));
    channel.Add("cdr"sv);
    channel.Add(""sv);
    records = McapRecord(3, schema.bytes()) + McapRecord(4, channel.bytes());
  }
  BinaryWriter body;
  body.Add(topic->second);
  body.Add(std::uint32_t{0});
  body.Add(std::uint64_t{1});
  body.Add(std::uint64_t{1});
  body.AddBytes(message.bytes);
  return records + McapRecord(5, body.bytes());
}

}  // namespace

MadeMessage ScanMessage(Ros ros,
                        const std::string& topic,
                        Timestamp stamp,
                        const std::string& frame,
                        const std::vector<float>& ranges_m,
                        float time_step_s) {
  constexpr float kStep_rad = 0.1F;
  Fields fields(ros);
  fields.AddHeader(stamp, frame);
  const auto span = kStep_rad * static_cast<float>(ranges_m.size() - 1);
  for (const float value : {-1.0F, -1.0F + span, kStep_rad, time_step_s, 0.0F, 0.1F, 30.0F}) {
    fields.Add(value);
  }
  fields.Add(static_cast<std::uint32_t>(ranges_m.size()));
  for (const float range_m : ranges_m) fields.Add(range_m);
  fields.Add(std::uint32_t{0});
  return {topic, TypeIn(ros, "sensor_msgs", "LaserScan"), fields.bytes()};
}

MadeMessage OdometryMessageOf(Ros ros,
                              const std::string& topic,
                              Timestamp stamp,
                              const std::string& child,
                              const Pose2& pose) {
  Fields fields(ros);
  fields.AddHeader(stamp, "odom");
  fields.Add(std::string_view(child));
  fields.AddTransform(io::Spatial(pose));
  for (int i = 0; i < 36 + 6 + 36; ++i) fields.Add(0.0);
  return {topic, TypeIn(ros, "nav_msgs", "Odometry"), fields.bytes()};
}

MadeMessage ImuMessageOf(Ros ros,
                         const std::string& topic,
                         Timestamp stamp,
                         const std::string& frame,
                         double turn_rate_rad_s,
                         const std::array<double, 3>& acceleration_mps2) {
  Fields fields(ros);
  fields.AddHeader(stamp, frame);
  for (int i = 0; i < 4 + 9 + 2; ++i) fields.Add(0.0);
  fields.Add(turn_rate_rad_s);
  for (int i = 0; i < 9; ++i) fields.Add(0.0);
  for (const double value : acceleration_mps2) fields.Add(value);
  for (int i = 0; i < 9; ++i) fields.Add(0.0);
  return {topic, TypeIn(ros, "sensor_msgs", "Imu"), fields.bytes()};
}

MadeMessage TransformMessageOf(Ros ros,
                               const std::string& topic,
                               Timestamp stamp,
                               const std::string& frame,
                               const std::string& child,
                               const io::Transform3& transform) {
  Fields fields(ros);
  fields.Add(std::uint32_t{1});
  fields.AddHeader(stamp, frame);
  fields.Add(std::string_view(child));
  fields.AddTransform(transform);
  return {topic, TypeIn(ros, "tf2_msgs", "TFMessage"), fields.bytes()};
}

MadeMessage CloudMessage(Ros ros,
                         const std::string& topic,
                         Timestamp stamp,
                         const std::string& frame,
                         std::span<const std::array<double, 3>> points_m,
                         const CloudForm& form) {
  const std::uint32_t number_bytes = form.is_double ? sizeof(double) : sizeof(float);
  const std::string data = CloudData(points_m, form);
  Fields fields(ros);
  fields.AddHeader(stamp, frame);
  fields.Add(form.rows);
  fields.Add(static_cast<std::uint32_t>(points_m.size() / form.rows));
  fields.Add(std::uint32_t{4});
  std::uint32_t offset = 0;
  for (const std::string_view name : {"x"sv, "y"sv, "z"sv, "intensity"sv}) {
    fields.Add(name);
    fields.Add(offset);
    fields.Add(static_cast<std::uint8_t>(form.is_double ? 8 : 7));
    fields.Add(std::uint32_t{1});
    offset += number_bytes;
  }
  fields.Add(static_cast<std::uint8_t>(form.is_big_endian ? 1 : 0));
  fields.Add(offset);
  fields.Add(static_cast<std::uint32_t>(data.size()) / form.rows);
  fields.Add(static_cast<std::uint32_t>(data.size()));
  fields.AddBytes(data);
  fields.Add(std::uint8_t{0});
  return {topic, TypeIn(ros, "sensor_msgs", "PointCloud2"), fields.bytes()};
}

std::string Ros1BagOf(std::span<const MadeMessage> messages,
                      std::string_view compression,
                      std::size_t messages_per_chunk) {
  const std::string magic = "#ROSBAG V2.0\n";
  std::string bag;
  std::string index;
  std::map<std::string, std::uint32_t> connections;
  std::string chunk;
  for (std::size_t i = 0; i < messages.size(); ++i) {
    const MadeMessage& message = messages[i];
    const auto [known, is_new] =
        connections.try_emplace(message.topic, static_cast<std::uint32_t>(connections.size()));
    const std::string connection = U32(known->second);
    if (is_new) {
      const std::string declared =
          Ros1Record({{"conn", connection}, {"op", "\x07"}, {"topic", message.topic}},
                     FieldList({{"topic", message.topic}, {"type", message.type}}));
      chunk += declared;
      index += declared;
    }
    chunk += Ros1Record({{"conn", connection}, {"op", "\x02"}, {"time", std::string(8, '\0')}},
                        message.bytes);
    if ((i + 1) % messages_per_chunk != 0 && i + 1 < messages.size()) continue;
    bag += compression == "unchunked"
               ? chunk
               : Ros1Record({{"compression", std::string(compression)},
                             {"op", "\x05"},
                             {"size", U32(static_cast<std::uint32_t>(chunk.size()))}},
                            PackedWith(compression, chunk));
    chunk.clear();
  }
  BinaryWriter end;
  end.Add(std::uint64_t{0});
  const auto head = [](const BinaryWriter& index_at) {
    return Ros1Record({{"index_pos", index_at.bytes()}, {"op", "\x03"}}, std::string(64, ' '));
  };
  BinaryWriter index_at;
  index_at.Add(static_cast<std::uint64_t>(magic.size() + head(end).size() + bag.size()));
  return magic + head(index_at) + bag + index;
}

std::string McapOf(std::span<const MadeMessage> messages,
                   std::string_view compression,
                   std::size_t messages_per_chunk) {
  std::string file = "\x89MCAP0\r\n";
  BinaryWriter header;
  header.Add("ros2"sv);
  header.Add("a test"sv);
  file += McapRecord(1, header.bytes());
  std::map<std::string, std::uint16_t> topics;
  std::string chunk;
  for (std::size_t i = 0; i < messages.size(); ++i) {
    chunk += McapRecords(messages[i], topics);
    if ((i + 1) % messages_per_chunk != 0 && i + 1 < messages.size()) continue;
    const std::string packed = PackedWith(compression, chunk);
    BinaryWriter record;
    record.Add(std::uint64_t{1});
    record.Add(std::uint64_t{1});
    record.Add(static_cast<std::uint64_t>(chunk.size()));
    record.Add(io::Checksum(chunk));
    record.Add(compression);
    record.Add(static_cast<std::uint64_t>(packed.size()));
    record.AddBytes(packed);
    file += compression == "unchunked" ? chunk : McapRecord(6, record.bytes());
    chunk.clear();
  }
  return file;
}

void WriteDb3(const std::filesystem::path& file,
              std::span<const MadeMessage> messages,
              int schema,
              bool packs_messages) {
  io::SqliteDatabase database(file, io::SqliteDatabase::Access::kReadWrite);
  const std::string hash = schema >= 4 ? ", type_description_hash TEXT" : "";
  const std::string qos = schema >= 2 ? ", offered_qos_profiles TEXT" : "";
  database.Execute(
      "PRAGMA synchronous = OFF; PRAGMA journal_mode = OFF;"
      "CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT, type TEXT, "
      "serialization_format TEXT" +
      qos + hash +
      ");"
      "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER, timestamp INTEGER, "
      "data BLOB);"
      "CREATE INDEX timestamp_idx ON messages(timestamp ASC);");
  if (schema >= 3) {
    database.Execute(
        "CREATE TABLE schema(schema_version INTEGER, ros_distro TEXT);"
        "INSERT INTO schema VALUES(" +
        std::to_string(schema) + ", '');");
  }
  std::map<std::string, std::int64_t> topics;
  for (const MadeMessage& message : messages) {
    const auto [topic, is_new] =
        topics.try_emplace(message.topic, static_cast<std::int64_t>(topics.size() + 1));
    if (is_new) {
      io::SqliteStatement entry = database.Prepare(
          "INSERT INTO topics(id, name, type, serialization_format) VALUES(?, ?, ?, 'cdr')");
      entry.Bind(1, topic->second);
      entry.Bind(2, message.topic);
      entry.Bind(3, message.type);
      entry.Step();
    }
    io::SqliteStatement row =
        database.Prepare("INSERT INTO messages(topic_id, timestamp, data) VALUES(?, 1, ?)");
    row.Bind(1, topic->second);
    row.BindBlob(2, packs_messages ? io::CompressZstd(message.bytes) : message.bytes);
    row.Step();
  }
}

void WriteBytes(const std::filesystem::path& file, std::string_view bytes) {
  std::ofstream stream(file, std::ios::binary | std::ios::trunc);
  stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

std::string ReadBytes(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace qwsm::test
