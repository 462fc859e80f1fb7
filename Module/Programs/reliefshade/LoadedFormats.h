// SPDX-License-Identifier: BSD-3-Clause
#ifndef LoadedFormats_h
#define LoadedFormats_h

#include "ImageFormats.h"

#if defined(_WIN32) && defined(RELIEFSHADE_LOAD_FORMATS)
#define RELIEFSHADE_FORMATS_EXPORT __declspec(dllexport)
#elif defined(__GNUC__)
#define RELIEFSHADE_FORMATS_EXPORT __attribute__((visibility("default")))
#else
#define RELIEFSHADE_FORMATS_EXPORT
#endif

/// What the library offers, by this name.
extern "C" RELIEFSHADE_FORMATS_EXPORT const reliefshade::ImageFormats* reliefshadeImageFormats();

#endif
