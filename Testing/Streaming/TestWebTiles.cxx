// SPDX-License-Identifier: BSD-3-Clause
// Tiles have what the picture has, in its place, without seams; a run that was ended goes on.
#include "WebTiles.h"

#include "StreamingTestUtilities.h"
#include "WarpedPicture.h"

#include "vtkSMPTools.h"

#include <gdal_priv.h>
#include <gdal_utils.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <map>
#include <thread>

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

using relief::streaming::MercatorHalf;
using relief::streaming::ResolutionOf;
using relief::streaming::TilePlan;
using relief::streaming::TileSpan;
using relief::streaming::WarpedPicture;
using relief::streaming::WebTiles;
namespace fs = std::filesystem;

using Pixel = std::array<int, 4>;

/// A picture of bytes.
struct Picture
{
  int Width = 0;
  int Height = 0;
  std::vector<unsigned char> Bytes;

  Picture(int width, int height)
    : Width(width)
    , Height(height)
    , Bytes(4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height))
  {
  }
  unsigned char* At(int i, int j)
  {
    return &Bytes[4 *
      (static_cast<std::size_t>(j) * static_cast<std::size_t>(Width) +
        static_cast<std::size_t>(i))];
  }
  Pixel Get(int i, int j)
  {
    const unsigned char* p = this->At(i, j);
    return { p[0], p[1], p[2], p[3] };
  }
};

void Write(
  const std::string& name, Picture& picture, const char* crs, std::array<double, 6> transform)
{
  GDALAllRegister();
  const char* const options[] = { "TILED=YES", "PHOTOMETRIC=RGB", "ALPHA=NON-PREMULTIPLIED",
    nullptr };
  GDALDataset* file = GetGDALDriverManager()->GetDriverByName("GTiff")->Create(
    name.c_str(), picture.Width, picture.Height, 4, GDT_Byte, const_cast<char**>(options));
  file->SetGeoTransform(transform.data());
  OGRSpatialReference reference;
  reference.SetFromUserInput(crs);
  file->SetSpatialRef(&reference);
  CHECK(file->RasterIO(GF_Write, 0, 0, picture.Width, picture.Height, picture.Bytes.data(),
          picture.Width, picture.Height, GDT_Byte, 4, nullptr, 4, 4 * picture.Width, 1,
          nullptr) == CE_None);
  GDALClose(file);
}

Picture Read(GDALDataset* file)
{
  Picture picture(file->GetRasterXSize(), file->GetRasterYSize());
  CHECK(file->GetRasterCount() == 4);
  CHECK(file->RasterIO(GF_Read, 0, 0, picture.Width, picture.Height, picture.Bytes.data(),
          picture.Width, picture.Height, GDT_Byte, 4, nullptr, 4, 4 * picture.Width, 1,
          nullptr) == CE_None);
  return picture;
}

std::string TileName(const std::string& folder, int zoom, std::int64_t column, std::int64_t row)
{
  return folder + "/" + std::to_string(zoom) + "/" + std::to_string(column) + "/" +
    std::to_string(row) + ".png";
}

/// All tiles of a span side by side; what is not there is transparent.
Picture Assemble(const std::string& folder, int zoom, const TileSpan& span, int size)
{
  Picture all(static_cast<int>(span.Columns[1] - span.Columns[0] + 1) * size,
    static_cast<int>(span.Rows[1] - span.Rows[0] + 1) * size);
  for (std::int64_t row = span.Rows[0]; row <= span.Rows[1]; ++row)
  {
    for (std::int64_t column = span.Columns[0]; column <= span.Columns[1]; ++column)
    {
      const std::string name = TileName(folder, zoom, column, row);
      if (!fs::exists(name))
      {
        continue;
      }
      GDALDataset* file = GDALDataset::Open(name.c_str());
      Picture tile = Read(file);
      GDALClose(file);
      CHECK(tile.Width == size && tile.Height == size);
      bool empty = true;
      for (int j = 0; j < size; ++j)
      {
        std::copy_n(tile.At(0, j), 4 * size,
          all.At(static_cast<int>(column - span.Columns[0]) * size,
            static_cast<int>(row - span.Rows[0]) * size + j));
        for (int i = 0; i < size; ++i)
        {
          empty = empty && tile.Get(i, j)[3] == 0;
        }
      }
      CHECK(!empty);
    }
  }
  return all;
}

/// Makes tiles of the picture that is in a folder.
TilePlan Make(
  const std::string& folder, int size = 256, const std::optional<std::array<int, 2>>& zoom = {})
{
  WebTiles tiles(folder, "a run");
  const TilePlan plan = tiles.Plan(size, zoom);
  tiles.Make(plan, {});
  CHECK(tiles.AreDone() && !tiles.HasPicture());
  return plan;
}

double Light(int code)
{
  const double c = code / 255.0;
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

double Code(double light)
{
  return 255.0 * (light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055);
}

// Where the picture has the tiles' own samples, they are the same, and the smaller ones are means.
void TestSamples()
{
  const std::string folder = Directory + "samples";
  fs::create_directory(folder);
  const int zoom = 9;
  const double resolution = ResolutionOf(zoom, 256);
  Picture picture(700, 600);
  std::mt19937 random(2);
  for (int j = 0; j < picture.Height; ++j)
  {
    for (int i = 0; i < picture.Width; ++i)
    {
      unsigned char* p = picture.At(i, j);
      for (int k = 0; k < 3; ++k)
      {
        p[k] = static_cast<unsigned char>(random());
      }
      // A tile without any data, and a half-transparent part.
      p[3] = i >= 245 && i < 520 && j >= 240 && j < 520 ? 0 : i > 600 ? 128 : 255;
    }
  }
  // The first sample is 10 samples right of a tile's edge and 4 below it.
  Write(folder + "/shaded.tif", picture, "EPSG:3857",
    { (100 * 256 + 10) * resolution - MercatorHalf, resolution, 0.0,
      MercatorHalf - (200 * 256 + 4) * resolution, 0.0, -resolution });
  const TilePlan plan = Make(folder);
  CHECK(plan.Zoom[1] == zoom && plan.Finest.size() == 1);
  Picture all = Assemble(folder, zoom, plan.Finest[0], 256);
  CHECK(all.Width == 768 && all.Height == 768);
  int wrong = 0;
  for (int j = 0; j < all.Height; ++j)
  {
    for (int i = 0; i < all.Width; ++i)
    {
      const bool inside = i >= 10 && i < 710 && j >= 4 && j < 604;
      Pixel expected = inside ? picture.Get(i - 10, j - 4) : Pixel{ 0, 0, 0, 0 };
      const Pixel found = all.Get(i, j);
      if (expected[3] == 0)
      {
        wrong += found[3] != 0;
        continue;
      }
      for (int k = 0; k < 4; ++k)
      {
        wrong += std::abs(found[k] - expected[k]) > 0;
      }
    }
  }
  CHECK(wrong == 0);
  CHECK(
    !fs::exists(TileName(folder, zoom, 101, 201)) && fs::exists(TileName(folder, zoom, 100, 201)));

  Picture half = Assemble(folder, zoom - 1, plan.At(zoom - 1)[0], 256);
  const int shiftX = static_cast<int>(plan.Finest[0].Columns[0] % 2) * 256;
  const int shiftY = static_cast<int>(plan.Finest[0].Rows[0] % 2) * 256;
  int off = 0;
  for (int j = 0; j < half.Height; ++j)
  {
    for (int i = 0; i < half.Width; ++i)
    {
      double sum[4] = { 0.0, 0.0, 0.0, 0.0 };
      for (int k = 0; k < 4; ++k)
      {
        const int x = 2 * i + k % 2 - shiftX;
        const int y = 2 * j + k / 2 - shiftY;
        if (x >= 0 && y >= 0 && x < all.Width && y < all.Height)
        {
          const Pixel p = all.Get(x, y);
          sum[3] += p[3];
          for (int c = 0; c < 3; ++c)
          {
            sum[c] += p[3] * Light(p[c]);
          }
        }
      }
      const Pixel found = half.Get(i, j);
      off += std::abs(found[3] - sum[3] / 4) > 0.5001;
      for (int c = 0; c < 3 && sum[3] > 0.0; ++c)
      {
        off += std::abs(found[c] - Code(sum[c] / sum[3])) > 0.501;
      }
    }
  }
  CHECK(off == 0);
  const std::string text = FileText(folder + "/tiles.json");
  CHECK(Contains(text, "\"tilejson\": \"3.0.0\"") && Contains(text, "{z}/{x}/{y}.png") &&
    Contains(text, "\"maxzoom\": 9"));
}

/// A picture in UTM of even ramps and of hills, with a ragged edge and a hole.
Picture Hills(int width, int height)
{
  Picture picture(width, height);
  for (int j = 0; j < height; ++j)
  {
    for (int i = 0; i < width; ++i)
    {
      unsigned char* p = picture.At(i, j);
      p[0] = static_cast<unsigned char>(255.0 * i / width);
      p[1] = static_cast<unsigned char>(255.0 * j / height);
      p[2] = static_cast<unsigned char>(127.5 + 127.0 * std::sin(0.9 * i) * std::cos(0.7 * j));
      const bool hole = std::hypot(i - 0.6 * width, j - 0.4 * height) < 0.1 * width;
      p[3] = hole || (i * 7 + j * 3) % 50 < 2 ? 0 : 255;
    }
  }
  return picture;
}

/// The same samples by GDAL alone, of all tiles at once: in one step, without approximation.
Picture WarpAtOnce(const std::string& file, const TilePlan& plan)
{
  const TileSpan& span = plan.Finest[0];
  const double tile = ResolutionOf(plan.Zoom[1], plan.Size) * plan.Size;
  const auto text = [](double number) { return std::to_string(number); };
  const auto precise = [](double number)
  {
    char digits[64];
    std::snprintf(digits, sizeof digits, "%.17g", number);
    return std::string(digits);
  };
  const std::string scale =
    text(std::min(1.0, plan.Resolution / ResolutionOf(plan.Zoom[1], plan.Size)));
  const std::vector<std::string> words = { "-of", "MEM", "-t_srs", "EPSG:3857", "-te",
    precise(static_cast<double>(span.Columns[0]) * tile - MercatorHalf),
    precise(MercatorHalf - static_cast<double>(span.Rows[1] + 1) * tile),
    precise(static_cast<double>(span.Columns[1] + 1) * tile - MercatorHalf),
    precise(MercatorHalf - static_cast<double>(span.Rows[0]) * tile), "-ts",
    std::to_string((span.Columns[1] - span.Columns[0] + 1) * plan.Size),
    std::to_string((span.Rows[1] - span.Rows[0] + 1) * plan.Size), "-r", "cubic", "-et", "0", "-wm",
    "2000", "-wo", "XSCALE=" + scale, "-wo", "YSCALE=" + scale };
  std::vector<char*> list;
  list.reserve(words.size() + 1);
  for (const std::string& word : words)
  {
    list.push_back(const_cast<char*>(word.c_str()));
  }
  list.push_back(nullptr);
  GDALDatasetH source = GDALOpen(file.c_str(), GA_ReadOnly);
  GDALWarpAppOptions* options = GDALWarpAppOptionsNew(list.data(), nullptr);
  GDALDatasetH warped = GDALWarp("", nullptr, 1, &source, options, nullptr);
  GDALWarpAppOptionsFree(options);
  Picture picture = Read(GDALDataset::FromHandle(warped));
  GDALClose(warped);
  GDALClose(source);
  return picture;
}

// All tiles together are one large picture in the projection of the map; what is read together
// does not matter.
void TestSeams()
{
  std::mt19937 random(4);
  for (const int size : { 256, 512 })
  {
    for (const int zoom : { 11, 13, 14 }) // a quarter of the resolution, about the same, twice that
    {
      const std::string folder = Directory + "seams" + std::to_string(size + zoom);
      fs::create_directory(folder);
      Picture picture = Hills(300, 260);
      const std::string name = folder + "/shaded.tif";
      Write(name, picture, "EPSG:32632", { 600000.0, 15.0, 0.0, 5200000.0, 0.0, -15.0 });
      WebTiles tiles(folder, "a run");
      const TilePlan plan = tiles.Plan(size, { { zoom - 1, zoom } });
      Picture expected = WarpAtOnce(name, plan);
      WarpedPicture warped(name, plan);
      const TileSpan& span = plan.Finest[0];
      Picture whole(expected.Width, expected.Height);
      warped.Read(
        span.Columns[0] * size, span.Rows[0] * size, whole.Width, whole.Height, whole.Bytes.data());
      for (int k = 0; k < 20; ++k)
      {
        const int x = static_cast<int>(random() % static_cast<unsigned int>(whole.Width));
        const int y = static_cast<int>(random() % static_cast<unsigned int>(whole.Height));
        Picture part(1 + static_cast<int>(random() % static_cast<unsigned int>(whole.Width - x)),
          1 + static_cast<int>(random() % static_cast<unsigned int>(whole.Height - y)));
        WarpedPicture(name, plan)
          .Read(span.Columns[0] * size + x, span.Rows[0] * size + y, part.Width, part.Height,
            part.Bytes.data());
        bool same = true;
        for (int j = 0; j < part.Height; ++j)
        {
          same =
            same && std::equal(part.At(0, j), part.At(0, j) + 4 * part.Width, whole.At(x, y + j));
        }
        CHECK(same);
      }
      tiles.Make(plan, {});
      CHECK(Assemble(folder, zoom, span, size).Bytes == whole.Bytes);
      // GDAL rounds otherwise where it knows that all samples of a part have data.
      std::map<int, int> differences;
      for (std::size_t k = 0; k < whole.Bytes.size(); ++k)
      {
        const std::size_t alpha = k / 4 * 4 + 3;
        const int difference = std::abs(whole.Bytes[k] - expected.Bytes[k]);
        ++differences[whole.Bytes[alpha] == 0 && expected.Bytes[alpha] == 0 ? 0 : difference];
      }
      std::cout << size << ", zoom " << zoom << ":";
      for (const auto& [difference, count] : differences)
      {
        std::cout << " " << count << " x " << difference;
      }
      std::cout << std::endl;
      CHECK(differences.rbegin()->first <= 1);
      CHECK(differences[0] > 0.99 * static_cast<double>(whole.Bytes.size()));
    }
  }
}

// What is where on the Earth: the ramps of a picture in degrees say where each sample lies.
void TestPlaces()
{
  struct Case
  {
    double West;
    double North;
    double Step;
  };
  for (const Case& place :
    { Case{ 10.0, 50.0, 0.01 }, Case{ 178.0, 3.0, 0.01 }, Case{ -181.0, -60.0, 0.01 } })
  {
    const std::string folder = Directory + "places" + std::to_string(static_cast<int>(place.West));
    fs::create_directory(folder);
    Picture picture(400, 300);
    for (int j = 0; j < picture.Height; ++j)
    {
      for (int i = 0; i < picture.Width; ++i)
      {
        unsigned char* p = picture.At(i, j);
        p[0] = static_cast<unsigned char>(i / 2);
        p[1] = static_cast<unsigned char>(j / 2);
        p[2] = 77;
        p[3] = 255;
      }
    }
    Write(folder + "/shaded.tif", picture, "EPSG:4326",
      { place.West, place.Step, 0.0, place.North, 0.0, -place.Step });
    const TilePlan plan = Make(folder);
    CHECK(plan.Finest.size() == (place.West < 170.0 && place.West > -180.0 ? 1u : 2u));
    double count = 0.0;
    int wrong = 0;
    const double pi = std::acos(-1.0);
    const double resolution = ResolutionOf(plan.Zoom[1], 256);
    for (const TileSpan& span : plan.Finest)
    {
      Picture all = Assemble(folder, plan.Zoom[1], span, 256);
      for (int j = 0; j < all.Height; ++j)
      {
        for (int i = 0; i < all.Width; ++i)
        {
          const double x =
            (static_cast<double>(span.Columns[0]) * 256 + i + 0.5) * resolution - MercatorHalf;
          const double y =
            MercatorHalf - (static_cast<double>(span.Rows[0]) * 256 + j + 0.5) * resolution;
          double column = (x / MercatorHalf * 180.0 - place.West) / place.Step;
          column -= std::floor(column / 36000.0) * 36000.0;
          const double row =
            (place.North - 180.0 / pi * std::atan(std::sinh(y / MercatorHalf * pi))) / place.Step;
          const bool inside = column > 2.0 && column < 398.0 && row > 2.0 && row < 298.0;
          const bool outside = column < -1.0 || column > 401.0 || row < -1.0 || row > 301.0;
          const Pixel p = all.Get(i, j);
          wrong += inside &&
            (p[3] != 255 || p[2] != 77 || std::abs(p[0] - (column - 1.0) / 2) > 1.3 ||
              std::abs(p[1] - (row - 1.0) / 2) > 1.3);
          wrong += outside && p[3] != 0;
          count += p[3] == 255;
        }
      }
    }
    CHECK(wrong == 0);
    CHECK(count > 0.3 * 400 * 300);
  }
}

/// All files of a folder with what is in them.
std::map<std::string, std::string> Contents(const std::string& folder)
{
  std::map<std::string, std::string> contents;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
  {
    if (entry.is_regular_file())
    {
      contents[entry.path().lexically_relative(folder).string()] = FileText(entry.path().string());
    }
  }
  return contents;
}

void Prepare(const std::string& folder)
{
  fs::remove_all(folder);
  fs::create_directory(folder);
  Picture picture = Hills(700, 600);
  Write(
    folder + "/shaded.tif", picture, "EPSG:32632", { 600000.0, 15.0, 0.0, 5200000.0, 0.0, -15.0 });
}

void TestGoingOn()
{
  const std::string folder = Directory + "whole";
  Prepare(folder);
  Make(folder);
  const auto whole = Contents(folder);
  CHECK(whole.size() > 15);

  // With one thread as well, from now on.
  Prepare(Directory + "single");
  vtkSMPTools::Initialize(1);
  Make(Directory + "single");
  CHECK(Contents(Directory + "single") == whole);

  // What is there is kept, whatever it is; what is missing is made.
  const std::string again = Directory + "again";
  Prepare(again);
  fs::copy(again + "/shaded.tif", Directory + "kept.tif");
  const TilePlan plan = Make(again);
  CHECK(WebTiles(again, "a run").AreDone());
  const TileSpan span = plan.Finest[0];
  const std::string missing = TileName(again, plan.Zoom[1], span.Columns[0] + 1, span.Rows[0] + 1);
  const std::string kept = TileName(again, plan.Zoom[1], span.Columns[0], span.Rows[0] + 1);
  const auto date = fs::last_write_time(kept);
  fs::remove(again + "/tiles.json");
  fs::remove(missing);
  WriteText(fs::path(missing).parent_path().string() + "/.7.png.12-3.tmp.png", "half");
  WriteText(fs::path(missing).parent_path().string() + "/mine.png", "mine");
  fs::copy(Directory + "kept.tif", again + "/shaded.tif");
  Make(again);
  CHECK(fs::last_write_time(kept) == date);
  auto contents = Contents(again);
  CHECK(contents.erase(
          fs::path(missing).parent_path().lexically_relative(again).string() + "/mine.png") == 1);
  CHECK(contents == whole);

  // Another run does not.
  const std::string message = Thrown([&] { WebTiles(again, "another run"); });
  CHECK(Contains(message, again) && Contains(message, "\"a run\""));

  // It ends when it is told to.
  Prepare(again);
  {
    WebTiles tiles(again, "a run");
    int asked = 0;
    bool aborted = false;
    try
    {
      tiles.Make(
        tiles.Plan(256, {}), [&asked](double share) { return share <= 1.0 && ++asked < 4; });
    }
    catch (const relief::io::Aborted&)
    {
      aborted = true;
    }
    CHECK(aborted && tiles.HasPicture() && !tiles.AreDone());
    tiles.Forget();
    CHECK(fs::exists(again + "/run.txt")); // there are tiles
  }
  Make(again);
  CHECK(Contents(again) == whole);

  // A tile of the run that somebody has spoilt is named.
  Prepare(again);
  const std::string spoilt = TileName(again, plan.Zoom[1], span.Columns[0], span.Rows[0] + 1);
  fs::create_directories(fs::path(spoilt).parent_path());
  WriteText(spoilt, "no picture");
  const std::string spoiltMessage = Thrown([&] { Make(again); });
  CHECK(Contains(spoiltMessage, ".png") && Contains(spoiltMessage, "remove it"));

  // A run that came to nothing leaves nothing.
  WebTiles(Directory + "nothing", "a run").Forget();
  CHECK(!fs::exists(Directory + "nothing"));
}

#ifndef _WIN32
std::size_t NumberOfFiles(const std::string& folder)
{
  std::error_code none; // while others make and rename files there
  std::size_t count = 0;
  for (fs::recursive_directory_iterator at(folder, none), end; !none && at != end;
       at.increment(none))
  {
    ++count;
  }
  return count;
}

void TestKilled()
{
  const auto whole = Contents(Directory + "whole");
  const std::string folder = Directory + "killed";
  Prepare(folder);
  std::mt19937 random(8);
  int kills = 0;
  for (int round = 0; round < 12 && !fs::exists(folder + "/tiles.json"); ++round)
  {
    const pid_t child = fork();
    if (child == 0)
    {
      vtkSMPTools::Initialize(1); // threads do not live on in a child
      {
        WebTiles tiles(folder, "a run");
        tiles.Make(tiles.Plan(256, {}), {});
      }
      _exit(0);
    }
    // As soon as it has made some files more, or a little later.
    const std::size_t wanted = NumberOfFiles(folder) + random() % 6;
    int status = 0;
    pid_t ended = 0;
    do
    {
      std::this_thread::sleep_for(std::chrono::milliseconds(random() % 30));
      ended = waitpid(child, &status, WNOHANG);
    } while (ended == 0 && NumberOfFiles(folder) < wanted);
    if (ended == 0)
    {
      kill(child, SIGKILL);
      waitpid(child, &status, 0);
    }
    kills += WIFSIGNALED(status) ? 1 : 0;
  }
  const std::size_t made = Contents(folder).size();
  std::cout << kills << " processes were killed; " << made << " files were there" << std::endl;
  CHECK(kills > 1 && made > 5);
  if (!fs::exists(folder + "/tiles.json"))
  {
    Make(folder);
  }
  fs::remove(folder + "/shaded.tif");
  WebTiles(folder, "a run"); // the lock of one that was killed at its very end goes
  CHECK(Contents(folder) == whole);
}

void TestFullDisk()
{
  const std::string folder = Directory + "full";
  Prepare(folder);
  const pid_t child = fork();
  if (child == 0)
  {
    vtkSMPTools::Initialize(1);
    WebTiles tiles(folder, "a run");
    const TilePlan plan = tiles.Plan(256, {});
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit small = { 30000, 30000 };
    setrlimit(RLIMIT_FSIZE, &small);
    const std::string message = Thrown([&] { tiles.Make(plan, {}); });
    std::cout << message << std::endl;
    _exit(Contains(message, ".png: cannot be written: ") ? 0 : 1);
  }
  int status = 0;
  waitpid(child, &status, 0);
  CHECK(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  for (const auto& [name, text] : Contents(folder))
  {
    CHECK(!Contains(name, ".tmp"));
  }
  Make(folder);
  CHECK(Contents(folder) == Contents(Directory + "whole"));
}
#endif
}

int TestWebTiles(int argc, char* argv[])
{
  Directory = EmptyDirectory(argc, argv, "WebTiles");
  TestSamples();
  TestSeams();
  TestPlaces();
  TestGoingOn();
#ifndef _WIN32
  TestKilled();
  TestFullDisk();
#endif
  return Failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
