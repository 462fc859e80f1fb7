// SPDX-License-Identifier: BSD-3-Clause
#ifndef MpiRanks_h
#define MpiRanks_h

#include "FileGuard.h"
#include "Ranks.h"

/// Begins MPI. What the library that Ranks.cxx loads offers; the caller owns it.
extern "C" RELIEF_THROWN reliefshade::Ranks* reliefshadeMpiRanks();

#endif
