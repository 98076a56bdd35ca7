// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Whatever number an option is given, it is one that somebody thought of.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <variant>

#include "service/config/options_io.hpp"
#include "service/config/scenario_file.hpp"
#include "service/options/program_options.hpp"
#include "service/options/slam6d/program_options.hpp"
#include "sim/scenario.hpp"

namespace qwsm::config {
namespace {

void ExpectBounds(OptionGroup group, const std::string& path) {
  for (Field& field : group.fields) {
    const std::string name = path + field.name;
    if (auto* inner = std::get_if<OptionGroup>(&field.value)) {
      ExpectBounds(*inner, name + ".");
    } else if (auto* list = std::get_if<ListField>(&field.value)) {
      ExpectBounds(list->example(), name + "[].");
    } else if (std::holds_alternative<double*>(field.value) ||
               std::holds_alternative<AngleField>(field.value)) {
      EXPECT_TRUE(std::isfinite(field.min) && std::isfinite(field.max)) << name;
    }
  }
}

template <class Options>
void ExpectBoundsOf() {
  Options options;
  ExpectBounds(GroupOf(options), "");
}

TEST(OptionBounds, EveryNumberHasALeastAndAMost) {
  ExpectBoundsOf<options::ProgramOptions>();
  ExpectBoundsOf<slam6d::options::ProgramOptions>();
  ExpectBoundsOf<sim::ScenarioOptions>();
}

}  // namespace
}  // namespace qwsm::config
