// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sim/layouts/place.hpp"
#include "sim/random.hpp"

namespace sim {

/// Buildings in rows with streets between and around them, trees and lamp posts on both sides of
/// every street.
struct CampusOptions {
  int columns = 3;  ///< Columns of buildings.
  int rows = 2;
  double block_length_m = 60.0;  ///< Distance from one street to the next.
  double block_width_m = 50.0;
  double street_width_m = 12.0;
  double post_spacing_m = 14.0;  ///< Distance of trees and lamp posts along a street.
};

template <class Visitor>
void Describe(Visitor& visit, CampusOptions& o) {
  visit("columns", o.columns, {.help = "buildings in a row", .min = 1, .max = 50});
  visit("rows", o.rows, {.help = "rows of buildings", .min = 1, .max = 50});
  visit(
      "block_length_m", o.block_length_m, {.help = "between streets, in x", .min = 20, .max = 500});
  visit("block_width_m", o.block_width_m, {.help = "between streets, in y", .min = 20, .max = 500});
  visit("street_width_m", o.street_width_m, {.help = "between buildings", .min = 6, .max = 100});
  visit("post_spacing_m",
        o.post_spacing_m,
        {.help = "between the trees and posts of a street", .min = 2, .max = 500});
}

template <class Report>
void Validate(const CampusOptions& o, Report& report) {
  const double shorter_m = o.block_length_m < o.block_width_m ? o.block_length_m : o.block_width_m;
  if (o.street_width_m + 5.0 > shorter_m) {
    report("street_width_m", "leaves no room for houses");
  }
}

/// Makes a campus. The way goes round every block of the campus, row by row, so that streets are
/// driven again and again; the origin is in the middle.
Place MakeCampus(const CampusOptions& options, RandomEngine& random);

}  // namespace sim
