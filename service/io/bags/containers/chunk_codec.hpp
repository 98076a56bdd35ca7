// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace qwsm::io {

/// What was got out of a chunk.
struct PlainChunk {
  std::string bytes;    ///< All, or those before the damage.
  std::string problem;  ///< What is wrong; empty where nothing is.
};

/// Undoes the compression of a chunk: "" or "none", "zstd", "lz4" or "bz2".
PlainChunk Decompress(std::string_view compression, std::string_view bytes);

/// Whether bytes begin as those of zstd do.
bool IsZstd(std::string_view bytes);

/// Compresses with zstd.
std::string CompressZstd(std::string_view bytes);

}  // namespace qwsm::io
