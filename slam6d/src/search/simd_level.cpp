// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "slam6d/search/simd_level.hpp"

#include "slam6d/src/search/kd_tree_kernel.hpp"

namespace slam6d {

extern const KdTreeKernel kPortableKernel;
#ifdef SLAM6D_X86_KERNELS
extern const KdTreeKernel kAvx2Kernel;
extern const KdTreeKernel kAvx512Kernel;
#endif

SimdLevel AvailableSimd(SimdLevel wanted) {
#ifdef SLAM6D_X86_KERNELS
  if (wanted >= SimdLevel::kAvx512 && __builtin_cpu_supports("avx512f") != 0) {
    return SimdLevel::kAvx512;
  }
  if (wanted >= SimdLevel::kAvx2 && __builtin_cpu_supports("avx2") != 0) return SimdLevel::kAvx2;
#else
  static_cast<void>(wanted);
#endif
  return SimdLevel::kPortable;
}

const KdTreeKernel& KernelFor(SimdLevel level) {
#ifdef SLAM6D_X86_KERNELS
  if (level == SimdLevel::kAvx512) return kAvx512Kernel;
  if (level == SimdLevel::kAvx2) return kAvx2Kernel;
#else
  static_cast<void>(level);
#endif
  return kPortableKernel;
}

}  // namespace slam6d
