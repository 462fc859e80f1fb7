// SPDX-License-Identifier: BSD-3-Clause
#include "WebMemory.h"

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <new>

namespace
{
bool OutOfMemory = false;
}

namespace relief::web
{

//------------------------------------------------------------------------------
void EndWithoutMemory()
{
  std::set_new_handler(
    []
    {
      OutOfMemory = true;
      __builtin_trap();
    });
}

}

RELIEF_EXPORT void* reliefAllocate(std::size_t bytes)
{
  return std::malloc(std::max<std::size_t>(bytes, 1));
}

RELIEF_EXPORT void reliefFree(void* memory)
{
  std::free(memory);
}

// Whether what ended a call was that there is no more memory.
RELIEF_EXPORT int reliefIsOutOfMemory()
{
  return OutOfMemory ? 1 : 0;
}
