// SPDX-License-Identifier: BSD-3-Clause
#ifndef WebMemory_h
#define WebMemory_h

/// @file
/// What each module of WebAssembly has that JavaScript calls: memory for what is given, and what
/// happens where there is no more. WebMemory.cxx has the functions.

/// A function that JavaScript calls.
#define RELIEF_EXPORT extern "C" __attribute__((used, visibility("default")))

namespace relief::web
{

/// From now on the module ends where there is no memory: no exception is thrown, and it is of no
/// use any more.
void EndWithoutMemory();

}

#endif
