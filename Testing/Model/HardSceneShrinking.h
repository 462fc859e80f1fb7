// SPDX-License-Identifier: BSD-3-Clause
#ifndef HardSceneShrinking_h
#define HardSceneShrinking_h

#include "HardScene.h"

#include <functional>

/// The simplest scene found that still fails, beginning with one that does: fewer lights and
/// samples, rounder numbers, the defaults of the medium (delta debugging: A. Zeller, R.
/// Hildebrandt, "Simplifying and isolating failure-inducing input", 2002, with the changes that
/// make sense for a scene).
HardScene Shrink(HardScene scene, const std::function<bool(const HardScene&)>& fails);

#endif
