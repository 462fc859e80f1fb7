// SPDX-License-Identifier: BSD-3-Clause
// Pieces come back bit for bit or not at all: whatever is in them, whatever happens to their files.
#include "TileStore.h"

#include "StreamingTestUtilities.h"

#include "vtkDoubleArray.h"
#include "vtkNew.h"

#include <array>
#include <ctime>

#ifndef _WIN32
#include <csignal>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#endif

namespace
{
int Failures = 0;
std::string Directory;

using relief::streaming::RunFolder;
using relief::streaming::TileDamaged;
using relief::streaming::TileStore;
namespace fs = std::filesystem;

void TestRandomPieces()
{
  const TileStore store(Directory + "random", "a run");
  std::mt19937 random(7);
  for (unsigned int seed = 0; seed < 200; ++seed)
  {
    const int x = static_cast<int>(random() % 2000) - 1000;
    const int y = static_cast<int>(random() % 2000) - 1000;
    const int z = seed % 10 == 0 ? 3 : 0;
    const int extent[6] = { x, x + static_cast<int>(random() % 700), y,
      y + static_cast<int>(random() % 60), z, z };
    const auto piece = RandomPiece(extent, seed);
    store.Save(piece);
    CHECK(store.Has(extent));
    CHECK(SamePieces(store.Load(extent, NamesOf(piece)), piece));
    // Some of the arrays, in any order.
    std::vector<std::string> names = NamesOf(piece);
    std::reverse(names.begin(), names.end());
    const auto turned = store.Load(extent, names);
    CHECK(NamesOf(turned) == names && turned->GetPointData()->GetScalars()->GetName() == names[0]);
    // Another piece in its place.
    const auto other = RandomPiece(extent, seed + 1000);
    store.Save(other);
    CHECK(SamePieces(store.Load(extent, NamesOf(other)), other));
    const int beside[6] = { x, x + 701, y, y, z, z };
    CHECK(!store.Has(beside));
  }
}

// Large enough for strips, blocks and more than one of GDAL's caches to matter.
void TestLargePiece()
{
  const TileStore store(Directory + "large", "a run");
  const int extent[6] = { 0, 8191, 0, 511, 0, 0 };
  auto piece = vtkSmartPointer<vtkImageData>::New();
  piece->SetExtent(extent[0], extent[1], extent[2], extent[3], 0, 0);
  std::mt19937 random(1);
  AddArray<vtkUnsignedCharArray>(piece, "Shading", 4, random);
  AddArray<vtkFloatArray>(piece, "Illumination", 1, random);
  AddArray<vtkFloatArray>(piece, "Normals", 3, random);
  const std::clock_t start = std::clock();
  store.Save(piece);
  const std::clock_t saved = std::clock();
  const auto loaded = store.Load(extent, NamesOf(piece));
  const std::clock_t end = std::clock();
  CHECK(SamePieces(loaded, piece));
  const double bytes = 20.0 * static_cast<double>(piece->GetNumberOfPoints());
  const auto nanoseconds = [bytes](std::clock_t ticks)
  { return 1e9 * static_cast<double>(ticks) / CLOCKS_PER_SEC / bytes; };
  std::cout << "processor time, ns a byte: saved " << nanoseconds(saved - start) << ", loaded "
            << nanoseconds(end - saved) << std::endl;
}

std::vector<fs::path> FilesOf(const fs::path& folder)
{
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder))
  {
    files.push_back(entry.path());
  }
  return files;
}

/// What becomes of a piece whose files something happens to: that it is damaged, or nothing that
/// counts.
enum Outcome
{
  Right,
  Wrong,
  Damaged
};
Outcome After(const TileStore& store, vtkImageData* piece,
  const std::function<void(fs::path)>& harm, std::mt19937& random)
{
  int extent[6];
  piece->GetExtent(extent);
  store.Save(piece);
  const std::string folder = store.GetFolder() + "/" + std::to_string(extent[0]) + "-" +
    std::to_string(extent[1]) + "_" + std::to_string(extent[2]) + "-" + std::to_string(extent[3]);
  const std::vector<fs::path> files = FilesOf(folder);
  CHECK(static_cast<int>(files.size()) == piece->GetPointData()->GetNumberOfArrays());
  harm(files[random() % files.size()]);
  try
  {
    return SamePieces(store.Load(extent, NamesOf(piece)), piece) ? Right : Wrong;
  }
  catch (const TileDamaged& failure)
  {
    CHECK(Contains(failure.what(), "is damaged") && Contains(failure.what(), folder));
    CHECK(std::strlen(failure.what()) < 300);
    CHECK(!store.Has(extent) && !fs::exists(folder));
    return Damaged;
  }
}

void TestDamage()
{
  const TileStore store(Directory + "damage", "a run");
  std::mt19937 random(3);
  int found = 0;
  for (unsigned int seed = 0; seed < 600; ++seed)
  {
    const int extent[6] = { 5, 24 + static_cast<int>(seed % 30), 7, 26, 0, 0 };
    const auto piece = RandomPiece(extent, seed);
    // Cut off anywhere: at the end there may be what nothing depends on.
    const Outcome cut = After(
      store, piece,
      [&random](const fs::path& file) { fs::resize_file(file, random() % fs::file_size(file)); },
      random);
    CHECK(cut == Damaged);
    // A bit turned over, anywhere or in the header.
    const Outcome flipped = After(
      store, piece,
      [&](const fs::path& file)
      {
        std::string text = FileText(file.string());
        const std::size_t at = random() % (seed % 2 == 0 ? text.size() : 400);
        text[at] = static_cast<char>(text[at] ^ (1 << random() % 8));
        WriteText(file.string(), text);
      },
      random);
    CHECK(flipped != Wrong);
    found += flipped == Damaged ? 1 : 0;
    // Of the samples none is left out: they are the greater part of all files.
  }
  std::cout << found << " of 600 bits counted" << std::endl;
  CHECK(found > 400);

  const int extent[6] = { 0, 19, 0, 9, 0, 0 };
  const auto piece = RandomPiece(extent, 2);
  CHECK(After(
          store, piece, [](const fs::path& file) { fs::remove(file); }, random) == Damaged);
  CHECK(
    After(
      store, piece, [](const fs::path& file) { WriteText(file.string(), ""); }, random) == Damaged);
  CHECK(After(
          store, piece,
          [](const fs::path& file)
          { WriteText(file.string(), "P5 20 10 255\n" + std::string(200, 'x')); },
          random) == Damaged);
  // Of another size, and another piece's.
  const int other[6] = { 0, 18, 0, 9, 0, 0 };
  const int shifted[6] = { 20, 39, 0, 9, 0, 0 };
  for (const int* wrong : { other, shifted })
  {
    store.Save(RandomPiece(wrong, 2));
    store.Save(piece);
    const auto name = [&store](const int e[6])
    {
      return fs::path(store.GetFolder()) /
        (std::to_string(e[0]) + "-" + std::to_string(e[1]) + "_0-9");
    };
    fs::remove_all(name(extent));
    fs::rename(name(wrong), name(extent));
    CHECK(Contains(Thrown([&] { store.Load(extent, { "Shading" }); }), "is damaged"));
    CHECK(!store.Has(extent));
  }
}

void TestKeys()
{
  const std::string folder = Directory + "keys";
  const std::string key = "input: dem.tif\nsize: 100 200\nscene: {}\n";
  {
    const TileStore store(folder, key);
    CHECK(FileText(folder + "/run.txt") == key);
    // Another process of the same run joins, one of another does not.
    const TileStore joined(folder, key, RunFolder::Joined);
    CHECK(Contains(
      Thrown([&] { TileStore(folder, "input: a.tif", RunFolder::Joined); }), "input: dem.tif"));
    // The lock is the first one's as long as it lives, in the same process as well.
    const std::string message = Thrown([&] { TileStore(folder, key); });
    CHECK(Contains(message, folder) && Contains(message, "another run is writing"));
  }
  const std::string message =
    Thrown([&] { TileStore(folder, "input: dem.tif\nsize: 100 300\nscene: {}"); });
  CHECK(Contains(message, folder) && Contains(message, "size: 100 200") &&
    Contains(message, "size: 100 300") && Contains(message, "remove it") && message.size() < 300);
  CHECK(Contains(
    Thrown([&] { TileStore(folder, key + "more\n"); }), "\"nothing\" there, \"more\" here"));
  CHECK(FileText(folder + "/run.txt") == key && CountFiles(folder) == 1);
  CHECK(Thrown([&] { TileStore(folder, key); }).empty());

  CHECK(Contains(Thrown([&] { TileStore(Directory + "no/such", key); }), "cannot be made"));
  WriteText(Directory + "file", "");
  CHECK(Contains(Thrown([&] { TileStore(Directory + "file", key); }), "file"));
  CHECK(Contains(
    Thrown([&] { TileStore(Directory + "nothing", key, RunFolder::Joined); }), "no run is there"));
  CHECK(!fs::exists(Directory + "nothing"));
}

void TestRemove()
{
  const std::string folder = Directory + "remove";
  const int extent[6] = { 0, 19, 0, 9, 0, 0 };
  {
    TileStore store(folder, "a run");
    store.Save(RandomPiece(extent, 1));
    fs::create_directory(folder + "/.0-9_0-9.0123456789abcdef.tmp");
    WriteText(folder + "/.run.txt.12-0.tmp.txt", "");
    store.Remove();
    CHECK(!fs::exists(folder));
  }
  // What others have put there stays; what a killed run has left does not.
  fs::create_directories(folder + "/.0-9_0-9.0123456789abcdef.tmp");
  fs::create_directories(folder + "/10-20");
  fs::create_directories(folder + "/.0-9_0-9.mine.tmp");
  WriteText(folder + "/notes.txt", "mine");
  WriteText(folder + "/.0-9_0-9.0123456789abcdef.tmp/Shading.tif", "half");
  WriteText(folder + "/.run.txt.1-0.tmp.txt", "a r"); // by a process whose number another has now
  TileStore store(folder, "a run");
  CHECK(!fs::exists(folder + "/.run.txt.1-0.tmp.txt"));
  CHECK(!fs::exists(folder + "/.0-9_0-9.0123456789abcdef.tmp"));
  CHECK(!store.Has(extent));
  store.Save(RandomPiece(extent, 1));
  WriteText(folder + "/0-19_0-9/notes.txt", "mine as well");
  store.Remove();
  CHECK(FileText(folder + "/notes.txt") == "mine");
  CHECK(FileText(folder + "/0-19_0-9/notes.txt") == "mine as well");
  CHECK(fs::exists(folder + "/10-20") && fs::exists(folder + "/.0-9_0-9.mine.tmp"));
  CHECK(CountFiles(folder) == 4 && CountFiles(folder + "/0-19_0-9") == 1);
}

void TestRefusals()
{
  const TileStore store(Directory + "refusals", "a run");
  vtkNew<vtkImageData> piece;
  CHECK(Contains(Thrown([&] { store.Save(piece); }), "empty"));
  piece->SetDimensions(4, 3, 1);
  piece->AllocateScalars(VTK_DOUBLE, 1);
  CHECK(Contains(Thrown([&] { store.Save(piece); }), "float"));
  piece->SetDimensions(4, 3, 2);
  piece->AllocateScalars(VTK_FLOAT, 1);
  CHECK(Contains(Thrown([&] { store.Save(piece); }), "2 slices"));
  CHECK(CountFiles(store.GetFolder()) == 2); // the key and the lock
}

#ifndef _WIN32
/// Runs a step in a process of its own. Returns whether it ended with 0.
bool InChild(const std::function<bool()>& step)
{
  const pid_t child = fork();
  if (child == 0)
  {
    _exit(step() ? 0 : 1);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

void TestTwoProcesses()
{
  const std::string folder = Directory + "two";
  const int extent[6] = { 0, 199, 0, 99, 0, 0 };
  const auto piece = RandomPiece(extent, 5);
  {
    const TileStore store(folder, "a run");
    CHECK(InChild([&]
      { return Contains(Thrown([&] { TileStore(folder, "a run"); }), "another run is writing"); }));
    CHECK(InChild(
      [&]
      {
        const TileStore joined(folder, "a run", RunFolder::Joined);
        joined.Save(piece);
        return true;
      }));
    CHECK(store.Has(extent) && SamePieces(store.Load(extent, NamesOf(piece)), piece));
  }
  // The lock goes with its process.
  CHECK(InChild([&] { return Thrown([&] { new TileStore(folder, "a run"); }).empty(); }));
  CHECK(Thrown([&] { TileStore(folder, "a run"); }).empty());
}

/// A limit of the size of files stands for a disk that is full.
void TestFullDisk()
{
  const std::string folder = Directory + "full";
  const int extent[6] = { 0, 499, 0, 199, 0, 0 };
  for (const rlim_t limit : { 0u, 100u, 8192u, 200000u, 399999u })
  {
    CHECK(InChild(
      [&]
      {
        const TileStore store(folder, "a run");
        std::signal(SIGXFSZ, SIG_IGN);
        const rlimit small = { limit, limit };
        setrlimit(RLIMIT_FSIZE, &small);
        auto piece = vtkSmartPointer<vtkImageData>::New();
        piece->SetExtent(extent[0], extent[1], extent[2], extent[3], 0, 0);
        std::mt19937 random(1);
        AddArray<vtkUnsignedCharArray>(piece, "Shading", 4, random);
        const std::string message = Thrown([&] { store.Save(piece); });
        if (!Contains(message, folder) || !Contains(message, "cannot be written") ||
          message.size() > 400)
        {
          std::cout << limit << ": " << message << std::endl;
          return false;
        }
        return !store.Has(extent) && CountFiles(folder) == 2; // the key and the lock
      }));
  }
  // So it is with the key.
  CHECK(InChild(
    [&]
    {
      std::signal(SIGXFSZ, SIG_IGN);
      const rlimit small = { 3, 3 };
      setrlimit(RLIMIT_FSIZE, &small);
      return Contains(
               Thrown([&] { TileStore(Directory + "key", "a run"); }), "cannot be written") &&
        CountFiles(Directory + "key") == 0;
    }));
  // No permission, for those who need one.
  fs::permissions(folder, fs::perms::owner_read | fs::perms::owner_exec);
  if (geteuid() != 0)
  {
    CHECK(Contains(Thrown([&] { TileStore(folder, "a run"); }), "cannot be written"));
  }
  fs::permissions(folder, fs::perms::owner_all);
}
#endif
}

int TestTileStore(int argc, char* argv[])
{
  Directory = EmptyDirectory(argc, argv, "TileStore");
  TestRandomPieces();
  TestLargePiece();
  TestDamage();
  TestKeys();
  TestRemove();
  TestRefusals();
#ifndef _WIN32
  TestTwoProcesses();
  TestFullDisk();
#endif
  return Failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
