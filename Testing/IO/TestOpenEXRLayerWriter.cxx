// SPDX-License-Identifier: BSD-3-Clause
// vtkOpenEXRLayerWriter: layers that sum to the colour, names, number types, metadata.
#include "vtkOpenEXRLayerWriter.h"

#include "vtkErrorCode.h"
#include "vtkExecutive.h"
#include "vtkLight.h"
#include "vtkOpenImageIOReader.h"
#include "vtkReliefEnvironment.h"
#include "vtkReliefMaterial.h"
#include "vtkReliefScene.h"
#include "vtkUnsignedCharArray.h"

#include "OpenEXRLayerTestUtilities.h"

#include <ImfCheckFile.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfStringAttribute.h>
#include <ImfVecAttribute.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <set>
#include <sstream>

namespace
{
// Base, Diffuse, Scatter and Specular sum to the colour: within the roundings of four sums.
void CheckSums(const Layers& file)
{
  double largest = 0.0;
  bool scatters = false;
  for (const char* c : { "R", "G", "B" })
  {
    const std::string suffix = std::string(".") + c;
    const int color = file.Index(c);
    const int base = file.Index("Base" + suffix);
    const int diffuse = file.Index("Diffuse" + suffix);
    const int scatter = file.Index("Scatter" + suffix);
    const int specular = file.Index("Specular" + suffix);
    for (int j = 0; j < file.Spec.height; ++j)
    {
      for (int i = 0; i < file.Spec.width; ++i)
      {
        const double sum = static_cast<double>(file.At(base, i, j)) + file.At(diffuse, i, j) +
          file.At(scatter, i, j) + file.At(specular, i, j);
        largest = std::max(largest, std::abs(sum - file.At(color, i, j)));
        scatters = scatters || file.At(scatter, i, j) > 0.0f;
      }
    }
  }
  CHECK_NEAR(largest, 0.0, 4.0 * std::numeric_limits<float>::epsilon());
  CHECK(scatters || file.Spec.width == 1);
}

void TestLayers()
{
  const int sizes[][2] = { { 1, 1 }, { 1, 9 }, { 37, 71 }, { 130, 3 }, { 64, 32 } };
  const std::string name = Directory + "layers.exr";
  for (const auto& size : sizes)
  {
    vtkNew<vtkReliefScene> scene;
    auto image = MakeShaded(size[0], size[1], scene);
    for (int compression = vtkOpenEXRLayerWriter::NoCompression;
         compression < vtkOpenEXRLayerWriter::DWAA; ++compression)
    {
      for (int tileSize : { 0, 8, 64 })
      {
        vtkNew<vtkOpenEXRLayerWriter> writer;
        writer->SetCompression(compression);
        writer->SetTiled(tileSize > 0);
        writer->SetTileSize(tileSize);
        WriteGood(writer, image, name);
        const Layers file(name);
        CHECK(file.Spec.width == size[0] && file.Spec.height == size[1]);
        CHECK(file.Spec.tile_width == tileSize && file.Spec.tile_height == tileSize);
        static const char* const names[] = { "none", "zips", "zip", "piz" };
        CHECK(file.Spec.get_string_attribute("compression") == names[compression]);
        CompareWithArrays(file, image);
        CheckSums(file);
      }
    }
  }

  // More than one band of rows, and the reader of this module, which takes the colour first.
  vtkNew<vtkReliefScene> scene;
  auto large = MakeShaded(520, 460, scene);
  for (bool tiled : { false, true })
  {
    vtkNew<vtkOpenEXRLayerWriter> writer;
    writer->SetTiled(tiled);
    WriteGood(writer, large, name);
    CompareWithArrays(Layers(name), large);
  }
  vtkNew<vtkOpenImageIOReader> reader;
  reader->SetFileName(name.c_str());
  reader->Update();
  int wrong = 0;
  for (int c = 0; c < 4; ++c)
  {
    wrong += Value(reader->GetOutput(), nullptr, 20, 450, c) != Value(large, nullptr, 27, 446, c);
  }
  CHECK(wrong == 0);
}

//------------------------------------------------------------------------------
void TestHalf()
{
  vtkNew<vtkReliefScene> scene;
  auto image = MakeShaded(40, 30, scene);
  vtkNew<vtkOpenEXRLayerWriter> writer;
  writer->SetPixelTypeToHalf();
  const std::string name = Directory + "half.exr";
  WriteGood(writer, image, name);
  const Layers file(name);
  CHECK(file.Type("R") == OIIO::TypeHalf && file.Type("A") == OIIO::TypeHalf);
  CHECK(file.Type("Diffuse.G") == OIIO::TypeHalf && file.Type("Normals.Z") == OIIO::TypeHalf);
  CHECK(file.Type("Thickness.Z") == OIIO::TypeFloat);
  CHECK(file.Type("Illumination.Y") == OIIO::TypeFloat);
  double worst = 0.0;
  for (int j = 0; j < 30; ++j)
  {
    for (int i = 0; i < 40; ++i)
    {
      const double value = Value(image, nullptr, i + 7, j - 4, 1);
      // Half a unit in the last of 11 places.
      worst = std::max(worst, std::abs(file("G", i, j) - value) / std::max(value, 1e-4));
    }
  }
  CHECK(worst > 0.0);
  CHECK_NEAR(worst, 0.0, 0.5 / 1024.0);

  // What half cannot hold becomes its largest number, and is counted.
  vtkNew<vtkImageData> bright;
  bright->SetDimensions(4, 1, 1);
  bright->AllocateScalars(VTK_FLOAT, 3);
  auto* values = static_cast<float*>(bright->GetScalarPointer());
  const float given[12] = { 65504.0f, 65519.0f, 65520.0f, -1e6f, 1e38f, Infinity, -Infinity, NaN,
    6e-8f, 0.0f, 1.0f, 2049.0f };
  const float held[12] = { 65504.0f, 65504.0f, 65504.0f, -65504.0f, 65504.0f, Infinity, -Infinity,
    0.0f, 5.9604645e-8f, 0.0f, 1.0f, 2048.0f };
  std::copy_n(given, 12, values);
  MessageKeeper messages(writer);
  writer->SetInputData(bright);
  writer->Write();
  CHECK(writer->GetErrorCode() == vtkErrorCode::NoError);
  CHECK(messages.OneWarning("4 values are too large"));
  const std::vector<float>& back = Layers(name).Values;
  CHECK(std::equal(back.begin(), back.end(), held, held + 12));
  writer->SetPixelTypeToFloat();
  writer->Write();
  CHECK(messages.Silent());
  CHECK(Layers(name).Values[4] == 1e38f);

  // Float holds less than double does.
  vtkNew<vtkImageData> precise;
  precise->SetDimensions(3, 1, 1);
  precise->AllocateScalars(VTK_DOUBLE, 1);
  precise->SetScalarComponentFromDouble(0, 0, 0, 0, 0.1);
  precise->SetScalarComponentFromDouble(1, 0, 0, 0, -1e300);
  precise->SetScalarComponentFromDouble(2, 0, 0, 0, Infinity);
  writer->SetInputData(precise);
  writer->Write();
  CHECK(messages.OneWarning("1 values are too large"));
  const Layers doubles(name);
  CHECK(doubles("Y", 0, 0) == 0.1f && doubles("Y", 2, 0) == Infinity);
  CHECK(doubles("Y", 1, 0) == -std::numeric_limits<float>::max());
}

//------------------------------------------------------------------------------
void TestDWAA()
{
  vtkNew<vtkReliefScene> scene;
  auto image = MakeShaded(200, 150, scene);
  vtkNew<vtkOpenEXRLayerWriter> writer;
  const std::string name = Directory + "dwaa.exr";
  auto largestError = [&](const Layers& file, const char* channel, const char* array, int component)
  {
    double largest = 0.0;
    for (int j = 0; j < 150; ++j)
    {
      for (int i = 0; i < 200; ++i)
      {
        const float value = Value(image, array, i + 7, j - 4, component);
        const float stored = file(channel, i, j);
        largest = std::max<double>(
          largest, std::isnan(value) || value == stored ? 0.0 : std::abs(stored - value));
      }
    }
    return largest;
  };
  WriteGood(writer, image, name);
  const auto zip = std::filesystem::file_size(name);
  writer->SetCompressionToDWAA();
  for (bool tiled : { false, true })
  {
    writer->SetTiled(tiled);
    WriteGood(writer, image, name);
    CHECK(std::filesystem::file_size(name) < zip);
    const Layers file(name);
    CHECK(largestError(file, "R", nullptr, 0) > 0.0);
    CHECK_NEAR(largestError(file, "R", nullptr, 0), 0.0, 0.1);
    CHECK_NEAR(largestError(file, "Diffuse.G", "Diffuse", 1), 0.0, 0.1);
    CHECK(largestError(file, "A", nullptr, 3) == 0.0);
    CHECK(largestError(file, "Thickness.Z", "Thickness", 0) == 0.0);
    CHECK(largestError(file, "Normals.X", "Normals", 0) == 0.0);
  }
  const double usual = largestError(Layers(name), "R", nullptr, 0);
  const auto usualSize = std::filesystem::file_size(name);
  writer->SetDWACompressionLevel(500.0);
  WriteGood(writer, image, name);
  CHECK(largestError(Layers(name), "R", nullptr, 0) > usual);
  CHECK(std::filesystem::file_size(name) < usualSize);
}

//------------------------------------------------------------------------------
void TestNoData()
{
  vtkNew<vtkReliefScene> scene;
  auto image = MakeShaded(9, 8, scene);
  // Light from below the horizon never leaves the material, but for the floor.
  scene->GetMaterial()->UseFloorOff();
  scene->RemoveAllLights();
  scene->AddSun(0.0, -30.0);
  auto dark = MakeShaded(9, 8, scene);
  vtkNew<vtkOpenEXRLayerWriter> writer;
  const std::string name = Directory + "nodata.exr";
  WriteGood(writer, image, name);
  const std::vector<float>& all = Layers(name).Values;
  CHECK(std::none_of(all.begin(), all.end(), [](float v) { return std::isnan(v); }));
  writer->SetNoDataValue(-1.5);
  WriteGood(writer, image, name);
  const Layers marked(name);
  CHECK(marked("Diffuse.R", 3, 2) == -1.5f && marked("Thickness.Z", 3, 2) == -1.5f);
  CHECK(marked("R", 3, 2) == 0.0f && marked("A", 3, 2) == 0.0f && marked("A", 4, 2) == 1.0f);
  for (bool half : { false, true })
  {
    writer->SetNoDataValue(NaN);
    writer->SetPixelType(half ? vtkOpenEXRLayerWriter::Half : vtkOpenEXRLayerWriter::Float);
    WriteGood(writer, image, name);
    const Layers kept(name);
    CHECK(std::isnan(kept("Diffuse.R", 3, 2)) && std::isnan(kept("Illumination.Y", 3, 2)));
    CHECK(!std::isnan(kept("Diffuse.R", 2, 2)));
  }
  MessageKeeper messages(writer);
  writer->SetNoDataValue(Infinity);
  CHECK(messages.OneError("SetNoDataValue: inf") && std::isnan(writer->GetNoDataValue()));
  const vtkMTimeType time = writer->GetMTime();
  writer->SetNoDataValue(NaN);
  CHECK(writer->GetMTime() == time);

  vtkNew<vtkReliefScene> night;
  night->AddSun(0.0, -30.0);
  vtkNew<vtkImageReliefShading> shading;
  shading->SetInputData(MakeHeights(3, 3, [](int, int) { return 1.0; }));
  shading->SetScene(night);
  shading->GenerateThicknessOn();
  shading->Update();
  WriteGood(writer, shading->GetOutput(), name);
  CHECK(Layers(name)("Thickness.Z", 1, 1) == Infinity);
}

//------------------------------------------------------------------------------
void TestNames()
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(3, 2, 1);
  image->AllocateScalars(VTK_FLOAT, 3);
  image->GetPointData()->GetScalars()->Fill(0.25);
  auto add = [&](const char* name, int components)
  {
    vtkNew<vtkFloatArray> array;
    array->SetName(name);
    array->SetNumberOfComponents(components);
    array->SetNumberOfTuples(6);
    array->Fill(0.5);
    image->GetPointData()->AddArray(array);
  };
  add("Mist", 1);
  add("Overlay", 4);
  add("Wind", 3);
  add("Slope", 3);
  add("light.key", 3);
  image->GetPointData()->SetActiveVectors("Wind");
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  ghosts->SetNumberOfTuples(6);
  ghosts->Fill(0);
  image->GetPointData()->AddArray(ghosts);
  vtkNew<vtkOpenEXRLayerWriter> writer;
  const std::string name = Directory + "names.exr";
  WriteGood(writer, image, name);
  const Layers file(name);
  const std::set<std::string> names(file.Spec.channelnames.begin(), file.Spec.channelnames.end());
  const std::set<std::string> expected = { "R", "G", "B", "Mist.Y", "Overlay.R", "Overlay.G",
    "Overlay.B", "Overlay.A", "Wind.X", "Wind.Y", "Wind.Z", "Slope.R", "Slope.G", "Slope.B",
    "light.key.R", "light.key.G", "light.key.B" };
  CHECK(names == expected);
  CHECK(file("Wind.Z", 2, 1) == 0.5f && file("B", 0, 0) == 0.25f);
}

//------------------------------------------------------------------------------
void TestMetadata()
{
  vtkNew<vtkReliefScene> scene;
  auto image = MakeShaded(12, 10, scene);
  vtkLight* off = scene->AddSun(10.0, 10.0);
  off->SwitchOff();
  vtkNew<vtkLight> lamp;
  lamp->SetLightTypeToSceneLight();
  lamp->PositionalOn();
  lamp->SetPosition(1011.5, 2003.25, 77.0);
  scene->AddLight(lamp);
  scene->SetHeightScale(1.5);
  scene->SetTolerance(0.01);
  vtkNew<vtkOpenEXRLayerWriter> writer;
  writer->SetScene(scene);
  writer->SetAttribute("owner", "The Alps");
  writer->SetAttribute("comments",
    "Gr\xc3\xbc\xc3\x9f"
    "e");
  writer->SetAttribute(std::string(100, 'n'), "long");
  const std::string name = Directory + "metadata.exr";
  WriteGood(writer, image, name);
  const Layers file(name);
  const OIIO::ImageSpec& spec = file.Spec;
  auto number = [&](const char* attribute) { return spec.get_float_attribute(attribute, NaN); };
  CHECK(spec.get_int_attribute("relief:lights") == 3);
  CHECK_NEAR(number("relief:light1:azimuth"), 310.0, 1e-4);
  CHECK_NEAR(number("relief:light1:altitude"), 35.0, 1e-5);
  CHECK_NEAR(number("relief:light2:azimuth"), 120.0, 1e-5);
  CHECK_NEAR(number("relief:light2:altitude"), -20.0, 1e-5);
  CHECK(number("relief:light2:intensity") == 0.4f);
  CHECK(spec.get_string_attribute("relief:light2:kind") == "sun");
  CHECK(spec.get_string_attribute("relief:light3:kind") == "point");
  CHECK(std::isnan(number("relief:light4:azimuth")));
  CHECK_NEAR(number("relief:subsurfaceDepth"), 2.5, 0.0); // automatic: the mean spacing
  CHECK(number("relief:specularCoefficient") == 0.2f);
  CHECK(number("relief:forwardScatterCoefficient") == 0.3f);
  CHECK(number("relief:specularPower") == 3.0f && number("relief:forwardScatterPower") == 1.0f);
  CHECK(number("relief:floorHeight") == -5.0f);
  CHECK(number("relief:heightScale") == 1.5f && number("relief:tolerance") == 0.01f);
  CHECK(spec.get_string_attribute("relief:integrator") == "Exact");
  CHECK(spec.get_string_attribute("relief:attenuation") == "Reciprocal");
  CHECK(spec.get_string_attribute("relief:offsetMode") == "TangentPlane");
  CHECK(std::isnan(number("relief:density")));
  CHECK(spec.get_string_attribute("Software").find("ReliefShading ") == 0);
  CHECK_NEAR(number("PixelAspectRatio"), 2.0 / 3.0, 1e-7);

  {
    const Imf::InputFile input(name.c_str());
    const Imf::Header& header = input.header();
    const auto& origin = header.typedAttribute<Imf::V3dAttribute>("relief:origin").value();
    CHECK(origin == Imath::V3d(1000.0 + 7 * 2.0, 2000.0 - 4 * 3.0, 2.0));
    const auto& spacing = header.typedAttribute<Imf::V3dAttribute>("relief:spacing").value();
    CHECK(spacing == Imath::V3d(2.0, 3.0, 1.0));
    const auto& color = header.typedAttribute<Imf::V3fAttribute>("relief:light1:color").value();
    CHECK(color == Imath::V3f(1.0f, 0.9f, 0.7f));
    const auto& diffuse = header.typedAttribute<Imf::V3fAttribute>("relief:diffuseColor").value();
    CHECK(diffuse == Imath::V3f(0.9f, 0.7f, 0.4f));
    const auto& position =
      header.typedAttribute<Imf::V3dAttribute>("relief:light3:position").value();
    CHECK(position == Imath::V3d(1011.5, 2003.25, 77.0));
    const auto& range = header.typedAttribute<Imf::V2fAttribute>("relief:specularRange").value();
    CHECK(range == Imath::V2f(0.0f, 1.0f));
    CHECK(header.findTypedAttribute<Imf::StringAttribute>("owner")->value() == "The Alps");
    CHECK(header.findTypedAttribute<Imf::StringAttribute>("comments")->value() ==
      writer->GetAttribute("comments"));
    CHECK(
      header.findTypedAttribute<Imf::StringAttribute>(std::string(100, 'n'))->value() == "long");
    CHECK(header.find("chromaticities") != header.end());
  }

  // The sun of a scene without lights, and the other modes.
  vtkNew<vtkReliefScene> plain;
  plain->SetIntegratorToFixedStep();
  plain->SetNumberOfSteps(99);
  plain->GetMaterial()->SetSubsurfaceDepth(7.0);
  plain->GetMaterial()->SetAttenuationToExponential();
  plain->GetMaterial()->SetDensity(0.25);
  plain->GetMaterial()->SetOffsetModeToSurfaceNormal();
  writer->SetScene(plain);
  writer->RemoveAllAttributes();
  WriteGood(writer, image, name);
  const Layers other(name);
  CHECK(other.Spec.get_int_attribute("relief:lights") == 1);
  CHECK_NEAR(other.Spec.get_float_attribute("relief:light1:azimuth"), 315.0, 1e-4);
  CHECK_NEAR(other.Spec.get_float_attribute("relief:light1:altitude"), 45.0, 1e-5);
  CHECK(other.Spec.get_float_attribute("relief:subsurfaceDepth") == 7.0f);
  CHECK(other.Spec.get_float_attribute("relief:density") == 0.25f);
  CHECK(other.Spec.get_string_attribute("relief:integrator") == "FixedStep");
  CHECK(other.Spec.get_int_attribute("relief:numberOfSteps") == 99);
  CHECK(other.Spec.get_string_attribute("relief:attenuation") == "Exponential");
  CHECK(other.Spec.get_string_attribute("relief:offsetMode") == "SurfaceNormal");
  CHECK(other.Spec.find_attribute("relief:floorHeight") == nullptr);
  CHECK(other.Spec.find_attribute("owner") == nullptr);

  // An environment, which takes the place of that sun, and a sun with a disc.
  vtkNew<vtkReliefScene> sky;
  sky->SetLightsToSkyDome();
  sky->GetEnvironment()->SetRotationZ(30.0);
  writer->SetScene(sky);
  WriteGood(writer, image, name);
  const Layers dome(name);
  CHECK(dome.Spec.get_int_attribute("relief:lights", -1) == 0);
  CHECK(dome.Spec.get_string_attribute("relief:environment:sampling") == "SolidAngle");
  CHECK(dome.Spec.get_int_attribute("relief:environment:numberOfSamples") == 128);
  CHECK(dome.Spec.get_float_attribute("relief:environment:rotationZ") == 30.0f);
  CHECK(dome.Spec.get_float_attribute("relief:environment:tilt", NaN) == 0.0f);
  CHECK(dome.Spec.get_float_attribute("relief:environment:intensity") == 0.62f);
  CHECK(dome.Spec.get_float_attribute("relief:environment:radius") == Infinity);
  sky->SetLightsToSunAndSky(200.0, 30.0);
  WriteGood(writer, image, name);
  const Layers sun(name);
  CHECK(sun.Spec.get_int_attribute("relief:lights") == 1);
  CHECK(sun.Spec.get_float_attribute("relief:light1:angularDiameter") == 0.533f);
  CHECK(sun.Spec.get_string_attribute("relief:environment:sampling") == "Importance");

  // Without a scene only the image speaks.
  writer->SetScene(nullptr);
  WriteGood(writer, image, name);
  CHECK(Layers(name).Spec.find_attribute("relief:lights") == nullptr);
}

//------------------------------------------------------------------------------
void TestSettings()
{
  vtkNew<vtkOpenEXRLayerWriter> writer;
  writer->SetPixelType(-3);
  CHECK(writer->GetPixelType() == vtkOpenEXRLayerWriter::Half);
  writer->SetCompression(77);
  CHECK(writer->GetCompression() == vtkOpenEXRLayerWriter::DWAA);
  writer->SetCompressionToNone();
  CHECK(writer->GetCompression() == vtkOpenEXRLayerWriter::NoCompression);
  writer->SetTileSize(1);
  CHECK(writer->GetTileSize() == 8);
  writer->SetTileSize(100000);
  CHECK(writer->GetTileSize() == 4096);
  writer->SetAttribute("owner", "me");
  const vtkMTimeType time = writer->GetMTime();
  writer->SetAttribute("owner", "me");
  writer->SetAttribute("nobody", nullptr);
  CHECK(writer->GetMTime() == time);
  writer->SetAttribute("owner", nullptr);
  CHECK(writer->GetMTime() > time && writer->GetAttribute("owner") == nullptr);
  vtkNew<vtkReliefScene> scene;
  writer->SetScene(scene);
  CHECK(writer->GetScene() == scene);
  const vtkMTimeType before = writer->GetMTime();
  scene->GetMaterial()->SetDensity(0.125);
  CHECK(writer->GetMTime() > before);
  writer->SetAttribute("comments", "mine");
  std::ostringstream text;
  writer->Print(text);
  for (const char* member : { "Scene:\n", "Density: 0.125", "PixelType: Half", "Compression: None",
         "DWACompressionLevel: 45", "Tiled: Off", "TileSize: 4096", "NoDataValue: 0",
         "comments: mine" })
  {
    CHECK(text.str().find(member) != std::string::npos);
  }
}
}

int TestOpenEXRLayerWriter(int argc, char* argv[])
{
  Directory = EmptyDirectory(argc, argv, "TestOpenEXRLayerWriter");
  TestLayers();
  TestHalf();
  TestDWAA();
  TestNoData();
  TestNames();
  TestMetadata();
  TestSettings();
  return Failures;
}
