// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/bags/writing/bag_file.hpp"

#include "service/io/bags/writing/mcap_writer.hpp"
#include "service/io/bags/writing/sqlite_bag_writer.hpp"

namespace qwsm::io {
namespace {

namespace fs = std::filesystem;

std::unique_ptr<BagWriter> MakeWriter(BagFormat format, AtomicFile& file) {
  if (format == BagFormat::kMcap) return std::make_unique<McapWriter>(file.stream());
  return std::make_unique<SqliteBagWriter>(file.temporary_path());
}

/// The path without a slash at its end, behind which there would be no name.
fs::path Trimmed(const fs::path& path) { return path.has_filename() ? path : path.parent_path(); }

/// @return whether it was not there before.
bool MakeFolder(const fs::path& folder) {
  std::error_code error;
  const bool is_new = fs::create_directories(folder, error);
  if (error) throw WriteError(folder.string() + ": cannot be created: " + error.message());
  return is_new;
}

}  // namespace

std::optional<BagFormat> BagFormatOf(const fs::path& path) {
  if (path.extension() == ".mcap") return BagFormat::kMcap;
  if (path.extension() == ".db3") return BagFormat::kSqlite;
  return std::nullopt;
}

BagFile::BagFile(const fs::path& path, BagFormat format) : path_(Trimmed(path)) {
  if (!BagFormatOf(path_)) {
    folder_ = path_;
    has_made_folder_ = MakeFolder(folder_);
    path_ = folder_ /
            (folder_.filename().string() + (format == BagFormat::kMcap ? "_0.mcap" : "_0.db3"));
  }
  file_ = std::make_unique<AtomicFile>(path_);
  try {
    writer_ = MakeWriter(format, *file_);
  } catch (const SqliteError& error) {
    throw WriteError(path_.string() + ": cannot be written: " + error.what());
  }
}

BagFile::~BagFile() {
  writer_.reset();
  file_.reset();
  if (!has_made_folder_) return;
  std::error_code holds_a_bag;
  fs::remove(folder_, holds_a_bag);
}

void BagFile::Write(const TopicToWrite& topic, Timestamp stamp, std::string_view cdr) {
  try {
    auto known = topics_.find(topic.name);
    if (known == topics_.end()) {
      known = topics_.emplace(topic.name, writer_->AddTopic(topic)).first;
    }
    writer_->Write(known->second, stamp, cdr);
  } catch (const SqliteError& error) {
    throw WriteError(path_.string() + ": cannot be written: " + error.what());
  }
}

void BagFile::Commit() {
  const std::string name = path_.filename().string();
  std::string metadata;
  try {
    writer_->Finish(name);
    metadata = MetadataYaml(writer_->summary(), writer_->storage(), name);
    writer_.reset();  // Closes a database.
  } catch (const SqliteError& error) {
    throw WriteError(path_.string() + ": cannot be written: " + error.what());
  }
  file_->Commit();
  if (!folder_.empty()) WriteTextFile(folder_ / "metadata.yaml", metadata);
}

}  // namespace qwsm::io
