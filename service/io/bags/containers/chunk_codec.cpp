// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/bags/containers/chunk_codec.hpp"

#include <bzlib.h>
#include <lz4frame.h>
#include <zstd.h>

#include <memory>
#include <new>
#include <stdexcept>

namespace qwsm::io {
namespace {

using std::literals::operator""sv;

// No writer makes chunks of more; archives that grow beyond it are attacks.
constexpr std::size_t kMostChunkBytes = std::size_t{256} << 20;
constexpr std::size_t kPieceBytes = std::size_t{128} << 10;
constexpr int kZstdLevel = 1;  // Scans are mostly noise: higher levels take time and win little.

constexpr const char* kCutOff = "its compressed bytes end too early";
constexpr const char* kTooLarge = "it grows beyond 256 MB";

std::string Corrupt(const char* reason) {
  return std::string("its compressed bytes are damaged (") + reason + ")";
}

PlainChunk Unzstd(std::string_view bytes) {
  const std::unique_ptr<ZSTD_DStream, decltype(&ZSTD_freeDStream)> stream(ZSTD_createDStream(),
                                                                          &ZSTD_freeDStream);
  PlainChunk chunk;
  std::string piece(kPieceBytes, '\0');
  ZSTD_inBuffer in{bytes.data(), bytes.size(), 0};
  std::size_t left = 1;
  while (left != 0 && chunk.problem.empty()) {
    ZSTD_outBuffer out{piece.data(), piece.size(), 0};
    left = ZSTD_decompressStream(stream.get(), &out, &in);
    if (ZSTD_isError(left) != 0) {
      chunk.problem = Corrupt(ZSTD_getErrorName(left));
      break;
    }
    chunk.bytes.append(piece, 0, out.pos);
    if (left != 0 && in.pos == in.size && out.pos < out.size) chunk.problem = kCutOff;
    if (chunk.bytes.size() > kMostChunkBytes) chunk.problem = kTooLarge;
  }
  return chunk;
}

PlainChunk Unlz4(std::string_view bytes) {
  LZ4F_dctx* made = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&made, LZ4F_VERSION)) != 0) {
    throw std::bad_alloc();
  }
  const std::unique_ptr<LZ4F_dctx, decltype(&LZ4F_freeDecompressionContext)> context(
      made, &LZ4F_freeDecompressionContext);
  PlainChunk chunk;
  std::string piece(kPieceBytes, '\0');
  std::size_t left = 1;
  while (left != 0 && chunk.problem.empty()) {
    std::size_t out = piece.size();
    std::size_t in = bytes.size();
    left = LZ4F_decompress(context.get(), piece.data(), &out, bytes.data(), &in, nullptr);
    if (LZ4F_isError(left) != 0) {
      chunk.problem = Corrupt(LZ4F_getErrorName(left));
      break;
    }
    chunk.bytes.append(piece, 0, out);
    bytes.remove_prefix(in);
    if (left != 0 && in == 0 && out == 0) chunk.problem = kCutOff;
    if (chunk.bytes.size() > kMostChunkBytes) chunk.problem = kTooLarge;
  }
  return chunk;
}

PlainChunk Unbzip2(std::string_view bytes) {
  bz_stream stream{};
  if (BZ2_bzDecompressInit(&stream, 0, 0) != BZ_OK) throw std::bad_alloc();
  const std::unique_ptr<bz_stream, decltype(&BZ2_bzDecompressEnd)> end(&stream,
                                                                       &BZ2_bzDecompressEnd);
  PlainChunk chunk;
  std::string piece(kPieceBytes, '\0');
  stream.next_in = const_cast<char*>(bytes.data());  // It is only read.
  stream.avail_in = static_cast<unsigned>(bytes.size());
  int state = BZ_OK;
  while (state == BZ_OK && chunk.problem.empty()) {
    stream.next_out = piece.data();
    stream.avail_out = static_cast<unsigned>(piece.size());
    state = BZ2_bzDecompress(&stream);
    chunk.bytes.append(piece, 0, piece.size() - stream.avail_out);
    const bool is_starved = state == BZ_OK && stream.avail_in == 0 && stream.avail_out > 0;
    if (is_starved) chunk.problem = kCutOff;
    if (chunk.bytes.size() > kMostChunkBytes) chunk.problem = kTooLarge;
  }
  if (state != BZ_OK && state != BZ_STREAM_END) chunk.problem = Corrupt("bzip2");
  return chunk;
}

}  // namespace

PlainChunk Decompress(std::string_view compression, std::string_view bytes) {
  if (compression.empty() || compression == "none") {
    return {.bytes = std::string(bytes), .problem = {}};
  }
  if (compression == "zstd") return Unzstd(bytes);
  if (compression == "lz4") return Unlz4(bytes);
  if (compression == "bz2") return Unbzip2(bytes);
  return {.bytes = {}, .problem = "its compression is unknown: none, zstd, lz4 and bz2 are read"};
}

bool IsZstd(std::string_view bytes) { return bytes.starts_with("\x28\xB5\x2F\xFD"sv); }

std::string CompressZstd(std::string_view bytes) {
  std::string compressed(ZSTD_compressBound(bytes.size()), '\0');
  const std::size_t size =
      ZSTD_compress(compressed.data(), compressed.size(), bytes.data(), bytes.size(), kZstdLevel);
  if (ZSTD_isError(size) != 0) throw std::runtime_error(ZSTD_getErrorName(size));
  compressed.resize(size);
  return compressed;
}

}  // namespace qwsm::io
