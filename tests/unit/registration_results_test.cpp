// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/slam6d/registration_results.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

#include "service/pipeline/slam6d/registration_page.hpp"
#include "tests/support/temporary_folder.hpp"

namespace slam6d::pipeline {
namespace {

RegisteredScan ScanNamed(const std::string& name, SlamStatus status) {
  RegisteredScan scan{.name = name, .file = {}, .T_odom_scan = {}, .cloud = {}, .step = {}};
  scan.step.status = status;
  return scan;
}

TEST(RegistrationResults, TellHowSurelyPosesAreKnown) {
  Registration registration;
  registration.scans = {ScanNamed("a", SlamStatus::kFirst), ScanNamed("b", SlamStatus::kMatched)};
  registration.T_map_scan.resize(2);
  SlamStep& step = registration.scans[1].step;
  step.open_motions = 2;
  step.covariance(0, 1) = step.covariance(1, 0) = 0.25;
  step.covariance(5, 5) = 4e-6;

  const qwsm::test::TemporaryFolder folder;
  WriteResults(
      registration, {}, qwsm::pipeline::ResultsFolder(folder.path() / "r", false), {false});
  std::ifstream table(folder.path() / "r" / "scans.csv");
  std::string header;
  std::string line;
  std::getline(table, header);
  for (int scan = 0; scan < 2; ++scan) std::getline(table, line);
  EXPECT_NE(header.find(",open_motions,cov_xx_m2,cov_xy_m2,"), std::string::npos) << header;
  EXPECT_NE(header.find(",cov_zyaw_m_rad,cov_rollroll_rad2,"), std::string::npos) << header;
  EXPECT_NE(line.find(",2,0,0.25,0,"), std::string::npos) << line;
  EXPECT_TRUE(line.ends_with(",0,4e-06")) << line;
  EXPECT_EQ(std::ranges::count(line, ','), std::ranges::count(header, ','));

  EXPECT_NE(SummaryText(registration).find("left open      1 of these"), std::string::npos);
  EXPECT_NE(MetricsOf(registration).Text().find("\"matched_with_open_motions\": 1"),
            std::string::npos);
}

TEST(RegistrationResults, QuoteNamesThatWouldBeTakenForSeveralColumns) {
  Registration registration;
  registration.scans = {ScanNamed("a, \"b\" 0", SlamStatus::kFirst)};
  registration.T_map_scan.resize(1);
  const qwsm::test::TemporaryFolder folder;
  WriteResults(
      registration, {}, qwsm::pipeline::ResultsFolder(folder.path() / "r", false), {false});
  std::ifstream table(folder.path() / "r" / "scans.csv");
  std::string line;
  for (int i = 0; i < 2; ++i) std::getline(table, line);
  EXPECT_TRUE(line.starts_with("0,\"a, \"\"b\"\" 0\",first,")) << line;
}

// Of coordinates in 16 bits.
TEST(RegistrationResults, HaveNoCoarserPageForAPointThatIsFarOff) {
  const auto step_of = [](bool with_stray) {
    Registration registration;
    registration.scans = {ScanNamed("a", SlamStatus::kFirst)};
    registration.T_map_scan.resize(1);
    PointCloud& cloud = registration.scans[0].cloud;
    for (int i = 0; i < 1000; ++i) cloud.push_back({0.01 * i, 1.0, 2.0});
    if (with_stray) cloud.push_back({1e5, 0.0, 0.0});
    const qwsm::test::TemporaryFolder folder;
    WriteRegistrationPage(folder.path() / "report.html", {}, registration);
    std::ifstream file(folder.path() / "report.html");
    const std::string page(std::istreambuf_iterator<char>(file), {});
    const std::size_t at = page.find("\"step_m\":");
    return at == std::string::npos ? std::string() : page.substr(at, page.find(',', at) - at);
  };
  EXPECT_FALSE(step_of(false).empty());
  EXPECT_EQ(step_of(true), step_of(false));
}

}  // namespace
}  // namespace slam6d::pipeline
