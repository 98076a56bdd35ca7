// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/bags/containers/mcap_file.hpp"

#include <algorithm>
#include <cstring>

#include "service/io/bags/containers/chunk_codec.hpp"
#include "service/io/bags/containers/mcap_format.hpp"
#include "service/io/files/binary.hpp"

namespace qwsm::io {
namespace {

constexpr std::size_t kRecordHead = 9;  // Opcode and length.
constexpr std::size_t kChunkHead = 40;  // Fields of a chunk but the name of its compression.
constexpr std::size_t kFooterSize = 20;
constexpr std::size_t kLongestName = 8;
constexpr std::uint64_t kMostRecordBytes = std::uint64_t{256} << 20;
constexpr std::uint64_t kDirect = ~std::uint64_t{0};  // An address outside of all chunks.

bool DescribesTopic(std::uint8_t opcode) {
  return opcode == mcap::kSchema || opcode == mcap::kChannel;
}

struct ChunkFields {
  std::uint64_t plain_size = 0;
  std::uint32_t checksum = 0;
  std::string_view compression;
  std::uint64_t size = 0;
};

ChunkFields TakeChunkFields(BinaryReader& fields) {
  fields.Unsigned64();  // Times of the first and last message.
  fields.Unsigned64();
  ChunkFields chunk;
  chunk.plain_size = fields.Unsigned64();
  chunk.checksum = fields.Unsigned32();
  chunk.compression = fields.Text();
  chunk.size = fields.Unsigned64();
  return chunk;
}

std::uint64_t LengthOfRecord(std::string_view head) {
  return BinaryReader(head.substr(1)).Unsigned64();
}

}  // namespace

bool McapFile::Recognizes(std::string_view first_bytes) {
  return first_bytes.starts_with(mcap::kMagic);
}

McapFile::McapFile(const std::filesystem::path& path, TellDamage tell)
    : ChunkedBag(path, std::move(tell), mcap::kMagic.size()) {
  ReadSummary();
}

/// Takes the channels at the end of the file: they are known even where their chunk is damaged.
void McapFile::ReadSummary() {
  constexpr std::uint64_t kEnd = kRecordHead + kFooterSize + mcap::kMagic.size();
  if (file_.size() < kEnd) return;
  const std::uint64_t end = file_.size() - kEnd;
  const std::string_view footer = file_.At(end, kRecordHead + kFooterSize);
  if (static_cast<std::uint8_t>(footer[0]) != mcap::kFooter) return;
  std::uint64_t offset = BinaryReader(footer.substr(kRecordHead)).Unsigned64();
  while (offset >= next_ && offset < end) {
    const std::string_view head = file_.At(offset, kRecordHead);
    if (offset + kRecordHead > end) return;
    const auto opcode = static_cast<std::uint8_t>(head[0]);
    const std::uint64_t length = LengthOfRecord(head);
    if (length > end - offset - kRecordHead || !DescribesTopic(opcode)) return;
    const std::string_view body = file_.At(offset + kRecordHead, static_cast<std::size_t>(length));
    Take({.opcode = opcode, .body = body}, {offset, kDirect});
    offset += kRecordHead + length;
  }
}

std::optional<BagMessage> McapFile::NextInChunk() {
  const std::uint64_t offset = chunk_->offset;
  const std::string& bytes = chunks_.At(offset);
  while (chunk_->next + kRecordHead <= bytes.size()) {
    const std::size_t at = chunk_->next;
    const std::string_view rest = std::string_view(bytes).substr(at);
    const std::uint64_t length = LengthOfRecord(rest);
    if (length > rest.size() - kRecordHead) {
      tell_(offset, "a record of a chunk is longer than what is left of the chunk");
      break;
    }
    chunk_->next += kRecordHead + static_cast<std::size_t>(length);
    const Record record{.opcode = static_cast<std::uint8_t>(rest[0]),
                        .body = rest.substr(kRecordHead, static_cast<std::size_t>(length))};
    if (std::optional<BagMessage> message = Take(record, {offset, at})) return message;
  }
  chunk_.reset();
  return std::nullopt;
}

std::optional<BagMessage> McapFile::NextInFile() {
  const std::uint64_t offset = next_;
  const std::string_view head = file_.At(offset, kRecordHead);
  if (head.size() < kRecordHead) {
    tell_(offset, "the file is cut off");
    ended_ = true;
    return std::nullopt;
  }
  const auto opcode = static_cast<std::uint8_t>(head[0]);
  const std::uint64_t length = LengthOfRecord(head);
  if (opcode == mcap::kDataEnd || opcode == mcap::kFooter) {
    ended_ = true;
    return std::nullopt;
  }
  const bool fits = length <= file_.size() - offset - kRecordHead;
  if (opcode == 0 || (!fits && opcode != mcap::kChunk)) {
    GoAround(offset, "the file is cut off here, or damaged");
    return std::nullopt;
  }
  if (opcode == mcap::kChunk) {
    chunk_ = Chunk{.offset = offset};
    if (!fits) {
      GoAround(offset, "the file is cut off within this chunk, or the chunk is damaged");
      return std::nullopt;
    }
  }
  next_ = offset + kRecordHead + length;
  if (!DescribesTopic(opcode) && opcode != mcap::kMessage) return std::nullopt;
  if (length > kMostRecordBytes) {
    tell_(offset, "a record of more than 256 MB is passed over");
    return std::nullopt;
  }
  const std::string_view body = file_.At(offset + kRecordHead, static_cast<std::size_t>(length));
  return Take({.opcode = opcode, .body = body}, {offset, kDirect});
}

std::optional<BagMessage> McapFile::Take(const Record& record, const MessageAddress& address) {
  try {
    if (record.opcode == mcap::kSchema) TakeSchema(record.body);
    if (record.opcode == mcap::kChannel) TakeChannel(record.body);
    if (record.opcode == mcap::kMessage) return TakeMessage(record.body, address);
  } catch (const BinaryError&) {
    tell_(address.container, "a record is too short for what it says to hold");
  }
  return std::nullopt;
}

void McapFile::TakeSchema(std::string_view body) {
  BinaryReader fields(body);
  const std::uint16_t id = fields.Unsigned16();
  types_.try_emplace(id, PlainTypeName(fields.Text()));
}

void McapFile::TakeChannel(std::string_view body) {
  BinaryReader fields(body);
  const std::uint16_t id = fields.Unsigned16();
  const std::uint16_t schema = fields.Unsigned16();
  const std::string_view name = fields.Text();
  const std::string_view encoding = fields.Text();
  std::optional<std::size_t>& topic = channels_[id];
  if (topic) return;  // Chunks repeat the channels they use.
  topic = topics_.size();
  topics_.push_back({.name = std::string(name),
                     .type = types_[schema],
                     .encoding = encoding == "cdr"    ? Encoding::kCdr
                                 : encoding == "ros1" ? Encoding::kRos1
                                                      : Encoding::kOther});
}

std::optional<BagMessage> McapFile::TakeMessage(std::string_view body,
                                                const MessageAddress& address) {
  BinaryReader fields(body);
  const auto channel = channels_.find(fields.Unsigned16());
  fields.Unsigned32();  // Sequence number.
  fields.Unsigned64();  // Times of logging and publishing.
  fields.Unsigned64();
  if (channel == channels_.end()) {
    tell_(address.container, "a message belongs to a channel that was not declared");
    return std::nullopt;
  }
  return BagMessage{
      .topic = *channel->second, .address = address, .bytes = fields.Bytes(fields.remaining())};
}

std::string_view McapFile::Read(const MessageAddress& address) {
  constexpr std::size_t kMessageHead = 22;
  if (address.at == kDirect) {
    const auto length = LengthOfRecord(file_.At(address.container, kRecordHead));
    return file_.At(address.container + kRecordHead, static_cast<std::size_t>(length))
        .substr(kMessageHead);
  }
  const std::string_view rest = std::string_view(chunks_.At(address.container)).substr(address.at);
  return rest.substr(kRecordHead, static_cast<std::size_t>(LengthOfRecord(rest)))
      .substr(kMessageHead);
}

/// The plain bytes of a chunk, or as many as are good. What is wrong is told each time it is read.
std::string McapFile::LoadChunk(std::uint64_t offset) {
  try {
    const std::uint64_t length = LengthOfRecord(file_.At(offset, kRecordHead));
    const std::uint64_t taken = std::min(length, kMostRecordBytes);
    BinaryReader fields(file_.At(offset + kRecordHead, static_cast<std::size_t>(taken)));
    const ChunkFields chunk = TakeChunkFields(fields);
    const std::string_view bytes =
        fields.Bytes(std::min<std::uint64_t>(chunk.size, fields.remaining()));
    PlainChunk plain = Decompress(chunk.compression, bytes);
    if (!plain.problem.empty()) tell_(offset, "a chunk is damaged: " + plain.problem);
    // Once all was seen, messages are only read again: that takes as long as all the rest.
    const bool is_new_and_whole =
        !ended_ && plain.problem.empty() && plain.bytes.size() == chunk.plain_size;
    if (is_new_and_whole && chunk.checksum != 0 && Checksum(plain.bytes) != chunk.checksum) {
      tell_(offset, "a chunk does not have its checksum: some of it may be wrong");
    }
    return std::move(plain.bytes);
  } catch (const BinaryError&) {
    tell_(offset, "a chunk is too short for what it says to hold");
    return {};
  }
}

/// Whether a chunk can begin here: its lengths agree with each other.
bool McapFile::IsChunk(std::uint64_t offset, std::string_view start) const {
  try {
    BinaryReader fields(start);
    if (fields.Unsigned8() != mcap::kChunk) return false;
    const std::uint64_t length = fields.Unsigned64();
    if (length < kChunkHead || length > file_.size() - offset - kRecordHead) return false;
    const ChunkFields chunk = TakeChunkFields(fields);
    if (chunk.size != length - kChunkHead - chunk.compression.size()) return false;
    if (chunk.compression.empty()) return chunk.plain_size == chunk.size;
    return chunk.compression == "zstd" || chunk.compression == "lz4";
  } catch (const BinaryError&) {
    return false;
  }
}

std::optional<std::uint64_t> McapFile::FindChunk(std::uint64_t from) {
  constexpr std::size_t kHead = kRecordHead + kChunkHead + kLongestName;
  constexpr std::size_t kPiece = std::size_t{1} << 17;
  for (std::uint64_t begin = from; begin < file_.size(); begin += kPiece) {
    const std::string_view piece = file_.At(begin, kPiece + kHead);
    for (std::size_t i = 0; i < std::min(piece.size(), kPiece); ++i) {
      if (piece[i] != mcap::kChunk) continue;
      if (IsChunk(begin + i, piece.substr(i, kHead))) return begin + i;
    }
  }
  return std::nullopt;
}

}  // namespace qwsm::io
