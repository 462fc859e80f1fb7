// SPDX-License-Identifier: BSD-3-Clause
// A process that saves pieces is killed at random moments. Whatever is there then under a piece's
// name is whole, and the run goes on.
#include "TileStore.h"

#include "StreamingTestUtilities.h"

#include <algorithm>
#include <chrono>
#include <thread>

#ifndef _WIN32
#include <csignal>
#include <sys/wait.h>
#include <unistd.h>

namespace
{
int Failures = 0;

using relief::streaming::TileStore;

constexpr int Pieces = 40;

vtkSmartPointer<vtkImageData> PieceOf(int index)
{
  const int extent[6] = { 0, 399, 30 * index, 30 * index + 29, 0, 0 };
  return RandomPiece(extent, static_cast<unsigned int>(index));
}

/// All of them, made once.
const std::vector<vtkSmartPointer<vtkImageData>>& All()
{
  static const std::vector<vtkSmartPointer<vtkImageData>> all = []
  {
    std::vector<vtkSmartPointer<vtkImageData>> pieces;
    pieces.reserve(Pieces);
    for (int k = 0; k < Pieces; ++k)
    {
      pieces.push_back(PieceOf(k));
    }
    return pieces;
  }();
  return all;
}

/// Saves whatever is missing, as a run does.
void Work(const std::string& folder)
{
  const TileStore store(folder, "a run");
  for (const auto& piece : All())
  {
    if (!store.Has(piece->GetExtent()))
    {
      store.Save(piece);
    }
  }
}

/// Returns how many pieces are there. All of them are right.
int CheckPieces(const std::string& folder)
{
  const TileStore store(folder, "a run");
  int count = 0;
  for (const auto& piece : All())
  {
    if (store.Has(piece->GetExtent()))
    {
      ++count;
      CHECK(SamePieces(store.Load(piece->GetExtent(), NamesOf(piece)), piece));
    }
  }
  CHECK(CountFiles(folder) == count + 2); // with the key and the lock; nothing unfinished
  return count;
}
}

int TestTileStoreKilled(int argc, char* argv[])
{
  const std::string folder = EmptyDirectory(argc, argv, "TileStoreKilled") + "work";
  std::mt19937 random(11);
  CHECK(All().size() == Pieces);
  int kills = 0;
  int before = 0;
  for (int round = 0; round < 200 && before < Pieces; ++round)
  {
    const pid_t child = fork();
    if (child == 0)
    {
      Work(folder);
      _exit(0);
    }
    std::this_thread::sleep_for(std::chrono::microseconds(random() % 6000));
    kill(child, SIGKILL);
    int status = 0;
    waitpid(child, &status, 0);
    kills += WIFSIGNALED(status) ? 1 : 0;
    const int count = CheckPieces(folder);
    CHECK(count >= before);
    before = std::max(before, count);
  }
  std::cout << kills << " processes were killed; " << before << " pieces were there" << std::endl;
  CHECK(kills >= 2);
  Work(folder);
  CHECK(CheckPieces(folder) == Pieces);
  return Failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
#else
int TestTileStoreKilled(int, char*[])
{
  return EXIT_SUCCESS; // there are no such signals
}
#endif
