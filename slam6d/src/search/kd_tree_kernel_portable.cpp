// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "slam6d/src/search/kd_tree_kernel.hpp"

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace slam6d {
namespace {
#include "slam6d/src/search/sum_pairs.inc"
}  // namespace

extern const KdTreeKernel kPortableKernel;
const KdTreeKernel kPortableKernel{.search = Search,
                                   .lengthen_paths = LengthenPaths,
                                   .search_range = SearchRange,
                                   .sum_pairs = SumPairs};

}  // namespace slam6d
