// SPDX-License-Identifier: BSD-3-Clause
#ifndef Threads_h
#define Threads_h

namespace reliefshade
{

/// Lets VTK use that many threads; 0 for one per processor.
void setThreads(int count);

}

#endif
