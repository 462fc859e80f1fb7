// SPDX-License-Identifier: BSD-3-Clause
#ifndef ReservedMemory_h
#define ReservedMemory_h

#include <cstddef>

namespace relief
{

/// @file
/// Addresses that take no memory until they are written: room for arrays of which only parts are in
/// use at a time. On systems with POSIX's mmap(); elsewhere there is none.

/// Whether this system has such memory.
bool CanReserveMemory();

/// Reserves so many bytes, above 0, all zeros, that become memory page by page as they are written.
/// Begins at a page; null if there is none.
void* ReserveMemory(std::size_t bytes);

/// Gives back what ReserveMemory() returned.
void ReleaseMemory(void* memory, std::size_t bytes);

/// Forgets the pages that lie wholly within a part of reserved memory: they are zeros again and
/// take no memory.
void ForgetMemory(void* part, std::size_t bytes);

/// How many bytes of a part of reserved memory take memory, in whole pages; 0 where the system does
/// not tell.
std::size_t CountResidentMemory(const void* part, std::size_t bytes);

}

#endif
