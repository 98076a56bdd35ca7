// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The relations metric against an independent program: the Python script that stands beside the
// data.
#include "qwsm/metrics/relations.hpp"

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

namespace qwsm {
namespace {

const std::filesystem::path kData = QWSM_DATA_DIR;
const std::filesystem::path kRelationsFile = kData / "radish/intel.relations";
const std::filesystem::path kTrajectoryFile = kData / "radish/intel.gmapping.tum";
const std::filesystem::path kScriptFolder = kData.parent_path() / "tools";

// What the script prints for `lookup_arguments`, the tolerance in seconds and whether to take the
// nearest pose: used and skipped relations, then mean and standard deviation of the translation in
// m, its square, the rotation in degrees and its square, then median, 95th percentile and maximum.
std::string Script(const std::string& lookup_arguments) {
  return R"(
import math, sys
sys.path.insert(0, ')" +
         kScriptFolder.string() + R"(')
import relations_eval as R
poses = []
for line in open(')" +
         kTrajectoryFile.string() + R"('):
    w = line.split()
    if w[0][0] != '#':
        poses.append((float(w[0]), float(w[1]), float(w[2]), 2 * math.atan2(float(w[6]), float(w[7]))))
poses.sort(key=lambda pose: pose[0])
E = R.evaluate(R.load_rel(')" +
         kRelationsFile.string() + "'), poses, " + lookup_arguments + R"()
square = lambda v: [x * x for x in v]
print(E['n'], E['skipped'], *R.stats(E['t']), *R.stats(square(E['t'])), *R.stats(E['r']),
      *R.stats(square(E['r'])), R.pct(E['t'], .5), R.pct(E['t'], .95), max(E['t']))
)";
}

struct ClosePipe {
  void operator()(FILE* pipe) const { pclose(pipe); }
};

// The numbers that `program` prints; none where Python or the script is missing.
std::vector<double> RunPython(const std::string& program) {
  const std::string test = testing::UnitTest::GetInstance()->current_test_info()->name();
  const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / (test + ".py");
  std::ofstream(file) << program;
  const std::string command = "python3 -B '" + file.string() + "'";
  const std::unique_ptr<FILE, ClosePipe> pipe(popen(command.c_str(), "r"));
  std::string output;
  std::array<char, 256> chunk{};
  while (pipe && std::fgets(chunk.data(), chunk.size(), pipe.get()) != nullptr) {
    output += chunk.data();
  }
  std::istringstream words(output);
  std::vector<double> numbers;
  for (double number = 0.0; words >> number;) numbers.push_back(number);
  return numbers;
}

Timestamp FromSeconds(double seconds) { return Timestamp(std::llround(seconds * 1e9)); }

// The numbers of every line that is not a comment.
std::vector<std::array<double, 8>> Rows(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::vector<std::array<double, 8>> rows;
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::array<double, 8> row{};
    for (double& number : row) words >> number;
    if (words) rows.push_back(row);
  }
  return rows;
}

Trajectory ReadTrajectory() {
  Trajectory trajectory;
  for (const auto& [t, x, y, z, qx, qy, qz, qw] : Rows(kTrajectoryFile)) {
    trajectory.push_back({FromSeconds(t), {x, y, NormalizeAngle(2.0 * std::atan2(qz, qw))}});
  }
  return trajectory;
}

std::vector<Relation> ReadRelations() {
  std::vector<Relation> relations;
  for (const auto& [t1, t2, x, y, z, roll, pitch, yaw] : Rows(kRelationsFile)) {
    relations.push_back({FromSeconds(t1), FromSeconds(t2), {x, y, NormalizeAngle(yaw)}});
  }
  return relations;
}

void ExpectAgreement(const RelationsOptions& options, const std::string& lookup_arguments) {
  if (!std::filesystem::exists(kRelationsFile)) GTEST_SKIP() << "no " << kRelationsFile;
  const std::vector<double> script = RunPython(Script(lookup_arguments));
  if (script.empty()) GTEST_SKIP() << "Python 3 or the script of the data is missing";
  ASSERT_EQ(script.size(), 13U);

  const RelationsResult result = EvaluateRelations(ReadRelations(), ReadTrajectory(), options);
  EXPECT_EQ(static_cast<double>(result.all.translation_m.count), script[0]);
  EXPECT_EQ(static_cast<double>(result.skipped), script[1]);
  const RelationsSummary& all = result.all;
  const double degrees2 = RadiansToDegrees(RadiansToDegrees(1.0));
  const std::vector<double> ours = {all.translation_m.mean,
                                    all.translation_m.standard_deviation,
                                    all.translation_squared_m2.mean,
                                    all.translation_squared_m2.standard_deviation,
                                    RadiansToDegrees(all.rotation_rad.mean),
                                    RadiansToDegrees(all.rotation_rad.standard_deviation),
                                    all.rotation_squared_rad2.mean * degrees2,
                                    all.rotation_squared_rad2.standard_deviation * degrees2,
                                    all.translation_m.upper_median,
                                    all.translation_m.percentile_95,
                                    all.translation_m.max};
  for (std::size_t i = 0; i < ours.size(); ++i) EXPECT_NEAR(ours[i], script[i + 2], 1e-4) << i;
}

TEST(Relations, OfNearestPosesAgreeWithTheScript) {
  ExpectAgreement({.lookup = PoseLookup::kNearest, .tolerance = std::chrono::microseconds(600)},
                  "0.0006, True");
}

TEST(Relations, OfInterpolatedPosesAgreeWithTheScript) {
  ExpectAgreement({.lookup = PoseLookup::kInterpolated, .tolerance = std::chrono::milliseconds(50)},
                  "0.05, False");
}

}  // namespace
}  // namespace qwsm
