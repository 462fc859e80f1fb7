// SPDX-License-Identifier: BSD-3-Clause
#ifndef ModelVersion_h
#define ModelVersion_h

namespace relief
{

/// The version of the model, for the headers of what is made with it. It is raised when the same
/// heights and scene give other results than before, beyond rounding.
constexpr int ModelVersion = 1;

}

#endif
