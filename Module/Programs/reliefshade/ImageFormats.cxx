// SPDX-License-Identifier: BSD-3-Clause
#include "ImageFormats.h"

#include "Failure.h"
#include "LoadedFormats.h"

#ifdef RELIEFSHADE_LOAD_FORMATS
#ifdef _WIN32
#include <windows.h>
#else
#include <dlfcn.h>
#endif
#endif

namespace reliefshade
{

#ifdef RELIEFSHADE_LOAD_FORMATS
namespace
{

using Offer = const ImageFormats* (*)();

//------------------------------------------------------------------------------
/// The system looks for the library where the program has its others. It stays to the end: some of
/// what it brings does not bear to be unloaded.
Offer load(std::string& reason)
{
#ifdef _WIN32
  const HMODULE library = LoadLibraryA(RELIEFSHADE_LOAD_FORMATS);
  reason = "error " + std::to_string(GetLastError());
  return library ? reinterpret_cast<Offer>(
                     reinterpret_cast<void*>(GetProcAddress(library, "reliefshadeImageFormats")))
                 : nullptr;
#else
  void* const library = dlopen(RELIEFSHADE_LOAD_FORMATS, RTLD_LAZY | RTLD_LOCAL);
  void* const symbol = library ? dlsym(library, "reliefshadeImageFormats") : nullptr;
  const char* error = symbol ? nullptr : dlerror();
  reason = error ? error : "";
  return reinterpret_cast<Offer>(symbol);
#endif
}

}
#endif

//------------------------------------------------------------------------------
const ImageFormats& imageFormats()
{
#ifdef RELIEFSHADE_LOAD_FORMATS
  struct Loaded
  {
    std::string Reason; // set by load, so it comes first
    Offer Formats = load(this->Reason);
  };
  static const Loaded loaded;
  if (!loaded.Formats)
  {
    throw Failure("", "the library of image formats cannot be loaded: " + loaded.Reason);
  }
  return *loaded.Formats();
#else
  return *reliefshadeImageFormats();
#endif
}

}
