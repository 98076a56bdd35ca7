// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/files/byte_source.hpp"

#include <algorithm>
#include <array>
#include <boost/iostreams/categories.hpp>
#include <boost/iostreams/filter/bzip2.hpp>
#include <boost/iostreams/filter/gzip.hpp>
#include <boost/iostreams/filter/lzma.hpp>
#include <boost/iostreams/filter/zstd.hpp>
#include <boost/iostreams/filtering_streambuf.hpp>
#include <stdexcept>
#include <string_view>

namespace qwsm::io {
namespace {

namespace bio = boost::iostreams;
using std::literals::operator""sv;

constexpr std::size_t kMagicBytes = 6;
constexpr std::streamsize kDecodedBytes = 4096;  // At most so much good text is lost at a damage.

std::string CompressionOf(std::string_view first_bytes) {
  if (first_bytes.starts_with("\x1f\x8b"sv)) return "gzip";
  if (first_bytes.starts_with("BZh"sv)) return "bzip2";
  if (first_bytes.starts_with("\xfd\x37\x7a\x58\x5a\0"sv)) return "xz";
  if (first_bytes.starts_with("\x28\xb5\x2f\xfd"sv)) return "zstd";
  return "none";
}

}  // namespace

/// The stream as it is, first bytes included, counted.
class ByteSource::Input {
 public:
  explicit Input(std::istream& stream) : stream_(&stream) {
    stream_->read(first_bytes_.data(), kMagicBytes);
    first_count_ = static_cast<std::size_t>(stream_->gcount());
  }

  std::string_view first_bytes() const { return {first_bytes_.data(), first_count_}; }
  std::uint64_t bytes_read() const { return bytes_read_; }

  std::size_t Read(std::span<char> buffer) {
    const std::size_t kept = std::min(first_count_ - first_given_, buffer.size());
    std::copy_n(
        first_bytes_.begin() + static_cast<std::ptrdiff_t>(first_given_), kept, buffer.begin());
    first_given_ += kept;
    stream_->read(buffer.data() + kept, static_cast<std::streamsize>(buffer.size() - kept));
    const std::size_t count = kept + static_cast<std::size_t>(stream_->gcount());
    if (stream_->bad()) throw std::runtime_error("the file cannot be read on (input/output error)");
    bytes_read_ += count;
    return count;
  }

 private:
  std::istream* stream_;
  std::array<char, kMagicBytes> first_bytes_{};
  std::size_t first_count_ = 0;
  std::size_t first_given_ = 0;
  std::uint64_t bytes_read_ = 0;
};

namespace {

/// Boost's view of Input: a device that only refers to it, as Boost copies its devices.
template <class Input>
class InputDevice {
 public:
  using char_type = char;
  using category = bio::source_tag;

  explicit InputDevice(Input& input) : input_(&input) {}

  std::streamsize read(char* buffer, std::streamsize size) {
    const std::size_t count = input_->Read({buffer, static_cast<std::size_t>(size)});
    return count == 0 ? -1 : static_cast<std::streamsize>(count);
  }

 private:
  Input* input_;
};

}  // namespace

struct ByteSource::State {
  explicit State(std::istream& stream)
      : input(stream), compression(CompressionOf(input.first_bytes())) {
    if (compression == "gzip") decoder.push(bio::gzip_decompressor(), kDecodedBytes);
    if (compression == "bzip2") decoder.push(bio::bzip2_decompressor(), kDecodedBytes);
    if (compression == "xz") decoder.push(bio::lzma_decompressor(), kDecodedBytes);
    if (compression == "zstd") decoder.push(bio::zstd_decompressor(), kDecodedBytes);
    if (compression != "none") decoder.push(InputDevice<Input>(input));
  }

  Input input;
  std::string compression;
  bio::filtering_istreambuf decoder;
};

ByteSource::ByteSource(std::istream& stream) : state_(std::make_unique<State>(stream)) {}
ByteSource::ByteSource(ByteSource&&) noexcept = default;
ByteSource::~ByteSource() = default;

const std::string& ByteSource::compression() const { return state_->compression; }
std::uint64_t ByteSource::bytes_read() const { return state_->input.bytes_read(); }

std::size_t ByteSource::Read(std::span<char> buffer) {
  if (state_->compression == "none") return state_->input.Read(buffer);
  try {
    // One decoded piece at a time: a larger read would lose the good pieces before a damage.
    if (state_->decoder.sgetc() == std::char_traits<char>::eof()) return 0;
    const auto size =
        std::min(state_->decoder.in_avail(), static_cast<std::streamsize>(buffer.size()));
    return static_cast<std::size_t>(state_->decoder.sgetn(buffer.data(), size));
  } catch (const std::ios_base::failure& failure) {
    throw std::runtime_error("the " + state_->compression + " archive is truncated or corrupt (" +
                             failure.what() +
                             "); what stands before the damage was read; copy the file again");
  }
}

}  // namespace qwsm::io
