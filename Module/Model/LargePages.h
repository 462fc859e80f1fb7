// SPDX-License-Identifier: BSD-3-Clause
#ifndef LargePages_h
#define LargePages_h

#include <cstddef>

namespace relief
{

/// What large pages usually are, in bytes.
constexpr std::size_t LargePage = std::size_t{ 1 } << 21;

/// Asks the system to hand out memory that nobody has touched yet in large pages, where it has such
/// and they fit in. Large arrays are touched sooner then: each page that is touched first costs a
/// call of the system.
void UseLargePages(void* memory, std::size_t bytes);

}

#endif
