// SPDX-License-Identifier: BSD-3-Clause

// The library that Ranks.cxx loads where processes are several.

#include "MpiRanks.h"

#include "vtkCommunicator.h"
#include "vtkMPIController.h"
#include "vtkSmartPointer.h"

#include <mpi.h>

namespace
{

class MpiRanks : public reliefshade::Ranks
{
public:
  MpiRanks()
  {
    // Threads of the program leave MPI alone.
    int provided = 0;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
    this->Controller = vtkSmartPointer<vtkMPIController>::New();
    this->Controller->Initialize(nullptr, nullptr, 1);
  }

  int GetRank() const override { return this->Controller->GetLocalProcessId(); }
  int GetCount() const override { return this->Controller->GetNumberOfProcesses(); }

  int FindFailed(bool well) override
  {
    const int mine = well ? this->GetCount() : this->GetRank();
    int first = mine;
    this->Controller->AllReduce(&mine, &first, 1, vtkCommunicator::MIN_OP);
    return first;
  }

  void Leave(bool together) override
  {
    if (!together)
    {
      MPI_Abort(MPI_COMM_WORLD, 1);
    }
    this->Controller->Finalize(1);
    MPI_Finalize();
  }

private:
  vtkSmartPointer<vtkMPIController> Controller;
};

}

//------------------------------------------------------------------------------
reliefshade::Ranks* reliefshadeMpiRanks()
{
  return new MpiRanks;
}
