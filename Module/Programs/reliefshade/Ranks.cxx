// SPDX-License-Identifier: BSD-3-Clause
#include "Ranks.h"

#include "Failure.h"
#include "MpiRanks.h"

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <memory>
#include <string>

#ifdef RELIEFSHADE_LOAD_RANKS
#include <dlfcn.h>
#endif

namespace
{

using namespace reliefshade;

std::unique_ptr<Ranks> Started;

//------------------------------------------------------------------------------
/// MPI takes a while to load, and nearly every run is one process.
std::unique_ptr<Ranks> makeRanks()
{
  if (countRanks() < 2)
  {
    return std::make_unique<Ranks>();
  }
#ifdef RELIEFSHADE_LOAD_RANKS
  // MPI loads parts of its own that look for its symbols.
  void* const library = dlopen(RELIEFSHADE_LOAD_RANKS, RTLD_NOW | RTLD_GLOBAL);
  void* const symbol = library ? dlsym(library, "reliefshadeMpiRanks") : nullptr;
  if (!symbol)
  {
    const char* error = dlerror();
    throw Failure("", "the library of MPI cannot be loaded: " + std::string(error ? error : ""));
  }
  return std::unique_ptr<Ranks>(reinterpret_cast<decltype(&reliefshadeMpiRanks)>(symbol)());
#else
  throw Failure("", "this program is built without MPI; it is expected to run as one process");
#endif
}

}

namespace reliefshade
{

//------------------------------------------------------------------------------
void Ranks::Together(const std::function<void()>& step)
{
  std::exception_ptr thrown;
  try
  {
    step();
  }
  catch (...)
  {
    thrown = std::current_exception();
  }
  const int failed = this->FindFailed(!thrown);
  this->Failed = failed < this->GetCount();
  if (this->Failed && failed == this->GetRank())
  {
    std::rethrow_exception(thrown);
  }
  if (this->Failed)
  {
    throw OtherRank();
  }
}

//------------------------------------------------------------------------------
void Ranks::FirstAhead(const std::function<void()>& step)
{
  const bool first = this->GetRank() == 0;
  const std::function<void()> nothing = [] {};
  this->Together(first ? step : nothing);
  if (this->GetCount() > 1)
  {
    this->Together(first ? nothing : step);
  }
}

//------------------------------------------------------------------------------
int countRanks()
{
  // Open MPI, those that come from MPICH, and MVAPICH.
  for (const char* name : { "OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "MV2_COMM_WORLD_SIZE" })
  {
    if (const char* count = std::getenv(name))
    {
      return std::max(std::atoi(count), 1);
    }
  }
  return 1;
}

//------------------------------------------------------------------------------
Ranks& ranks()
{
  if (!Started)
  {
    Started = makeRanks();
  }
  return *Started;
}

//------------------------------------------------------------------------------
Ranks* startedRanks()
{
  return Started.get();
}

}
