// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/eigen.h>

#include <stdexcept>
#include <string>
#include <string_view>

#include "python/src/qwsm/bindings.hpp"
#include "qwsm/geometry/position.hpp"
#include "qwsm/match_scans.hpp"

namespace qwsm::python {

namespace py = pybind11;

namespace {

constexpr const char* kMatchScans =
    "Where `scan` was taken, seen from where `reference` was: weighted matching of two scans "
    "(Pfister et al. 2002) after a search around the guess.\n\n"
    "A guess without covariance may be off by 0.3 m and 10 degrees (one sigma); searched is up to "
    "three of each. The answer is to be trusted where its status is 'converged'. Raises ValueError "
    "where the guess can be no pose of a robot.";

void CheckGuess(const UncertainPose2& guess) {
  const std::string_view objection = ObjectionTo(guess);
  if (!objection.empty()) throw std::invalid_argument("guess: " + std::string(objection));
}

MatchResult MatchUncertain(const LaserScan& reference,
                           const LaserScan& scan,
                           const UncertainPose2& guess) {
  CheckGuess(guess);
  return MatchScans(reference, scan, guess);
}

MatchResult MatchNear(const LaserScan& reference, const LaserScan& scan, const Pose2& guess) {
  CheckGuess({.T_a_b = guess});
  return MatchScans(reference, scan, guess);
}

}  // namespace

void AddMatching(py::module_& module) {
  py::class_<MatchResult>(
      module,
      "MatchResult",
      "What a match found. T_ref_cur is the best pose so far, whatever the status.")
      .def_property_readonly(
          "status", [](const MatchResult& match) { return std::string(Name(match.status)); })
      .def_readonly("T_ref_cur", &MatchResult::T_ref_cur)
      .def_readonly("covariance",
                    &MatchResult::covariance,
                    "Covariance of (x, y, theta) in the answer, prior included: m^2, m rad, rad^2.")
      .def_readonly("pair_information",
                    &MatchResult::pair_information,
                    "Information about (x, y, theta) of the pairs alone, without the prior.")
      .def_readonly("iterations", &MatchResult::iterations)
      .def_readonly("pairs", &MatchResult::pairs)
      .def_readonly("mean_residual_m",
                    &MatchResult::mean_residual_m,
                    "Mean distance of a point to its nearest stored point.")
      .def_readonly("overlap",
                    &MatchResult::overlap,
                    "Share of the scan's points that agree with the reference.")
      .def_readonly("reduced_chi2",
                    &MatchResult::reduced_chi2,
                    "Mean squared error of the pairs in units of its modelled variance.");

  const py::call_guard<py::gil_scoped_release> without_gil;
  module.def("match_scans",
             &MatchUncertain,
             py::arg("reference"),
             py::arg("scan"),
             py::arg("guess"),
             without_gil,
             kMatchScans);
  module.def("match_scans",
             &MatchNear,
             py::arg("reference"),
             py::arg("scan"),
             py::arg("guess") = Pose2(),
             without_gil,
             kMatchScans);
}

}  // namespace qwsm::python
