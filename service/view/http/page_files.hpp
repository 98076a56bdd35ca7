// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string_view>

namespace qwsm::view {

/// A file of the page, which is a part of the program.
struct PageFile {
  std::string_view path;  ///< Such as `/index.html`.
  std::string_view content;
};

/// All files of service/view/page.
std::span<const PageFile> PageFiles();

}  // namespace qwsm::view
