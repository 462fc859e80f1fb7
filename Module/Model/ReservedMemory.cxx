// SPDX-License-Identifier: BSD-3-Clause
#include "ReservedMemory.h"

#if defined(__unix__) || defined(__APPLE__)
#ifndef __EMSCRIPTEN__
#define RELIEF_RESERVES_MEMORY
#endif
#endif

#ifdef RELIEF_RESERVES_MEMORY
#include <algorithm>
#include <cstdint>
#include <vector>

#include <sys/mman.h>
#include <unistd.h>
#endif

namespace relief
{

#ifdef RELIEF_RESERVES_MEMORY

namespace
{
#ifdef MAP_NORESERVE
constexpr int Kind = MAP_PRIVATE | MAP_ANON | MAP_NORESERVE;
#else
constexpr int Kind = MAP_PRIVATE | MAP_ANON;
#endif

std::uintptr_t PageSize()
{
  static const std::uintptr_t size = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
  return size;
}

// The whole pages within a part of memory.
struct Pages
{
  std::uintptr_t first;
  std::uintptr_t end;

  Pages(const void* part, std::size_t bytes)
  {
    const auto begin = reinterpret_cast<std::uintptr_t>(part);
    this->first = (begin + PageSize() - 1) / PageSize() * PageSize();
    this->end = std::max((begin + bytes) / PageSize() * PageSize(), this->first);
  }
};

void KeepPagesSmall(void* memory, std::size_t bytes)
{
#if defined(__linux__) && defined(MADV_NOHUGEPAGE)
  // Large pages would hold what nobody fills.
  madvise(memory, bytes, MADV_NOHUGEPAGE);
#else
  static_cast<void>(memory);
  static_cast<void>(bytes);
#endif
}
}

bool CanReserveMemory()
{
  return true;
}

void* ReserveMemory(std::size_t bytes)
{
  void* memory = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, Kind, -1, 0);
  if (memory == MAP_FAILED)
  {
    return nullptr;
  }
  KeepPagesSmall(memory, bytes);
  return memory;
}

void ReleaseMemory(void* memory, std::size_t bytes)
{
  munmap(memory, bytes);
}

void ForgetMemory(void* part, std::size_t bytes)
{
  const Pages pages(part, bytes);
  if (pages.end == pages.first)
  {
    return;
  }
  void* first = static_cast<char*>(part) + (pages.first - reinterpret_cast<std::uintptr_t>(part));
  const std::size_t size = pages.end - pages.first;
#ifdef __linux__
  madvise(first, size, MADV_DONTNEED);
#else
  // Elsewhere that is a hint only: new pages take the place of these.
  mmap(first, size, PROT_READ | PROT_WRITE, Kind | MAP_FIXED, -1, 0);
#endif
}

std::size_t CountResidentMemory(const void* part, std::size_t bytes)
{
#ifdef __linux__
  const Pages pages(part, bytes);
  constexpr std::size_t most = std::size_t{ 1 } << 16; // pages at a time
  std::vector<unsigned char> resident(most);
  std::size_t count = 0;
  for (std::uintptr_t first = pages.first; first < pages.end; first += most * PageSize())
  {
    const std::size_t size = std::min<std::size_t>(pages.end - first, most * PageSize());
    // It takes the memory as something to write to, and does not.
    char* page = const_cast<char*>(static_cast<const char*>(part)) +
      static_cast<std::ptrdiff_t>(first - reinterpret_cast<std::uintptr_t>(part));
    if (mincore(page, size, resident.data()) == 0)
    {
      count += std::count_if(resident.begin(), resident.begin() + size / PageSize(),
        [](unsigned char page) { return (page & 1) != 0; });
    }
  }
  return count * PageSize();
#else
  static_cast<void>(part);
  static_cast<void>(bytes);
  return 0;
#endif
}

#else

bool CanReserveMemory()
{
  return false;
}

void* ReserveMemory(std::size_t)
{
  return nullptr;
}

void ReleaseMemory(void*, std::size_t) {}

void ForgetMemory(void*, std::size_t) {}

std::size_t CountResidentMemory(const void*, std::size_t)
{
  return 0;
}

#endif

}
