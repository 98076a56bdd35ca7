// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/apps/slam6d/scan_arguments.hpp"

#include <algorithm>
#include <memory>
#include <set>

#include "service/pipeline/text/messages.hpp"

namespace slam6d::apps {

void AddScanArguments(CLI::App& parser,
                      std::vector<std::filesystem::path>& scans,
                      qwsm::config::OptionSources& sources) {
  parser.add_option("SCANS", scans, "folders of scans, files or bags, in their order")
      ->required()
      ->type_name("");
  using qwsm::apps::AddBagSetting;
  AddBagSetting(
      parser, sources, "--points", "bag.points", "topic of clouds; else that with the most");
  AddBagSetting(
      parser, sources, "--odom", "bag.odometry", "topic of odometry, or /tf; else chosen");
  AddBagSetting(parser, sources, "--every", "bag.every", "of so many clouds one is taken; else all")
      ->type_name("N");
}

std::vector<pipeline::ScanPlace> FindScans(const std::vector<std::filesystem::path>& scans,
                                           const io::CloudBagOptions& options) {
  std::vector<pipeline::ScanPlace> places = pipeline::FindScans(
      scans, options, [](const std::string& problem) { qwsm::messages::Warn(problem); });
  const bool is_asked = !options.points.empty() || !options.odometry.empty() || options.every > 1;
  const auto is_of_bag = [](const pipeline::ScanPlace& place) { return place.bag != nullptr; };
  if (is_asked && std::ranges::none_of(places, is_of_bag)) {
    qwsm::messages::Warn(
        "--points, --odom and --every choose from a bag, and none is given: all files are taken, "
        "and poses beside them; name the files that are meant, and odometry by --poses");
  }
  return places;
}

void TellOfBags(const std::vector<pipeline::ScanPlace>& places) {
  std::set<std::shared_ptr<io::CloudBag>> told;
  for (const pipeline::ScanPlace& place : places) {
    if (!place.bag || !told.insert(place.bag).second) continue;
    for (const std::string& note : place.bag->notes()) {
      qwsm::messages::Info("{}: {}", place.bag->name(), note);
    }
  }
}

}  // namespace slam6d::apps
