// SPDX-License-Identifier: BSD-3-Clause
#include "LargePages.h"

#ifdef __linux__
#include <cstdint>

#include <sys/mman.h>
#endif

namespace relief
{

void UseLargePages(void* memory, std::size_t bytes)
{
#if defined(__linux__) && defined(MADV_HUGEPAGE)
  const auto address = reinterpret_cast<std::uintptr_t>(memory);
  const std::uintptr_t first = (address + LargePage - 1) / LargePage * LargePage;
  const std::uintptr_t last = (address + bytes) / LargePage * LargePage;
  if (last > first)
  {
    // A wish: where it is not granted, pages are small.
    madvise(static_cast<unsigned char*>(memory) + (first - address), last - first, MADV_HUGEPAGE);
  }
#else
  static_cast<void>(memory);
  static_cast<void>(bytes);
#endif
}

}
