// SPDX-License-Identifier: BSD-3-Clause
#include "Threads.h"

#include "vtkSMPTools.h"

#include <cstdlib>
#include <string>

namespace reliefshade
{

//------------------------------------------------------------------------------
void setThreads(int count)
{
  // A VTK whose default is one thread has others built in all the same; the user's choice of one of
  // them goes first.
  if (std::string(vtkSMPTools::GetBackend()) == "Sequential" &&
    !std::getenv("VTK_SMP_BACKEND_IN_USE"))
  {
    vtkSMPTools::SetBackend("STDThread");
  }
  vtkSMPTools::Initialize(count);
}

}
