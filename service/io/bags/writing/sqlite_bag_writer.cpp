// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/bags/writing/sqlite_bag_writer.hpp"

#include "service/io/bags/writing/message_definitions.hpp"

namespace qwsm::io {
namespace {

constexpr const char* kTables = R"(
PRAGMA journal_mode = MEMORY;
PRAGMA synchronous = OFF;
CREATE TABLE schema(schema_version INTEGER PRIMARY KEY, ros_distro TEXT NOT NULL);
INSERT INTO schema VALUES(4, '');
CREATE TABLE metadata(id INTEGER PRIMARY KEY, metadata_version INTEGER NOT NULL,
                      metadata TEXT NOT NULL);
CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL,
                    serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL,
                    type_description_hash TEXT NOT NULL);
CREATE TABLE message_definitions(id INTEGER PRIMARY KEY, topic_type TEXT NOT NULL,
                                 encoding TEXT NOT NULL,
                                 encoded_message_definition TEXT NOT NULL,
                                 type_description_hash TEXT NOT NULL);
CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL,
                      timestamp INTEGER NOT NULL, data BLOB NOT NULL);
BEGIN;
)";

// What is lost of a recording that cannot go on.
constexpr std::uint64_t kMessagesPerTransaction = 1000;

SqliteDatabase WithTables(const std::filesystem::path& file) {
  SqliteDatabase database(file, SqliteDatabase::Access::kReadWrite);
  database.Execute(kTables);
  return database;
}

}  // namespace

SqliteBagWriter::SqliteBagWriter(const std::filesystem::path& file)
    : database_(WithTables(file)),
      insert_(
          database_.Prepare("INSERT INTO messages(topic_id, timestamp, data) VALUES(?, ?, ?)")) {}

std::size_t SqliteBagWriter::AddTopic(const TopicToWrite& topic) {
  summary_.topics.push_back({.topic = topic, .messages = 0});
  SqliteStatement entry = database_.Prepare("INSERT INTO topics VALUES(?, ?, ?, 'cdr', ?, ?)");
  entry.Bind(1, static_cast<std::int64_t>(summary_.topics.size()));
  entry.Bind(2, topic.name);
  entry.Bind(3, topic.type);
  entry.Bind(4, QosOf(topic));
  entry.Bind(5, TypeHash(topic.type));
  entry.Step();
  SqliteStatement definition = database_.Prepare(
      "INSERT INTO message_definitions(topic_type, encoding, encoded_message_definition, "
      "type_description_hash) SELECT ?1, 'ros2msg', ?2, ?3 "
      "WHERE NOT EXISTS (SELECT 1 FROM message_definitions WHERE topic_type = ?1)");
  definition.Bind(1, topic.type);
  definition.Bind(2, MessageDefinition(topic.type));
  definition.Bind(3, TypeHash(topic.type));
  definition.Step();
  return summary_.topics.size() - 1;
}

void SqliteBagWriter::Write(std::size_t topic, Timestamp stamp, std::string_view cdr) {
  insert_.Bind(1, static_cast<std::int64_t>(topic + 1));
  insert_.Bind(2, std::int64_t{stamp.count()});
  insert_.BindBlob(3, cdr);
  insert_.Step();
  insert_.Reset();
  summary_.Count(topic, stamp);
  if (summary_.messages % kMessagesPerTransaction == 0) database_.Execute("COMMIT; BEGIN;");
}

void SqliteBagWriter::Finish(const std::string& file_name) {
  SqliteStatement entry = database_.Prepare("INSERT INTO metadata VALUES(1, 5, ?)");
  entry.Bind(1, MetadataYaml(summary_, storage(), file_name));
  entry.Step();
  database_.Execute("CREATE INDEX timestamp_idx ON messages(timestamp ASC); COMMIT;");
}

}  // namespace qwsm::io
