// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <array>
#include <boost/iostreams/filter/bzip2.hpp>
#include <boost/iostreams/filter/gzip.hpp>
#include <boost/iostreams/filter/lzma.hpp>
#include <boost/iostreams/filtering_stream.hpp>
#include <functional>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "service/io/files/byte_source.hpp"

namespace qwsm::io {
namespace {

namespace bio = boost::iostreams;

template <class Compressor>
std::string Compress(const std::string& text) {
  std::ostringstream out;
  bio::filtering_ostream stream;
  stream.push(Compressor());
  stream.push(out);
  stream << text;
  stream.reset();
  return out.str();
}

/// Text that does not shrink much, so that an archive of it has many blocks.
std::string NumbersText() {
  std::mt19937 random(7);
  std::string text;
  for (int i = 0; i < 50'000; ++i) text += std::to_string(random()) + "\n";
  return text;
}

struct Decompressed {
  std::string text;
  std::string error;
  std::string compression;
};

Decompressed ReadAll(const std::string& bytes) {
  std::istringstream stream(bytes);
  ByteSource source(stream);
  Decompressed result{.text = {}, .error = {}, .compression = source.compression()};
  std::array<char, 10'000> buffer{};
  try {
    while (const std::size_t count = source.Read(buffer)) result.text.append(buffer.data(), count);
  } catch (const std::runtime_error& error) {
    result.error = error.what();
  }
  EXPECT_LE(source.bytes_read(), bytes.size());
  return result;
}

struct Archiver {
  std::string name;
  std::function<std::string(const std::string&)> compress;
};

const std::vector<Archiver> kArchivers{{"gzip", Compress<bio::gzip_compressor>},
                                       {"bzip2", Compress<bio::bzip2_compressor>},
                                       {"xz", Compress<bio::lzma_compressor>}};

TEST(ByteSource, GivesPlainBytesAsTheyAre) {
  for (const std::string text : {"", "a", "plain text, longer than any magic number"}) {
    const Decompressed result = ReadAll(text);
    EXPECT_EQ(result.text, text);
    EXPECT_EQ(result.compression, "none");
    EXPECT_EQ(result.error, "");
  }
}

TEST(ByteSource, DecompressesWhatItRecognises) {
  const std::string text = NumbersText();
  for (const auto& [name, compress] : kArchivers) {
    SCOPED_TRACE(name);
    const Decompressed result = ReadAll(compress(text));
    EXPECT_EQ(result.compression, name);
    EXPECT_EQ(result.text, text);
    EXPECT_EQ(result.error, "");
  }
}

TEST(ByteSource, ReadsArchivesThatWereJoined) {
  for (const auto& [name, compress] : kArchivers) {
    SCOPED_TRACE(name);
    EXPECT_EQ(ReadAll(compress("one\n") + compress("two\n")).text, "one\ntwo\n");
  }
}

TEST(ByteSource, GivesWhatStandsBeforeTheCutOfAnArchive) {
  const std::string text = NumbersText();
  for (const auto& [name, compress] : kArchivers) {
    SCOPED_TRACE(name);
    const std::string archive = compress(text);
    const Decompressed result = ReadAll(archive.substr(0, archive.size() - 10));
    EXPECT_TRUE(result.error.find("truncated or corrupt") != std::string::npos) << result.error;
    EXPECT_TRUE(text.starts_with(result.text));
    if (name != "bzip2") {  // One block of bzip2 holds it all.
      EXPECT_GT(result.text.size(), text.size() / 2);
    }
  }
}

TEST(ByteSource, SaysWhereAnArchiveIsDamaged) {
  const std::string text = NumbersText();
  for (const auto& [name, compress] : kArchivers) {
    SCOPED_TRACE(name);
    std::string archive = compress(text);
    for (std::size_t i = 0; i < 20; ++i) archive[archive.size() / 2 + i] ^= 0x55;
    EXPECT_NE(ReadAll(archive).error, "");
  }
}

}  // namespace
}  // namespace qwsm::io
