// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/dds/gateway/raw_reader.hpp"

#include <dds/dds.h>
#include <dds/ddsi/ddsi_serdata.h>

#include <array>
#include <cstddef>

namespace qwsm::dds {
namespace {

constexpr std::size_t kRawBatch = 64;

/// Holds the bytes of a sample until nobody needs them.
class SerializedSample {
 public:
  /// Takes over a reference to the sample.
  explicit SerializedSample(ddsi_serdata* sample) : sample_(sample) {
    ddsi_serdata_to_ser_ref(sample_, 0, ddsi_serdata_size(sample_), &bytes_);
  }
  SerializedSample(const SerializedSample&) = delete;
  SerializedSample& operator=(const SerializedSample&) = delete;
  ~SerializedSample() {
    ddsi_serdata_to_ser_unref(sample_, &bytes_);
    ddsi_serdata_unref(sample_);
  }

  std::string_view bytes() const {
    return {static_cast<const char*>(bytes_.iov_base), bytes_.iov_len};
  }

 private:
  ddsi_serdata* sample_;
  ddsrt_iovec_t bytes_{};
};

}  // namespace

void RawReader::TakeAll(const std::function<void(RawSample)>& take) const {
  std::array<ddsi_serdata*, kRawBatch> samples{};
  std::array<dds_sample_info_t, kRawBatch> infos{};
  while (true) {
    const dds_return_t count =
        dds_takecdr(handle(), samples.data(), kRawBatch, infos.data(), DDS_ANY_STATE);
    if (count <= 0) return;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      const auto owner = std::make_shared<const SerializedSample>(samples[i]);
      // Only the state of a writer changed, or an instance was disposed of.
      if (!infos[i].valid_data) continue;
      take({.owner = owner,
            .cdr = owner->bytes(),
            .stamp_ns = static_cast<std::uint64_t>(infos[i].source_timestamp)});
    }
  }
}

}  // namespace qwsm::dds
