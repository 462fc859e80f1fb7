// SPDX-License-Identifier: BSD-3-Clause
//
// Pieces of a picture, made of the pieces of the heights that they ask for, are bit for bit those
// of the whole, and ask for no more than they need.
#include "ReliefPieceSource.h"
#include "ReliefTextureTestUtilities.h"
#include "SparseTerrain.h"

#include "vtkImageDataStreamer.h"
#include "vtkIntArray.h"
#include "vtkLight.h"
#include "vtkLookupTable.h"
#include "vtkReliefEnvironment.h"
#include "vtkReliefMaterial.h"
#include "vtkReliefScene.h"
#include "vtkReliefStatistics.h"
#include "vtkSMPTools.h"
#include "vtkShortArray.h"
#include "vtkUnsignedCharArray.h"

#include "ReservedMemory.h"

#include <cstdlib>

namespace
{
int Failures = 0;

constexpr int Region = relief::RasterBounds::RegionSize;

// Heights as some type of number, holes as NaN or, where there is none, as the lowest value.
struct Field
{
  vtkSmartPointer<vtkImageData> heights;
  double range[2];
  double noData = 0.0;
  bool marked = false;
  bool any = false;
};

Field MakeField(Random& random, const Terrain& terrain)
{
  Field field;
  const int kind = random.Integer(0, 3);
  const double marker = -32000.0;
  const double lift = random.Chance(0.2) ? 1e6 : 0.0;
  auto whole = [&](double h) { return std::isnan(h) ? marker : std::floor(h); };
  auto height = [&](int i, int j) { return terrain.At(i, j); };
  switch (kind)
  {
    case 0:
      field.heights = MakeHeights(terrain.columns, terrain.rows, height);
      break;
    case 1:
      field.heights = MakeHeights<vtkDoubleArray>(
        terrain.columns, terrain.rows, [&](int i, int j) { return lift + height(i, j); });
      break;
    case 2:
      field.heights = MakeHeights<vtkIntArray>(terrain.columns, terrain.rows,
        [&](int i, int j)
        { return std::isnan(height(i, j)) ? marker : whole(height(i, j)) + lift; });
      break;
    default:
      field.heights = MakeHeights<vtkShortArray>(terrain.columns, terrain.rows,
        [&](int i, int j) { return std::clamp(whole(height(i, j)), marker, 32000.0); });
  }
  field.marked = kind >= 2;
  field.noData = marker;
  field.range[0] = std::numeric_limits<double>::infinity();
  field.range[1] = -field.range[0];
  vtkDataArray* values = field.heights->GetPointData()->GetScalars();
  for (vtkIdType k = 0; k < values->GetNumberOfTuples(); ++k)
  {
    const double h = values->GetTuple1(k);
    if (std::isfinite(h) && !(field.marked && h == marker))
    {
      field.range[0] = std::min(field.range[0], h);
      field.range[1] = std::max(field.range[1], h);
      field.any = true;
    }
  }
  // Extents need not begin at 0, nor images at the world's origin.
  field.heights->SetSpacing(
    terrain.spacingX, random.Chance(0.2) ? -terrain.spacingY : terrain.spacingY, 1.0);
  if (random.Chance(0.5))
  {
    const int i = random.Integer(-50, 50);
    const int j = random.Integer(-50, 50);
    field.heights->SetExtent(i, i + terrain.columns - 1, j, j + terrain.rows - 1, 0, 0);
  }
  return field;
}

// A scene of the model's tests as one of VTK's.
void Assign(Random& random, const relief::Scene& from, const Field& field, vtkReliefScene* scene)
{
  const int* extent = field.heights->GetExtent();
  const double* spacing = field.heights->GetSpacing();
  for (const relief::Light& light : from.lights)
  {
    vtkNew<vtkLight> converted;
    converted->SetLightTypeToSceneLight();
    converted->SetPositional(light.positional);
    const double offset = light.positional ? 1.0 : 0.0;
    converted->SetPosition(light.vector.x + offset * extent[0] * spacing[0],
      light.vector.y + offset * extent[2] * spacing[1], light.vector.z);
    converted->SetIntensity(light.weight);
    scene->AddLight(converted);
  }
  if (!from.sun.empty())
  {
    scene->AddSun(random.Uniform(0.0, 360.0), random.Logarithmic(1.0, 90.0),
      random.Chance(0.5) ? random.Uniform(0.0, 5.0) : 0.0);
    scene->SetNumberOfSunSamples(4);
  }
  if (random.Chance(0.15))
  {
    vtkNew<vtkReliefEnvironment> sky;
    sky->SetImageToWhiteDome();
    sky->SetNumberOfSamples(16);
    if (random.Chance(0.2))
    {
      sky->SetRadius(random.Logarithmic(10.0, 1e4) * spacing[0]);
    }
    scene->SetEnvironment(sky);
  }
  vtkReliefMaterial* material = scene->GetMaterial();
  material->SetSubsurfaceDepth(from.medium.depth);
  material->SetOffsetMode(from.medium.offset);
  material->SetAttenuation(from.medium.attenuation);
  material->SetDensity(from.medium.density);
  material->SetUseFloor(from.medium.useFloor);
  material->SetFloorHeight(from.medium.floorHeight);
  material->SetSpecularCoefficient(from.specularCoefficient);
  material->SetForwardScatterCoefficient(from.scatterCoefficient);
  material->SetForwardScatterRange(-1.0, 1.0);
  scene->SetTolerance(from.medium.tolerance);
  if (from.integrator == relief::Integrator::FixedStep)
  {
    scene->SetIntegratorToFixedStep();
    scene->SetNumberOfSteps(from.steps);
  }
  if (random.Chance(0.1))
  {
    scene->SetResponse(random.Integer(1, 2));
  }
  scene->SetHeightScale(random.Chance(0.2) ? random.Uniform(-1.0, 1.5) : 1.0);
}

// What else a filter may be given, the same for the same random numbers.
void Dress(Random random, const Field& field, vtkImageReliefShading* filter)
{
  if (field.marked)
  {
    filter->SetNoDataValue(field.noData);
  }
  if (random.Chance(0.3))
  {
    vtkNew<vtkLookupTable> table;
    table->SetRange(field.range[0], field.range[1] + 1.0);
    filter->SetLookupTable(table);
  }
  if (random.Chance(0.3))
  {
    auto texture = MakeTexture<vtkFloatArray>(7, 5, 4,
      [](int i, int j) {
        return Color{ 0.1 * i, 0.2 * j, 0.5, 0.7 };
      });
    texture->SetOrigin(field.heights->GetBounds()[0], field.heights->GetBounds()[2], 0.0);
    texture->SetSpacing(20.0, 30.0, 1.0);
    filter->SetDiffuseTextureData(texture);
    filter->SetStretchTextures(random.Chance(0.5));
  }
  filter->SetOutputScalarType(random.Chance(0.3) ? VTK_UNSIGNED_CHAR : VTK_FLOAT);
  filter->GenerateIlluminationOn();
  filter->SetGenerateThickness(random.Chance(0.3));
  filter->GenerateNormalsOn();
  filter->GenerateBaseOn();
  filter->GenerateDiffuseOn();
  filter->GenerateScatterOn();
  filter->GenerateSpecularOn();
}

void TestRandomPieces()
{
  const char* only = std::getenv("RELIEF_CASE");
  const char* number = std::getenv("RELIEF_CASES");
  const int cases = number ? std::atoi(number) : 200;
  std::size_t pieces = 0;
  std::size_t extents = 0;
  double asked = 0.0;
  double all = 0.0;
  for (int k = only ? std::atoi(only) : 0; k < cases; ++k)
  {
    Random random(Seed() + 1000003ull * static_cast<std::uint64_t>(k));
    const bool small = random.Chance(0.5);
    const int columns =
      random.Chance(0.1) ? random.Integer(1, 3) : random.Integer(4, small ? 130 : 500);
    const int rows =
      random.Chance(0.1) ? random.Integer(1, 3) : random.Integer(4, small ? 130 : 500);
    const Terrain terrain = MakeLargeTerrain(random, columns, rows);
    const Field field = MakeField(random, terrain);
    if (!field.any)
    {
      continue;
    }
    vtkSmartPointer<vtkImageData> mask;
    if (random.Chance(0.2))
    {
      mask = MakeHeights<vtkUnsignedCharArray>(
        columns, rows, [&](int, int) { return random.Chance(0.01) ? 0.0 : 1.0; });
      mask->SetExtent(field.heights->GetExtent());
    }
    vtkNew<vtkImageReliefShading> whole;
    MessageKeeper messages(whole);
    Assign(random, MakeLargeScene(random, terrain, field.range[0], field.range[1]), field,
      whole->GetScene());
    const Random dress(random.Integer(0, 1 << 30));
    Dress(dress, field, whole);
    // Masked samples are no data, and may be the highest.
    double range[2] = { field.range[0], field.range[1] };
    if (mask)
    {
      range[0] = std::numeric_limits<double>::infinity();
      range[1] = -range[0];
      vtkDataArray* values = field.heights->GetPointData()->GetScalars();
      for (vtkIdType at = 0; at < values->GetNumberOfTuples(); ++at)
      {
        const double h = values->GetTuple1(at);
        if (std::isfinite(h) && !(field.marked && h == field.noData) &&
          mask->GetPointData()->GetScalars()->GetTuple1(at) != 0.0)
        {
          range[0] = std::min(range[0], h);
          range[1] = std::max(range[1], h);
        }
      }
    }
    // A range that is too wide is the same for all pieces, too.
    const bool wide = random.Chance(0.2);
    if (wide && range[0] <= range[1])
    {
      range[0] -= random.Uniform(0.0, 1.0) * (range[1] - range[0]);
      range[1] += random.Uniform(0.0, 1.0) * (range[1] - range[0]);
      whole->SetHeightRange(range);
    }
    whole->SetInputData(field.heights);
    whole->SetMaskData(mask);
    whole->Update();

    vtkNew<ReliefPieceSource> source;
    source->SetImage(field.heights);
    vtkNew<ReliefPieceSource> maskSource;
    vtkNew<vtkImageReliefShading> filter;
    MessageKeeper ofPieces(filter);
    filter->SetScene(whole->GetScene());
    Dress(dress, field, filter);
    filter->SetInputConnection(source->GetOutputPort());
    // A mask comes from a reader of its own, or from the heights'.
    if (mask && random.Chance(0.5))
    {
      source->SetSecondImage(mask);
      filter->SetMaskConnection(source->GetOutputPort(1));
    }
    else if (mask)
    {
      maskSource->SetImage(mask);
      filter->SetMaskConnection(maskSource->GetOutputPort());
    }
    if (!(range[0] <= range[1]))
    {
      continue;
    }
    filter->SetHeightRange(range);
    for (int piece = 0; piece < 3; ++piece)
    {
      const int* e = field.heights->GetExtent();
      int extent[6] = { 0, 0, 0, 0, e[4], e[5] };
      extent[0] = random.Integer(e[0], e[1]);
      extent[1] = std::min(random.Integer(extent[0], e[1]), extent[0] + 100);
      extent[2] = random.Integer(e[2], e[3]);
      extent[3] = std::min(random.Integer(extent[2], e[3]), extent[2] + 100);
      vtkSMPTools::Initialize(piece == 0 ? 1 : 3);
      filter->UpdateExtent(extent);
      ++pieces;
      const std::string difference = FindPieceDifference(filter->GetOutput(), whole->GetOutput());
      if (!difference.empty() || filter->GetOutput()->GetNumberOfPoints() == 0)
      {
        std::cout << "RELIEF_SEED=" << Seed() << " RELIEF_CASE=" << k << " piece " << piece << " ("
                  << extent[0] << ", " << extent[1] << ", " << extent[2] << ", " << extent[3]
                  << ") of " << columns << " x " << rows << ": " << difference << std::endl;
        ++Failures;
      }
      all += static_cast<double>(columns) * rows;
    }
    for (const std::array<int, 6>& e : source->Extents)
    {
      asked += (e[1] - e[0] + 1.0) * (e[3] - e[2] + 1.0);
    }
    extents += source->Extents.size();
    if (only)
    {
      break;
    }
  }
  vtkSMPTools::Initialize(0);
  std::cout << pieces << " pieces asked for " << extents << " extents, " << asked / all
            << " of the samples" << std::endl;
  CHECK(only || cases < 200 || pieces > 400);
}

// A plain with one wall.
vtkSmartPointer<vtkImageData> MakeWall(int columns, int rows, int wall, double height)
{
  return MakeHeights(columns, rows, [=](int i, int) { return i == wall ? height : 0.0; });
}

// A piece asks as far as the shadow of a wall reaches, whether it has one or not, and no farther
// than what integrators look at beside their rays, in whole regions.
void TestReach()
{
  const int columns = 2000;
  const int rows = 150;
  const double height = 301.0;
  bool reached = false;
  for (int wall = 700; wall < 1100; wall += 9)
  {
    // A sun in the east, 45 degrees high: the wall's shadow ends as many samples west of it as it
    // is high, less what points are sunk by.
    auto heights = MakeWall(columns, rows, wall, height);
    vtkNew<ReliefPieceSource> source;
    source->SetImage(heights);
    vtkNew<vtkImageReliefShading> filter;
    filter->GetScene()->AddSun(90.0, 45.0);
    filter->GetScene()->GetMaterial()->SetOffsetModeToVertical();
    filter->GetScene()->GetMaterial()->SetSubsurfaceDepth(0.5);
    filter->GenerateIlluminationOn();
    filter->SetInputData(heights);
    filter->Update();
    vtkNew<vtkImageData> whole;
    whole->DeepCopy(filter->GetOutput());
    filter->SetInputConnection(source->GetOutputPort());
    filter->SetHeightRange(0.0, height);
    int extent[6] = { 520, 575, 64, 90, 0, 0 };
    filter->UpdateExtent(extent);
    CHECK(FindPieceDifference(filter->GetOutput(), whole) == "");
    CHECK(source->Extents.size() == 1);
    const std::array<int, 6>& asked = source->Extents.back();
    // The last sample's ray, from a sunken point, is above the wall this far on.
    const int reach = extent[1] + static_cast<int>(std::ceil(height + 0.5));
    CHECK(asked[1] >= reach);
    CHECK(asked[1] <= reach + 66 + 68 + 32 + Region);
    CHECK(asked[0] <= extent[0] - 1 && asked[0] >= extent[0] - 34 - 2 * Region);
    CHECK(asked[2] >= extent[2] - 34 - 2 * Region && asked[3] <= extent[3] + 68 + 2 * Region);
    // The wall's shadow is seen by the piece just where it reaches there: on level ground d is the
    // sine of 45 degrees, behind the wall's top a little less.
    const bool shadowed = Value(filter->GetOutput(), "Illumination", extent[1], 77) < 0.705f;
    CHECK(shadowed == (wall > extent[1] && wall <= extent[1] + static_cast<int>(height)));
    reached = reached || (shadowed && wall > extent[1] + static_cast<int>(height) - 9);
  }
  CHECK(reached);
}

// The farthest wall whose shadow just reaches the piece's last column: heights asked for that were
// one sample fewer would miss it.
void TestFarthestWall()
{
  vtkNew<vtkImageReliefShading> filter;
  filter->GetScene()->AddSun(90.0, 45.0);
  filter->GetScene()->GetMaterial()->SetOffsetModeToVertical();
  filter->GetScene()->GetMaterial()->SetSubsurfaceDepth(0.5);
  filter->GetScene()->SetTolerance(0.0);
  filter->GenerateIlluminationOn();
  const int extent[6] = { 64, 127, 64, 90, 0, 0 };
  for (int height = 100; height < 180; ++height)
  {
    int last[2];
    for (const bool walled : { true, false })
    {
      // Its top is a sample wide; the ray from half below a sample of height 0 passes it there.
      const int wall = 127 + height;
      auto heights = MakeHeights(900, 150,
        [=](int i, int) { return walled && i == wall ? static_cast<double>(height) : 0.0; });
      vtkNew<ReliefPieceSource> source;
      source->SetImage(heights);
      filter->SetInputConnection(source->GetOutputPort());
      filter->SetHeightRange(0.0, height);
      int piece[6];
      std::copy_n(extent, 6, piece);
      filter->UpdateExtent(piece);
      const float d = Value(filter->GetOutput(), "Illumination", 127, 77);
      std::memcpy(&last[walled], &d, sizeof(d));
    }
    CHECK(last[0] != last[1]);
  }
}

void TestStreaming()
{
  const int size = 1100;
  auto heights = MakeHeights(size, size, Hills(3)); // 0 to about 60
  double range[2];
  heights->GetPointData()->GetScalars()->GetRange(range);
  vtkNew<vtkImageReliefShading> filter;
  filter->GetScene()->AddSun(315.0, 45.0);
  filter->GetScene()->AddSun(120.0, 60.0);
  filter->SetInputData(heights);
  filter->Update();
  vtkNew<vtkImageData> whole;
  whole->DeepCopy(filter->GetOutput());
  for (int divisions : { 1, 2, 7, 25, 100 })
  {
    vtkNew<ReliefPieceSource> source;
    source->SetImage(heights);
    vtkNew<vtkImageReliefShading> streamed;
    streamed->SetScene(filter->GetScene());
    streamed->SetInputConnection(source->GetOutputPort());
    streamed->SetHeightRange(range);
    vtkNew<vtkImageDataStreamer> streamer;
    streamer->SetInputConnection(streamed->GetOutputPort());
    streamer->SetNumberOfStreamDivisions(divisions);
    streamer->Update();
    // It hands on the scalars only, without their name.
    streamer->GetOutput()->GetPointData()->GetScalars()->SetName("Shading");
    CHECK(FindPieceDifference(streamer->GetOutput(), whole) == "");
    CHECK(streamer->GetOutput()->GetNumberOfPoints() == size * size);
    std::cout << divisions << " divisions: " << source->Extents.size() << " extents, the largest "
              << static_cast<double>(source->Largest) / (size * size) << " of all" << std::endl;
    if (divisions == 100)
    {
      // Pieces of 137 x 86 samples, with 62 / tan(45) about them and what is looked at beside rays.
      CHECK(source->Largest < size * size / 4);
    }
  }
}

// Pieces of a whole image that is at hand forget and fill what they depend on, one after the other.
void TestWholeInput()
{
  auto heights = MakeHeights(1500, 1500, Hills(9));
  double range[2];
  heights->GetPointData()->GetScalars()->GetRange(range);
  vtkNew<vtkImageReliefShading> filter;
  filter->GetScene()->AddSun(315.0, 45.0);
  filter->SetInputData(heights);
  filter->Update();
  vtkNew<vtkImageData> whole;
  whole->DeepCopy(filter->GetOutput());
  filter->SetHeightRange(range);
  for (int k = 0; k < 14; ++k)
  {
    int extent[6] = { 100 * k, 100 * k + 99, 1300 - 100 * k, 1399 - 100 * k, 0, 0 };
    filter->UpdateExtent(extent);
    CHECK(FindPieceDifference(filter->GetOutput(), whole) == "");
  }
}

// Processes ask for pieces by their number, with ghosts at their borders; there may be more of them
// than samples.
void TestNumberedPieces()
{
  auto heights = MakeHeights(700, 500, Hills(8));
  vtkNew<vtkImageReliefShading> filter;
  filter->GetScene()->AddSun(200.0, 50.0);
  filter->SetInputData(heights);
  filter->Update();
  vtkNew<vtkImageData> whole;
  whole->DeepCopy(filter->GetOutput());
  double range[2];
  heights->GetPointData()->GetScalars()->GetRange(range);
  filter->SetHeightRange(range);
  for (int pieces : { 1, 2, 3, 8 })
  {
    vtkIdType seen = 0;
    for (int piece = 0; piece < pieces; ++piece)
    {
      vtkNew<ReliefPieceSource> source;
      source->SetImage(heights);
      filter->SetInputConnection(source->GetOutputPort());
      filter->UpdatePiece(piece, pieces, 2);
      CHECK(FindPieceDifference(filter->GetOutput(), whole) == "");
      CHECK(source->Extents.size() == 1);
      CHECK(pieces < 8 || source->Largest < 700 * 500);
      seen += filter->GetOutput()->GetNumberOfPoints();
    }
    CHECK(pieces == 1 ? seen == 700 * 500 : seen > 700 * 500);
  }
  filter->SetInputData(MakeHeights(3, 2, Hills(8)));
  vtkIdType seen = 0;
  for (int piece = 0; piece < 9; ++piece)
  {
    filter->UpdatePiece(piece, 9, 0);
    seen += filter->GetOutput()->GetNumberOfPoints();
  }
  CHECK(seen >= 6);
}

// Pieces that are shaded again under other colours trace nothing.
void TestKept()
{
  vtkNew<ReliefPieceSource> source;
  source->SetImage(MakeHeights(600, 500, Hills(5)));
  vtkNew<vtkImageReliefShading> filter;
  filter->GetScene()->AddSun(315.0, 45.0);
  filter->SetInputConnection(source->GetOutputPort());
  filter->SetHeightRange(-100.0, 200.0);
  int extent[6] = { 200, 300, 200, 280, 0, 0 };
  filter->UpdateExtent(extent);
  CHECK(filter->GetStatistics()->GetLightsTraced() == 1);
  filter->GetScene()->GetMaterial()->SetDiffuseColor(0.3, 0.2, 0.1);
  filter->UpdateExtent(extent);
  CHECK(filter->GetStatistics()->GetLightsTraced() == 0);
  CHECK(filter->GetStatistics()->GetLightsReused() == 1);
  CHECK(source->Extents.size() == 1);
  // Other heights are traced anew.
  source->SetImage(MakeHeights(600, 500, Hills(6)));
  filter->UpdateExtent(extent);
  CHECK(filter->GetStatistics()->GetLightsTraced() == 1);
  vtkNew<vtkImageReliefShading> whole;
  whole->SetScene(filter->GetScene());
  whole->SetInputData(MakeHeights(600, 500, Hills(6)));
  whole->SetHeightRange(-100.0, 200.0);
  whole->Update();
  CHECK(FindPieceDifference(filter->GetOutput(), whole->GetOutput()) == "");
}

// Where rays leave the data, more heights come while the filter runs: from both ports of a reader,
// and for others who read the same source what they have asked for is there again.
void TestHoles()
{
  auto heights = MakeHeights(1500, 300, [](int i, int j) { return (i * i + 7 * j) % 40; });
  // Sea, with an island far out that rays meet long after they have come out of the ground.
  vtkDataArray* values = heights->GetPointData()->GetScalars();
  for (int j = 0; j < 300; ++j)
  {
    for (int i = 300; i < 1400; ++i)
    {
      if (i < 1390 || j % 3 == 0)
      {
        values->SetTuple1(j * 1500 + i, std::numeric_limits<double>::quiet_NaN());
      }
    }
  }
  vtkNew<vtkImageReliefShading> filter;
  filter->GetScene()->AddSun(90.0, 30.0);
  filter->GenerateIlluminationOn();
  filter->SetInputData(heights);
  filter->Update();
  vtkNew<vtkImageData> whole;
  whole->DeepCopy(filter->GetOutput());
  vtkNew<ReliefPieceSource> source;
  source->SetImage(heights);
  filter->SetInputConnection(source->GetOutputPort());
  filter->SetHeightRange(0.0, 39.0);
  int extent[6] = { 200, 305, 100, 140, 0, 0 };
  filter->UpdateExtent(extent);
  CHECK(FindPieceDifference(filter->GetOutput(), whole) == "");
  const std::size_t extents = source->Extents.size();
  CHECK(extents > 2 && source->Extents.front() == source->Extents.back());
  std::cout << "at a coast " << extents << " extents" << std::endl;
  // So nothing is brought or traced again for other colours.
  filter->GetScene()->GetMaterial()->SetDiffuseColor(0.3, 0.2, 0.1);
  filter->UpdateExtent(extent);
  CHECK(source->Extents.size() == extents);
  CHECK(filter->GetStatistics()->GetLightsReused() == 1);
  // Land is asked for once.
  int inland[6] = { 70, 90, 100, 140, 0, 0 };
  source->Extents.clear();
  source->Modified();
  filter->UpdateExtent(inland);
  CHECK(source->Extents.size() == 1);
}

void TestInvalid()
{
  auto heights = MakeHeights(300, 200, Hills(4));
  double range[2];
  heights->GetPointData()->GetScalars()->GetRange(range);
  vtkNew<ReliefPieceSource> source;
  source->SetImage(heights);
  vtkNew<vtkImageReliefShading> filter;
  MessageKeeper messages(filter);
  filter->GetScene()->AddSun(315.0, 45.0);
  filter->SetInputConnection(source->GetOutputPort());

  // Ranges that are none are refused.
  filter->SetHeightRange(range);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const auto& bad : { std::array<double, 2>{ 3.0, 2.0 }, { nan, 2.0 }, { 2.0, nan },
         { -std::numeric_limits<double>::infinity(), 0.0 } })
  {
    filter->SetHeightRange(bad[0], bad[1]);
    CHECK(messages.OneError("SetHeightRange"));
    CHECK(filter->GetHeightRange()[0] == range[0] && filter->GetHeightRange()[1] == range[1]);
  }

  // So are heights that lie outside.
  for (const auto& narrow :
    { std::array<double, 2>{ range[0], range[1] - 1.0 }, { range[0] + 1.0, range[1] } })
  {
    filter->SetHeightRange(narrow[0], narrow[1]);
    filter->Update();
    CHECK(messages.OneError("HeightRange says"));
    CHECK(filter->GetOutput()->GetNumberOfPoints() == 0);
  }
  filter->SetHeightRange(range);
  filter->Update();
  CHECK(messages.Silent() && filter->GetOutput()->GetNumberOfPoints() == 300 * 200);

  // And an input that brings less than it is asked for.
  source->Withheld = 1;
  source->Modified();
  filter->Update();
  CHECK(messages.OneError("was asked for"));
  source->Withheld = 0;
  source->Modified();

  // What depends on the whole field asks for it.
  source->Extents.clear();
  int extent[6] = { 10, 20, 10, 20, 0, 0 };
  filter->SetOutputScalarTypeToUnsignedChar();
  filter->GetScene()->AutomaticExposureOn();
  filter->UpdateExtent(extent);
  CHECK(source->Extents.back()[1] == 299 && source->Extents.back()[3] == 199);
  filter->SetOutputScalarTypeToFloat();
  filter->UseHeightRangeOff();
  source->Modified();
  filter->UpdateExtent(extent);
  CHECK(source->Extents.back()[1] == 299 && source->Extents.back()[3] == 199);
  CHECK(messages.Silent());
}
}

int TestReliefPieces(int, char*[])
{
  if (!relief::CanReserveMemory())
  {
    std::cout << "this system reserves no memory" << std::endl;
    return EXIT_SUCCESS;
  }
  std::cout << "RELIEF_SEED=" << Seed() << std::endl;
  // TBB takes no more threads than it started with.
  vtkSMPTools::SetBackend("STDThread");
  TestInvalid();
  TestReach();
  TestFarthestWall();
  TestStreaming();
  TestWholeInput();
  TestNumberedPieces();
  TestKept();
  TestHoles();
  TestRandomPieces();
  return Failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
