// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace qwsm::python {

namespace py = pybind11;

/// Numbers as C++ wants them: taken as they are where the array has the type and lies in one piece,
/// copied and converted otherwise.
template <class Number>
using ArrayOf = py::array_t<Number, py::array::c_style | py::array::forcecast>;

/// A view of part of every item of a vector, such as the poses of a trajectory: nothing is copied,
/// and the owner lives as long as the view. It cannot be written to.
/// @param member of the first item; null where there is none.
/// @param shape of what is seen of one item.
template <class Item, class Number>
py::array ViewOf(const std::vector<Item>& items,
                 const Number* member,
                 const std::vector<py::ssize_t>& shape,
                 py::handle owner) {
  std::vector<py::ssize_t> sizes{static_cast<py::ssize_t>(items.size())};
  sizes.insert(sizes.end(), shape.begin(), shape.end());
  std::vector<py::ssize_t> strides(sizes.size(), sizeof(Number));
  for (std::size_t i = shape.size(); i-- > 1;) strides[i] = strides[i + 1] * sizes[i + 1];
  strides[0] = sizeof(Item);
  py::array view(py::dtype::of<Number>(), sizes, strides, member, owner);
  view.attr("flags").attr("writeable") = false;
  return view;
}

/// Refuses what is not a list of points or poses. @throws std::invalid_argument
template <class Number>
void CheckColumns(const ArrayOf<Number>& rows, py::ssize_t columns, const std::string& name) {
  if (rows.ndim() == 2 && rows.shape(1) == columns) return;
  std::string shape;
  for (py::ssize_t i = 0; i < rows.ndim(); ++i) {
    shape += (i == 0 ? "" : ", ") + std::to_string(rows.shape(i));
  }
  throw std::invalid_argument(name + " must be an array of shape (n, " + std::to_string(columns) +
                              "), not (" + shape + ")");
}

}  // namespace qwsm::python
