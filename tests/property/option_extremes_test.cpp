// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Whatever bound of whatever option is used, a small drive is mapped in reasonable time.
#include <gtest/gtest.h>

#include <ctime>
#include <functional>
#include <random>
#include <string>
#include <variant>
#include <vector>

#include "service/config/options_io.hpp"
#include "service/options/program_options.hpp"
#include "tests/support/room_drive.hpp"

namespace qwsm::config {
namespace {

constexpr int kScans = 80;
// So many times the processor time of the defaults is reasonable.
constexpr double kMostSlowdown = 10.0;

double ProcessorTimeS() {
  return static_cast<double>(std::clock()) / static_cast<double>(CLOCKS_PER_SEC);
}

/// A drive whose readings are as noisy as real ones: maps of it have many points.
std::vector<Observation> NoisyDrive() {
  std::mt19937 random(3);
  std::normal_distribution<float> noise_m(0.0F, 0.01F);
  std::vector<Observation> drive;
  for (int scan = 0; scan < kScans; ++scan) {
    drive.push_back(test::ObservationInRoom(scan));
    for (float& range_m : drive.back().scan.ranges_m) range_m += noise_m(random);
  }
  return drive;
}

double SecondsToMap(const std::vector<Observation>& drive, const MapperOptions& options) {
  const double begin_s = ProcessorTimeS();
  Mapper mapper(options);
  for (const Observation& observation : drive) mapper.Process(observation);
  return ProcessorTimeS() - begin_s;
}

/// A number among the options, and how it is set.
struct Number {
  std::string name;
  double least = 0.0;
  double most = 0.0;
  std::function<void(double)> set;
};

void CollectNumbers(OptionGroup& group, const std::string& path, std::vector<Number>& numbers) {
  for (Field& field : group.fields) {
    const std::string name = path + field.name;
    Number number{.name = name, .least = field.min, .most = field.max, .set = {}};
    if (auto* inner = std::get_if<OptionGroup>(&field.value)) {
      CollectNumbers(*inner, name + ".", numbers);
    } else if (auto* const* real = std::get_if<double*>(&field.value)) {
      number.set = [value = *real](double to) { *value = to; };
    } else if (auto* angle = std::get_if<AngleField>(&field.value)) {
      number.set = [value = angle->value_rad](double to) { *value = to; };
    } else if (auto* const* whole = std::get_if<int*>(&field.value)) {
      number.set = [value = *whole](double to) { *value = static_cast<int>(to); };
    }
    if (number.set) numbers.push_back(std::move(number));
  }
}

TEST(OptionExtremes, NoneMakesMappingEndless) {
  options::ProgramOptions options;
  const MapperOptions defaults = options.mapper;
  OptionGroup group = GroupOf(options);
  std::vector<Number> numbers;
  CollectNumbers(std::get<OptionGroup>(group.Find("mapper")->value), "mapper.", numbers);
  ASSERT_GT(numbers.size(), 50U);
  const std::vector<Observation> drive = NoisyDrive();
  SecondsToMap(drive, defaults);  // Warms up.
  const double usual_s = SecondsToMap(drive, defaults);
  for (const Number& number : numbers) {
    for (const double bound : {number.least, number.most}) {
      number.set(bound);
      const double time_s = SecondsToMap(drive, options.mapper);
      EXPECT_LT(time_s, kMostSlowdown * usual_s) << number.name << " at " << bound;
      options.mapper = defaults;
    }
  }
}

}  // namespace
}  // namespace qwsm::config
