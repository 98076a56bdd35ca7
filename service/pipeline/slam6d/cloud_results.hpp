// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <mutex>
#include <string>

#include "service/pipeline/results/results_folder.hpp"
#include "service/pipeline/slam6d/registration.hpp"
#include "service/team/service/cloud_service.hpp"

namespace slam6d::pipeline {

/// Leaves what `slam6d register` leaves but its report, for every robot of a team. A robot without
/// a namespace has the folder itself, others a folder of their name in it. Keeps all points until
/// Finish().
class CloudResults final : public qwsm::team::CloudSink {
 public:
  CloudResults(const qwsm::pipeline::ResultsFolder& folder,
               const options::RegistrationOptions& options)
      : folder_(folder), options_(options) {}

  void TakeAnswer(const qwsm::team::CloudAnswer& answer) override { Keep(answer); }
  void TakeRestored(const qwsm::team::CloudAnswer& answer) override { Keep(answer); }

  /// Fits the scans to each other, if that is wanted, and writes the results.
  /// @pre the service has stopped.
  /// @throws qwsm::io::WriteError.
  void Finish(qwsm::team::CloudService& service);

 private:
  void Keep(const qwsm::team::CloudAnswer& answer);

  const qwsm::pipeline::ResultsFolder folder_;
  const options::RegistrationOptions options_;
  std::mutex mutex_;
  std::map<std::string, Registration, std::less<>> robots_;
};

}  // namespace slam6d::pipeline
