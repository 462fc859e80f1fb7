// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkReliefThreads_h
#define vtkReliefThreads_h

#include "vtkSMPTools.h"

#include <atomic>
#include <exception>
#include <mutex>

/// vtkSMPTools::For with a body that may throw, as for want of memory: an exception that left a
/// thread of VTK's would end the program. The first one comes out here once all threads have come
/// to an end; parts that have not begun by then are left out. Private to the module.
template <class Body>
void vtkReliefFor(vtkIdType begin, vtkIdType end, vtkIdType grain, const Body& body)
{
  std::exception_ptr failure;
  std::atomic<bool> failed{ false };
  std::mutex mutex;
  vtkSMPTools::For(begin, end, grain,
    [&](vtkIdType from, vtkIdType to)
    {
      if (failed)
      {
        return;
      }
      try
      {
        body(from, to);
      }
      catch (...)
      {
        std::lock_guard<std::mutex> lock(mutex);
        failure = failure ? failure : std::current_exception();
        failed = true;
      }
    });
  if (failure)
  {
    std::rethrow_exception(failure);
  }
}

#endif
