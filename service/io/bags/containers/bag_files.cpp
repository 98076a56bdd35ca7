// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/bags/containers/bag_files.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdlib>
#include <fstream>
#include <set>
#include <utility>

#include "service/io/bags/containers/mcap_file.hpp"
#include "service/io/bags/containers/ros1_bag.hpp"
#include "service/io/bags/containers/sqlite_bag.hpp"
#include "service/io/files/byte_source.hpp"
#include "service/io/files/file_error.hpp"
#include "service/io/files/numbered_name.hpp"

namespace qwsm::io {
namespace {

namespace fs = std::filesystem;
using std::literals::operator""sv;

constexpr std::size_t kMagicSize = 16;
constexpr std::string_view kSqliteMagic = "SQLite format 3\0"sv;
constexpr std::size_t kMostMetadataLines = 100'000;

enum class Container { kNone, kRos1, kMcap, kSqlite };

Container ContainerOf(std::string_view first_bytes) {
  if (Ros1Bag::Recognizes(first_bytes)) return Container::kRos1;
  if (McapFile::Recognizes(first_bytes)) return Container::kMcap;
  return first_bytes.starts_with(kSqliteMagic) ? Container::kSqlite : Container::kNone;
}

struct FirstBytes {
  std::string plain;
  std::string compression;
};

/// The first bytes of a file behind its compression; none where they cannot be had.
FirstBytes ReadFirstBytes(const fs::path& path) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return {};
  std::ifstream file(path, std::ios::binary);
  std::array<char, kMagicSize> bytes{};
  try {
    ByteSource source(file);
    std::size_t size = 0;
    while (size < bytes.size()) {
      const std::size_t count = source.Read(std::span(bytes).subspan(size));
      if (count == 0) break;
      size += count;
    }
    return {.plain = std::string(bytes.data(), size), .compression = source.compression()};
  } catch (const std::runtime_error&) {
    return {};  // The archive is damaged: whoever reads it as a text says so.
  }
}

bool IsBagFile(const fs::path& path) {
  const FirstBytes first = ReadFirstBytes(path);
  const Container container = ContainerOf(first.plain);
  if (container == Container::kSqlite && first.compression == "none") {
    return SqliteBag::Recognizes(path) || path.extension() == ".db3";
  }
  return container != Container::kNone;
}

/// The number at the end of a file's name, as in drive_12.db3.zstd.
std::uint64_t NumberInName(const fs::path& file) {
  const std::string name = file.filename().string();
  return NumberedName::Of(name.substr(0, name.find('.'))).Number().value_or(0);
}

std::vector<fs::path> BagFilesIn(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (IsBagFile(entry.path())) files.push_back(entry.path());
  }
  std::ranges::sort(files, {}, [](const fs::path& file) {
    return std::pair(NumberInName(file), file.filename().string());
  });
  return files;
}

/// A scalar as YAML writes simple ones, without quotes.
std::string Unquoted(std::string_view text) {
  while (!text.empty() && (text.back() == ' ' || text.back() == '\r')) text.remove_suffix(1);
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  const bool is_quoted = text.size() >= 2 && text.front() == text.back() &&
                         (text.front() == '"' || text.front() == '\'');
  return std::string(is_quoted ? text.substr(1, text.size() - 2) : text);
}

}  // namespace

/// Reads the lines that rosbag2 writes: the list `relative_file_paths` and the first
/// `message_count` one step inwards, which is that of the bag.
BagMetadata ReadMetadata(const fs::path& folder) {
  BagMetadata metadata;
  std::ifstream file(folder / "metadata.yaml");
  std::string line;
  bool in_files = false;
  for (std::size_t i = 0; i < kMostMetadataLines && std::getline(file, line); ++i) {
    const std::size_t start = line.find_first_not_of(' ');
    if (start == std::string::npos) continue;
    const std::string_view text = std::string_view(line).substr(start);
    if (in_files && text.starts_with("- ")) {
      metadata.files.push_back(Unquoted(text.substr(2)));
      continue;
    }
    in_files = text.starts_with("relative_file_paths:");
    if (start == 2 && text.starts_with("message_count:")) {
      const std::string count = Unquoted(text.substr(text.find(':') + 1));
      std::uint64_t value = 0;
      const auto end = std::from_chars(count.data(), count.data() + count.size(), value);
      if (end.ec == std::errc()) metadata.messages = value;
    }
  }
  return metadata;
}

bool IsBag(const fs::path& path) {
  std::error_code error;
  if (!fs::is_directory(path, error)) return IsBagFile(path);
  return fs::exists(path / "metadata.yaml", error) || !BagFilesIn(path).empty();
}

std::vector<fs::path> FilesOfBag(const fs::path& path,
                                 const std::function<void(const std::string&)>& tell) {
  if (!fs::is_directory(path)) return {path};
  std::vector<fs::path> files;
  for (const std::string& name : ReadMetadata(path).files) {
    // Older writers put the folder's own name before the file's.
    const fs::path file = path / fs::path(name).filename();
    if (IsBagFile(file)) {
      files.push_back(file);
    } else {
      tell("its metadata.yaml names " + name + ", which is missing or no bag; put it there");
    }
  }
  if (files.empty()) files = BagFilesIn(path);
  if (files.empty()) throw BagError("is a folder without a .db3 or .mcap file");
  return files;
}

/// A file that goes with its owner.
class OpenBagFile::TemporaryFile {
 public:
  TemporaryFile() {
    std::string name = (fs::temp_directory_path() / "qwsm-bag-XXXXXX").string();
    const int descriptor = mkstemp(name.data());
    if (descriptor < 0) throw std::runtime_error(name + ": cannot be created to unpack a bag");
    close(descriptor);
    path_ = name;
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() {
    std::error_code ignored;
    fs::remove(path_, ignored);
  }

  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

namespace {

/// Unpacks as much as is good.
void Unpack(const fs::path& archive,
            const fs::path& target,
            const MessageSource::TellDamage& tell) {
  std::ifstream packed = OpenForReading(archive);
  ByteSource source(packed);
  std::ofstream file(target, std::ios::binary | std::ios::trunc);
  std::vector<char> piece(1 << 16);
  try {
    while (const std::size_t count = source.Read(piece)) {
      file.write(piece.data(), static_cast<std::streamsize>(count));
    }
  } catch (const std::runtime_error& error) {
    tell(source.bytes_read(), error.what());
  }
  if (!file.flush()) {
    throw std::runtime_error(target.string() + ": cannot be written to unpack a bag; set TMPDIR");
  }
}

std::unique_ptr<MessageSource> OpenContainer(const fs::path& path, MessageSource::TellDamage tell) {
  switch (ContainerOf(ReadFirstBytes(path).plain)) {
    case Container::kRos1:
      return std::make_unique<Ros1Bag>(path, std::move(tell));
    case Container::kMcap:
      return std::make_unique<McapFile>(path, std::move(tell));
    case Container::kSqlite:
      return std::make_unique<SqliteBag>(path, std::move(tell));
    case Container::kNone:
      break;
  }
  throw BagError("is no bag: neither ROS 1 (2.0) nor rosbag2 (.db3, .mcap)");
}

}  // namespace

OpenBagFile::OpenBagFile(const fs::path& path, MessageSource::TellDamage tell) {
  try {
    compression_ = ReadFirstBytes(path).compression;
    if (compression_ != "none") {
      unpacked_ = std::make_unique<TemporaryFile>();
      Unpack(path, unpacked_->path(), tell);
    }
    source_ = OpenContainer(unpacked_ ? unpacked_->path() : path, std::move(tell));
  } catch (const BagError& error) {
    throw BagError(path.string() + ": " + error.what());
  } catch (const SqliteError& error) {
    throw BagError(path.string() + ": cannot be read: " + error.what());
  }
}

OpenBagFile::~OpenBagFile() = default;

std::string PlainTypeName(std::string_view type) {
  std::string name(type);
  const std::size_t middle = name.find("/msg/");
  if (middle != std::string::npos) name.erase(middle, std::string_view("/msg").size());
  return name;
}

}  // namespace qwsm::io
