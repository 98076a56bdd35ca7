// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "service/apps/messages.hpp"
#include "service/apps/output.hpp"
#include "service/apps/slam6d/commands.hpp"
#include "service/apps/slam6d/scan_arguments.hpp"
#include "service/apps/version.hpp"
#include "service/io/files/atomic_file.hpp"
#include "service/options/slam6d/program_options.hpp"
#include "service/pipeline/run/interruption.hpp"
#include "service/pipeline/run/progress_display.hpp"
#include "service/pipeline/slam6d/registration_results.hpp"
#include "service/pipeline/text/messages.hpp"

namespace slam6d::apps {
namespace {

namespace fs = std::filesystem;
using options::RegistrationOptions;
using qwsm::pipeline::ResultFile;
using qwsm::pipeline::ResultsFolder;

struct RegisterArguments {
  std::vector<fs::path> scans;
  std::optional<fs::path> output;
  std::optional<fs::path> poses;
  std::optional<int> threads;
  qwsm::config::OptionSources sources;
  qwsm::apps::Verbosity verbosity;
  bool force = false;
  bool dry_run = false;
  bool no_pictures = false;
};

/// What is read; results are not to be put beside it.
std::vector<fs::path> InputsOf(const RegisterArguments& arguments) {
  std::vector<fs::path> inputs = arguments.scans;
  if (arguments.poses) inputs.push_back(*arguments.poses);
  return inputs;
}

ExitCode TellPlan(const std::vector<pipeline::ScanPlace>& places,
                  const RegisterArguments& arguments) {
  if (arguments.output) {
    ResultsFolder::Check(*arguments.output, arguments.force, InputsOf(arguments));
  }
  for (const pipeline::ScanPlace& place : places) {
    qwsm::apps::Print("would register {}\n", place.file.string());
  }
  qwsm::apps::Print("into {}\n", arguments.output.value_or("results/<time>").string());
  return ExitCode::kDone;
}

/// The folder of this run, with its messages and configuration recorded there.
ResultsFolder OpenResults(const RegisterArguments& arguments,
                          const options::ProgramOptions& options) {
  ResultsFolder folder =
      arguments.output ? ResultsFolder(*arguments.output, arguments.force, InputsOf(arguments))
                       : ResultsFolder::ForNow("results");
  qwsm::apps::CopyMessagesTo(folder / ResultFile::kLog);
  qwsm::messages::Info("version {}", qwsm::apps::Version());
  qwsm::io::WriteTextFile(folder / ResultFile::kConfig, qwsm::config::DumpOptions(options));
  return folder;
}

pipeline::RegistrationPictures PicturesOf(const RegisterArguments& arguments,
                                          const pipeline::Registration& registration) {
  qwsm::pipeline::RunTitle title{.command = "slam6d register",
                                 .version = std::string(qwsm::apps::Version()),
                                 .inputs = {},
                                 .interrupted = registration.interrupted};
  for (const fs::path& input : InputsOf(arguments)) title.inputs.push_back(input.string());
  return {.drawn = !arguments.no_pictures, .title = std::move(title)};
}

std::string ProgressText(double share,
                         const std::string& what,
                         std::chrono::duration<double> elapsed) {
  std::string text = fmt::format("register  {:2.0f} %  {}", 100.0 * share, what);
  if (share <= 0.0) return text;
  return text + "  ETA " + qwsm::pipeline::MinutesAndSeconds(elapsed.count() * (1.0 / share - 1.0));
}

pipeline::Registration Register(pipeline::ScanSeries& series,
                                const RegistrationOptions& options,
                                const qwsm::pipeline::Interruption& interruption,
                                const qwsm::apps::Verbosity& verbosity) {
  qwsm::pipeline::StatusLine line(verbosity.quiet ? qwsm::pipeline::ProgressStyle::kNone
                                                  : qwsm::pipeline::StyleFor(stderr));
  const pipeline::RegistrationObserver observer{
      .show =
          [&](double share, const std::string& what) {
            line.Show([&](std::chrono::duration<double> elapsed) {
              return ProgressText(share, what, elapsed);
            });
          },
      .warn =
          [&](const std::string& problem) {
            line.Clear();
            qwsm::messages::Warn(problem);
          },
      .should_stop = [&] { return interruption.requested(); }};
  return pipeline::RegisterSeries(series, options, observer);
}

void WarnOfDoubtfulScans(const pipeline::Registration& registration) {
  for (const pipeline::RegisteredScan& scan : registration.scans) {
    if (scan.step.status == SlamStatus::kDeadReckoned && scan.step.told == 0) {
      qwsm::messages::Warn(
          "{}: sees nothing where the scans before it do, so that nothing speaks for where it "
          "matches them; it is where odometry has it. Are its points in the scanner's frame?",
          scan.file.string());
    } else if (scan.step.status == SlamStatus::kDeadReckoned) {
      qwsm::messages::Warn(
          "{}: could not be registered with the scans before it ({}, overlap {:.0f} %, of which "
          "{:.0f} % contradicts them); it is where odometry has it",
          scan.file.string(),
          Name(scan.step.match.status),
          100.0 * scan.step.overlap,
          100.0 * scan.step.contradiction);
    } else if (scan.step.status == SlamStatus::kUnusable) {
      qwsm::messages::Warn(
          "{}: has fewer than three different points that count; it is where odometry has it",
          scan.file.string());
    }
  }
}

/// @throws qwsm::apps::UsageError where there is nothing to make a model of.
void CheckAnyUsable(const pipeline::Registration& registration) {
  const bool any = std::ranges::any_of(registration.scans, [](const auto& scan) {
    return scan.step.status != SlamStatus::kUnusable;
  });
  if (!any && !registration.interrupted) {
    throw qwsm::apps::UsageError("none of the scans has three different points that count");
  }
}

ExitCode RunRegister(const RegisterArguments& arguments) {
  qwsm::apps::StartMessages(arguments.verbosity);
  auto options = qwsm::config::LoadOptions<options::ProgramOptions>(arguments.sources);
  if (arguments.threads) options.slam.icp.threads = *arguments.threads;
  const std::vector<pipeline::ScanPlace> places = FindScans(arguments.scans, options.bag);
  const io::NumberedPoses starts =
      arguments.poses ? io::ReadPoses(*arguments.poses) : io::NumberedPoses{};
  if (arguments.dry_run) return TellPlan(places, arguments);

  const ResultsFolder folder = OpenResults(arguments, options);
  TellOfBags(places);
  const qwsm::pipeline::Interruption interruption;  // From here on there is something to keep.
  pipeline::ScanSeries series(places, starts, options);
  const pipeline::Registration registration =
      Register(series, options, interruption, arguments.verbosity);
  WarnOfDoubtfulScans(registration);
  CheckAnyUsable(registration);
  pipeline::WriteResults(registration, options, folder, PicturesOf(arguments, registration));
  const std::string summary = pipeline::SummaryText(registration);
  qwsm::messages::Info("\n{}", summary);
  if (arguments.verbosity.json) {
    qwsm::apps::Print("{}", pipeline::MetricsOf(registration).Text());
  } else if (!arguments.verbosity.quiet) {
    qwsm::apps::Print("{}results        {}\n", summary, folder.path().string());
  }
  return registration.interrupted || interruption.requested() ? ExitCode::kInterrupted
                                                              : ExitCode::kDone;
}

}  // namespace

Command AddRegisterCommand(CLI::App& program) {
  CLI::App* parser = AddParser(program, "register", "one consistent model from 3D scans");
  auto arguments = std::make_shared<RegisterArguments>();
  parser->footer(
      "  slam6d register dat/                              scans and poses of 3DTK\n"
      "  slam6d register dat/ --output courtyard           results in courtyard/\n"
      "  slam6d register *.pcd --poses odometry.tum        start poses from elsewhere\n"
      "  slam6d register drive.bag --every 10              PointCloud2 of ROS 1 or 2, and "
      "odometry\n"
      "  slam6d register dat/ --set slam.max_range_m=30    farther points are misses\n"
      "  slam6d register dat/ --set slam.icp.metric=point-to-point");
  AddScanArguments(*parser, arguments->scans, arguments->sources);
  parser
      ->add_option("-o,--output", arguments->output, "folder for the results; else results/<time>")
      ->type_name("DIR");
  parser
      ->add_option("--poses",
                   arguments->poses,
                   "poses to start from: TUM by scan number, or a folder of .pose or .frames")
      ->type_name("FILE");
  parser->add_option("--threads", arguments->threads, "changes no bit of the result")
      ->check(CLI::Range(1, 256));
  qwsm::apps::AddNoPictures(*parser, arguments->no_pictures);
  parser->add_flag("--force", arguments->force, "write into a folder that holds other things");
  parser->add_flag("-n,--dry-run", arguments->dry_run, "check the arguments, do nothing");
  qwsm::apps::AddConfiguration(*parser, arguments->sources);
  qwsm::apps::AddVerbosity(*parser, arguments->verbosity, "the figures as JSON on standard output");
  return {.parser = parser, .run = [arguments] { return RunRegister(*arguments); }};
}

}  // namespace slam6d::apps
