// SPDX-License-Identifier: BSD-3-Clause
#ifndef Targets_h
#define Targets_h

#include <hwy/targets.h>

namespace bench
{

/// While it lives, vectors are no wider than AVX2's: what processors without AVX-512 do.
class OnlyAVX2
{
public:
  /// Whether there is anything to be restricted.
  static bool Matters()
  {
#if HWY_ARCH_X86
    return (hwy::SupportedTargets() & HWY_AVX2) != 0 &&
      (hwy::SupportedTargets() & (HWY_AVX3 | HWY_AVX3_DL)) != 0;
#else
    return false;
#endif
  }

  OnlyAVX2()
  {
#if HWY_ARCH_X86
    hwy::SetSupportedTargetsForTest(HWY_AVX2 | HWY_SSE4 | HWY_SSSE3);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
#endif
  }
  ~OnlyAVX2()
  {
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  }
  OnlyAVX2(const OnlyAVX2&) = delete;
  void operator=(const OnlyAVX2&) = delete;
};

}

#endif
