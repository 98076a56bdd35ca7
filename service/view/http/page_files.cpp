// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/view/http/page_files.hpp"

#include <array>

namespace qwsm::view {
namespace {

#define QWSM_FILE(file_path, file_content) PageFile{.path = file_path, .content = file_content},

constexpr auto kPageFiles = std::to_array<PageFile>({
#include "page_files.inc"
});

#undef QWSM_FILE

}  // namespace

std::span<const PageFile> PageFiles() { return kPageFiles; }

}  // namespace qwsm::view
