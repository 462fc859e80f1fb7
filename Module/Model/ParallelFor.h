// SPDX-License-Identifier: BSD-3-Clause
#ifndef ParallelFor_h
#define ParallelFor_h

#include <functional>

namespace relief
{

/// How a host runs body(begin, end) over disjoint parts of [0, count), on as many threads as it
/// likes.
using ParallelFor =
  std::function<void(int count, const std::function<void(int begin, int end)>& body)>;

}

#endif
