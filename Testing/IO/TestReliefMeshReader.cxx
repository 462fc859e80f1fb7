// SPDX-License-Identifier: BSD-3-Clause
// vtkReliefMeshReader: one mesh in every format, and files that are none, cut off or damaged: one
// message each, and nothing else printed.
#include "vtkReliefMeshReader.h"

#include "vtkBase64Utilities.h"
#include "vtkCellArray.h"
#include "vtkErrorCode.h"
#include "vtkExecutive.h"
#include "vtkLogger.h"
#include "vtkObjectFactory.h"
#include "vtkOutputWindow.h"
#include "vtkPLYWriter.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkPolyDataWriter.h"
#include "vtkSTLWriter.h"
#include "vtkXMLPolyDataWriter.h"

#include "FileTestUtilities.h"

#include <cstdint>
#include <cstdlib>
#include <random>
#include <vector>

namespace
{
int Failures = 0;
std::string Directory;

// Whether anything reached VTK's output window.
class Window : public vtkOutputWindow
{
public:
  static Window* New();
  vtkTypeMacro(Window, vtkOutputWindow);
  void DisplayText(const char* text) override { this->Texts += text; }
  void DisplayErrorText(const char* text) override { this->Texts += text; }
  void DisplayWarningText(const char* text) override { this->Texts += text; }
  // What belongs to no object cannot be heard by the reader: VTK's own format has such warnings.
  void DisplayGenericWarningText(const char*) override {}

  std::string Texts;
};
vtkStandardNewMacro(Window);

// A tent of two triangles.
vtkSmartPointer<vtkPolyData> MakeTent()
{
  auto mesh = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(0, 0, 0);
  points->InsertNextPoint(1, 0, 0.5);
  points->InsertNextPoint(1, 2, 0.5);
  points->InsertNextPoint(0, 2, 0);
  mesh->SetPoints(points);
  vtkNew<vtkCellArray> triangles;
  triangles->InsertNextCell({ 0, 1, 2 });
  triangles->InsertNextCell({ 0, 2, 3 });
  mesh->SetPolys(triangles);
  return mesh;
}

const char* const ObjText = "# tent\no tent\nv 0 0 0\nv 1 0 0.5\nv 1 2 0.5\nv 0 2 0\n"
                            "vn 0 0 1\nf 1//1 2//1 3//1\nf 1//1 3//1 4//1\n";

std::string Little(std::uint32_t number)
{
  std::string bytes;
  for (int k = 0; k < 4; ++k)
  {
    bytes += static_cast<char>(number >> (8 * k) & 0xff);
  }
  return bytes;
}

std::string GltfBuffer()
{
  std::string bytes;
  for (const float value :
    { 0.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.5f, 1.0f, 2.0f, 0.5f, 0.0f, 2.0f, 0.0f })
  {
    std::uint32_t bits = 0;
    std::memcpy(&bits, &value, 4);
    bytes += Little(bits);
  }
  for (const char index : { 0, 1, 2, 0, 2, 3 })
  {
    bytes += index;
    bytes += '\0';
  }
  return bytes;
}

// The tent, once or twice, the second 10 to the right.
std::string GltfText(bool twice, const std::string& buffer)
{
  return std::string("{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0") +
    (twice ? ",1" : "") + "]}],\"nodes\":[{\"mesh\":0}" +
    (twice ? ",{\"mesh\":0,\"translation\":[10,0,0]}" : "") +
    "],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1}]}],"
    "\"buffers\":[{\"byteLength\":60" +
    buffer +
    "}],\"bufferViews\":[{\"buffer\":0,\"byteOffset\":0,\"byteLength\":48},"
    "{\"buffer\":0,\"byteOffset\":48,\"byteLength\":12}],"
    "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\","
    "\"min\":[0,0,0],\"max\":[1,2,0.5]},"
    "{\"bufferView\":1,\"componentType\":5123,\"count\":6,\"type\":\"SCALAR\"}]}";
}

std::string Glb(bool twice)
{
  std::string text = GltfText(twice, "");
  text.resize((text.size() + 3) / 4 * 4, ' ');
  const std::string buffer = GltfBuffer();
  const std::string chunks = Little(static_cast<std::uint32_t>(text.size())) + "JSON" + text +
    Little(static_cast<std::uint32_t>(buffer.size())) + std::string("BIN\0", 4) + buffer;
  return "glTF" + Little(2) + Little(static_cast<std::uint32_t>(chunks.size() + 12)) + chunks;
}

template <class Writer>
void Write(const std::string& name, bool binary)
{
  vtkNew<Writer> writer;
  writer->SetInputData(MakeTent());
  writer->SetFileName((Directory + name).c_str());
  binary ? writer->SetFileTypeToBinary() : writer->SetFileTypeToASCII();
  writer->Write();
}

void WriteFiles()
{
  WriteText(Directory + "tent.obj", ObjText);
  WriteText(Directory + "TENT.OBJ", ObjText);
  Write<vtkPLYWriter>("text.ply", false);
  Write<vtkPLYWriter>("binary.ply", true);
  Write<vtkSTLWriter>("text.stl", false);
  Write<vtkSTLWriter>("binary.stl", true);
  Write<vtkPolyDataWriter>("text.vtk", false);
  Write<vtkPolyDataWriter>("binary.vtk", true);
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(MakeTent());
  writer->SetFileName((Directory + "tent.vtp").c_str());
  writer->Write();
  WriteText(Directory + "tent.glb", Glb(false));
  WriteText(Directory + "two.glb", Glb(true));
  WriteText(Directory + "tent.bin", GltfBuffer());
  WriteText(Directory + "tent.gltf", GltfText(false, ",\"uri\":\"tent.bin\""));
}

//------------------------------------------------------------------------------
// Whether a file has the tent, and nothing is said of it.
void ReadTent(const std::string& name)
{
  std::cout << "  " << name << std::endl;
  CHECK(vtkReliefMeshReader::IsMeshFile(Directory + name));
  vtkNew<vtkReliefMeshReader> reader;
  MessageKeeper messages(reader);
  reader->SetFileName((Directory + name).c_str());
  reader->Update();
  vtkPolyData* mesh = reader->GetOutput();
  CHECK(messages.Silent() && reader->GetErrorCode() == vtkErrorCode::NoError);
  CHECK(mesh->GetNumberOfPolys() == 2 && mesh->GetNumberOfPoints() >= 4);
  const double* bounds = mesh->GetBounds();
  CHECK(bounds[0] == 0.0 && bounds[1] == 1.0 && bounds[3] == 2.0 && bounds[5] == 0.5);
}

void TestFormats()
{
  for (const char* name : { "tent.obj", "TENT.OBJ", "text.ply", "binary.ply", "text.stl",
         "binary.stl", "text.vtk", "binary.vtk", "tent.vtp", "tent.glb", "tent.gltf" })
  {
    ReadTent(name);
  }
  WriteText(Directory + "lines.obj",
    "v 0 0 0\r\nv 1 0 0\r\nvt 0 0\r\nv 1 1 0\r\nv 0 1 0\r\nf 1/1 2/1 \\\n 3/1 4/1\r\n");
  vtkNew<vtkReliefMeshReader> lines;
  lines->SetFileName((Directory + "lines.obj").c_str());
  lines->Update();
  CHECK(lines->GetErrorCode() == vtkErrorCode::NoError);
  CHECK(lines->GetOutput()->GetNumberOfPolys() == 1);
  vtkNew<vtkReliefMeshReader> reader;
  reader->SetFileName((Directory + "two.glb").c_str());
  reader->Update();
  CHECK(reader->GetOutput()->GetNumberOfPolys() == 4);
  CHECK(reader->GetOutput()->GetBounds()[1] == 11.0);
  // Numbers that lie in a file of their own.
  const auto beside = vtkReliefMeshReader::GetFilesBeside(Directory + "tent.gltf");
  CHECK(beside.size() == 1 && beside[0] == Directory + "tent.bin");
  for (const char* alone : { "tent.glb", "tent.obj", "none.gltf" })
  {
    CHECK(vtkReliefMeshReader::GetFilesBeside(Directory + alone).empty());
  }
  CHECK(!vtkReliefMeshReader::IsMeshFile("picture.png") && !vtkReliefMeshReader::IsMeshFile("obj"));
}

//------------------------------------------------------------------------------
void Refused(const std::string& name, unsigned long code, const std::string& text)
{
  std::cout << "  " << name << ": " << text << std::endl;
  vtkNew<vtkReliefMeshReader> reader;
  MessageKeeper messages(reader);
  MessageKeeper pipeline(reader->GetExecutive());
  reader->SetFileName(name.empty() ? nullptr : (Directory + name).c_str());
  reader->Update();
  CHECK(reader->GetErrorCode() == code);
  CHECK(messages.OneError(text) && pipeline.Silent());
  CHECK(reader->GetOutput()->GetNumberOfPoints() == 0);
  CHECK(reader->GetOutput()->GetNumberOfCells() == 0);
  reader->Update();
  CHECK(messages.Silent());
}

void RefusedText(
  const std::string& name, const std::string& content, unsigned long code, const std::string& text)
{
  WriteText(Directory + name, content);
  Refused(name, code, text);
}

void TestRefusals()
{
  Refused("", vtkErrorCode::NoFileNameError, "no file name");
  Refused("none.obj", vtkErrorCode::FileNotFoundError, "none.obj\": the file does not exist");
  std::filesystem::create_directories(Directory + "folder.stl");
  Refused("folder.stl", vtkErrorCode::CannotOpenFileError, "directory");
  RefusedText("mesh.xyz", "1 2 3", vtkErrorCode::UnrecognizedFileTypeError, "'.xyz'");
  for (const char* extension : { "obj", "ply", "stl", "vtp", "vtk", "gltf", "glb" })
  {
    RefusedText(std::string("empty.") + extension, "", vtkErrorCode::PrematureEndOfFileError,
      "the file is empty");
  }
  const std::string other(200, 'x');
  RefusedText("other.obj", other, vtkErrorCode::FileFormatError, "no OBJ");
  RefusedText("other.ply", other, vtkErrorCode::FileFormatError, "no PLY");
  RefusedText("other.stl", other, vtkErrorCode::PrematureEndOfFileError, "200");
  RefusedText("other.vtp", other, vtkErrorCode::FileFormatError, "VTKFile");
  RefusedText("other.vtk", other, vtkErrorCode::FileFormatError, "vtk DataFile");
  RefusedText("other.gltf", other, vtkErrorCode::FileFormatError, "no glTF");
  RefusedText("other.glb", other, vtkErrorCode::FileFormatError, "no binary glTF");
  RefusedText("brace.gltf", "{ nonsense", vtkErrorCode::FileFormatError, "it cannot be read");
  RefusedText("nothing.gltf", GltfText(false, ",\"uri\":\"none.bin\""),
    vtkErrorCode::FileFormatError, "the file \"none.bin\" that it names is not there");

  // No polygons, and polygons of what is not there.
  RefusedText("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\np 1\nl 1 2\n",
    vtkErrorCode::FileFormatError, "no polygons: 3 points");
  RefusedText("far.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n", vtkErrorCode::FileFormatError,
    "number 4 of 3 points");
  RefusedText("back.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 -4\n", vtkErrorCode::FileFormatError,
    "number -4 of 3 points");
  RefusedText("normal.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//1 3//7\n",
    vtkErrorCode::FileFormatError, "number 7 of 1 normals");
  RefusedText("face.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf a b c\n", vtkErrorCode::FileFormatError,
    "no list of numbers");
  RefusedText("far.vtk",
    "# vtk DataFile Version 3.0\nmesh\nASCII\nDATASET POLYDATA\nPOINTS 3 float\n0 0 0 1 0 0 0 1 0\n"
    "POLYGONS 1 4\n3 0 1 5000000\n",
    vtkErrorCode::FileFormatError, "points that it does not have");
  RefusedText("slash.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3/\n", vtkErrorCode::FileFormatError,
    "no list of numbers");
  RefusedText("offsets.vtk",
    "# vtk DataFile Version 5.1\nmesh\nASCII\nDATASET POLYDATA\nPOINTS 3 float\n0 0 0 1 0 0 0 1 0\n"
    "POLYGONS 2 3\nOFFSETS vtktypeint64\n0 9\nCONNECTIVITY vtktypeint64\n0 1 2\n",
    vtkErrorCode::FileFormatError, "points that it does not have");
  RefusedText("flat.ply",
    "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n0\n",
    vtkErrorCode::FileFormatError, "x, y and z");
  std::string bytes = FileText(Directory + "binary.ply");
  bytes[bytes.size() - 4] = 4; // the last corner
  RefusedText("far.ply", bytes, vtkErrorCode::FileFormatError, "point 4 of 4, counted from 0");
  std::string text = FileText(Directory + "text.ply");
  text.replace(text.rfind('3'), 1, "-1");
  RefusedText("back.ply", text, vtkErrorCode::FileFormatError, "point -1 of 4");
  RefusedText("cloud.ply",
    "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
    "property float z\nend_header\n0 0 0\n",
    vtkErrorCode::FileFormatError, "no polygons");
  // A sanitizer ends the program where so much memory is asked for.
  if (!IsMemorySanitized)
  {
    RefusedText("cells.vtk",
      "# vtk DataFile Version 3.0\nmesh\nASCII\nDATASET POLYDATA\nPOINTS 3 float\n0 0 0 1 0 0 0 1 "
      "0\n"
      "POLYGONS 10000000000 40000000000\n3 0 1 2\n",
      vtkErrorCode::FileFormatError, "it cannot be read");
  }
  RefusedText("grid.vtk",
    "# vtk DataFile Version 3.0\nmesh\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 1 float\n0 0 0\n",
    vtkErrorCode::FileFormatError, "unstructured_grid");
  RefusedText("many.ply",
    "ply\nformat ascii 1.0\nelement vertex 4000000000\nproperty float x\nproperty float y\n"
    "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n",
    vtkErrorCode::PrematureEndOfFileError, "it ends early");
  RefusedText("type.ply",
    "ply\nformat ascii 1.0\nelement vertex 1\nproperty quad x\nend_header\n0\n",
    vtkErrorCode::FileFormatError, "damaged: 'property quad x'");
  RefusedText("count.ply", "ply\nformat ascii 1.0\nelement vertex\nend_header\n0\n",
    vtkErrorCode::FileFormatError, "damaged");
  for (const char* line : { "\n", " \t\n", "\r\n" })
  {
    RefusedText("blank.ply",
      "ply\nformat ascii 1.0\nelement vertex 1\n" + std::string(line) +
        "property float x\nproperty float y\nproperty float z\nend_header\n0 0 0\n",
      vtkErrorCode::FileFormatError, "its header has an empty line");
  }
  RefusedText("header.ply", "ply\nformat ascii 1.0\nelement vertex 1\n",
    vtkErrorCode::PrematureEndOfFileError, "end_header");
}

//------------------------------------------------------------------------------
// The tent as text, with one part of it changed.
std::string ChangedGltf(const std::string& from, const std::string& to)
{
  std::string text = GltfText(false, ",\"uri\":\"tent.bin\"");
  return text.replace(text.find(from), from.size(), to);
}

// In front of everything else.
std::string GltfWith(const std::string& more)
{
  return ChangedGltf("{\"asset\"", "{" + more + ",\"asset\"");
}

void RefusedGltf(const std::string& name, const std::string& content, const std::string& text)
{
  RefusedText(name + ".gltf", content, vtkErrorCode::FileFormatError, text);
}

// What is no number of a point or a polygon, and what VTK's loader would follow.
void TestDamagedGltf()
{
  RefusedText("long.gltf", ChangedGltf("\"byteLength\":60", "\"byteLength\":61"),
    vtkErrorCode::PrematureEndOfFileError, "61 bytes, and there are 60");
  RefusedText("view.gltf", ChangedGltf("\"byteLength\":48", "\"byteLength\":61"),
    vtkErrorCode::FileFormatError, "beyond its buffer");
  RefusedText("accessor.gltf", ChangedGltf("\"count\":6", "\"count\":600000"),
    vtkErrorCode::FileFormatError, "beyond its bufferView");
  RefusedText("name.gltf", ChangedGltf("\"POSITION\":0", "\"POSITION\":7"),
    vtkErrorCode::FileFormatError, "an accessor that is not there");
  RefusedText("node.gltf", ChangedGltf("\"nodes\":[0]", "\"nodes\":[3]"),
    vtkErrorCode::FileFormatError, "a node that is not there");
  RefusedText("circle.gltf", ChangedGltf("{\"mesh\":0}", "{\"mesh\":0,\"children\":[0]}"),
    vtkErrorCode::FileFormatError, "that has a parent");
  RefusedGltf("deep", "{\"asset\":" + std::string(100000, '['), "it cannot be read as JSON");
  RefusedGltf("list", "[{}]", "no object");
}

void TestGltfExtensions()
{
  const std::string draco = "KHR_draco_mesh_compression";
  RefusedGltf("draco",
    GltfWith("\"extensionsUsed\":[\"" + draco + "\"],\"extensionsRequired\":[\"" + draco + "\"]"),
    "it needs KHR_draco_mesh_compression, which is not read; export it without");
  RefusedGltf("quantized", GltfWith("\"extensionsRequired\":[\"KHR_mesh_quantization\"]"),
    "it needs KHR_mesh_quantization");
  RefusedGltf("number", GltfWith("\"extensionsRequired\":[7]"), "it needs (no name)");
  RefusedGltf("word", GltfWith("\"extensionsRequired\":\"KHR_x\""), "no list");
  RefusedGltf("viewless", ChangedGltf("\"bufferView\":0,\"componentType\"", "\"componentType\""),
    "has no bufferView");
  RefusedGltf("unindexed", ChangedGltf("\"bufferView\":1,\"componentType\"", "\"componentType\""),
    "has no bufferView");
  RefusedGltf("stride", ChangedGltf("\"byteLength\":48", "\"byteLength\":48,\"byteStride\":-12"),
    "beyond its buffer");
  // Those that leave the polygons as they are, and what no mesh uses.
  WriteText(Directory + "unlit.gltf", GltfWith("\"extensionsRequired\":[\"KHR_materials_unlit\"]"));
  ReadTent("unlit.gltf");
  WriteText(Directory + "unused.gltf",
    ChangedGltf("\"type\":\"SCALAR\"}",
      "\"type\":\"SCALAR\"},{\"componentType\":5126,\"count\":4,\"type\":\"VEC3\"}"));
  ReadTent("unused.gltf");
}

void TestGltfAttributes()
{
  const std::string attributes = "\"attributes\":{\"POSITION\":0}";
  const auto with = [&attributes](const std::string& more)
  { return ChangedGltf(attributes, "\"attributes\":{\"POSITION\":0" + more + "}"); };
  RefusedGltf("nothing", ChangedGltf(attributes, "\"attributes\":{}"), "has no points: a POSITION");
  RefusedGltf("normals", ChangedGltf(attributes, "\"attributes\":{\"NORMAL\":0}"), "has no points");
  RefusedGltf("without", ChangedGltf(attributes + ",", ""), "has no points");
  RefusedGltf("indices", ChangedGltf("\"indices\":1", "\"indices\":0"), "must be SCALAR");
  RefusedGltf("signed", ChangedGltf("5123", "5122"), "indices of a mesh must be SCALAR");
  RefusedGltf("points", ChangedGltf("\"POSITION\":0", "\"POSITION\":1"),
    "POSITION of a mesh must be VEC3 of FLOAT");
  RefusedGltf("integers", ChangedGltf("5126", "5121"), "POSITION of a mesh must be VEC3 of FLOAT");
  RefusedGltf("plane", ChangedGltf("\"VEC3\",\"min\":[0,0,0],\"max\":[1,2,0.5]", "\"VEC2\""),
    "POSITION of a mesh must be VEC3 of FLOAT");
  RefusedGltf("normal", with(",\"NORMAL\":1"), "NORMAL of a mesh must be VEC3");
  RefusedGltf("tangent", with(",\"TANGENT\":0"), "TANGENT of a mesh must be VEC4");
  RefusedGltf("texture", with(",\"TEXCOORD_0\":0"), "TEXCOORD_0 of a mesh must be VEC2");
  RefusedGltf("color", with(",\"COLOR_0\":1"), "COLOR_0 of a mesh must be VEC3 or VEC4");
  RefusedGltf(
    "mode", ChangedGltf("\"indices\":1", "\"indices\":1,\"mode\":7"), "mode of a mesh is 7");
  const std::string third =
    "\"type\":\"SCALAR\"},{\"bufferView\":0,\"componentType\":5126,\"count\":2,"
    "\"type\":\"VEC3\"}";
  std::string few = with(",\"NORMAL\":2");
  few.replace(few.find("\"type\":\"SCALAR\"}"), 16, third);
  RefusedGltf("few", few, "4 points, and a NORMAL for 2");
  std::string fan = ChangedGltf("\"POSITION\":0},\"indices\":1", "\"POSITION\":2},\"mode\":6");
  fan.replace(fan.find("\"type\":\"SCALAR\"}"), 16, third);
  RefusedGltf("fan", fan, "a fan of a mesh has 2 corners");
  // Shapes to change into, bones and numbers of other programs are left out, whatever they are.
  WriteText(Directory + "targets.gltf",
    ChangedGltf(
      attributes, attributes + ",\"targets\":[{\"POSITION\":1},{\"POSITION\":7,\"NORMAL\":-3}]"));
  ReadTent("targets.gltf");
  WriteText(
    Directory + "bones.gltf", with(",\"JOINTS_0\":1,\"WEIGHTS_0\":9,\"_NUMBER\":1,\"OTHER\":-2"));
  ReadTent("bones.gltf");
  // All that is read for points.
  std::string full = with(",\"NORMAL\":0,\"TANGENT\":2,\"TEXCOORD_0\":3,\"COLOR_0\":4");
  const std::string more =
    "\"type\":\"SCALAR\"},{\"bufferView\":2,\"componentType\":5126,\"count\":4,\"type\":\"VEC4\"},"
    "{\"bufferView\":0,\"componentType\":5126,\"count\":4,\"type\":\"VEC2\"},"
    "{\"bufferView\":0,\"componentType\":5121,\"normalized\":true,\"count\":4,\"type\":\"VEC4\"}";
  full.replace(full.find("\"type\":\"SCALAR\"}"), 16, more);
  const std::string view = "\"byteOffset\":48,\"byteLength\":12}";
  full.replace(full.find(view), view.size(),
    view + ",{\"buffer\":0,\"byteOffset\":0,\"byteLength\":60,\"byteStride\":12}");
  WriteText(Directory + "full.gltf", full);
  ReadTent("full.gltf");
  vtkNew<vtkReliefMeshReader> reader;
  reader->SetFileName((Directory + "full.gltf").c_str());
  reader->Update();
  vtkPointData* data = reader->GetOutput()->GetPointData();
  CHECK(data->GetNormals() && data->GetTCoords() && data->GetScalars());
  for (int k = 0; k < data->GetNumberOfArrays(); ++k)
  {
    CHECK(data->GetAbstractArray(k)->GetNumberOfTuples() == 4);
  }
}

void TestSparseGltf()
{
  const auto sparse = [](const std::string& indices)
  {
    return "\"count\":4,\"sparse\":{\"count\":2,\"indices\":{\"bufferView\":1,\"componentType\":"
           "5123" +
      indices + "},\"values\":{\"bufferView\":0,\"byteOffset\":900000000}}";
  };
  RefusedGltf("sparse", ChangedGltf("\"count\":4", sparse(",\"byteOffset\":900000000")),
    "its accessors are sparse, which is not read; export it without");
  // What the loader leaves out moves no other.
  RefusedGltf("offset", ChangedGltf("\"count\":4", sparse("")), "it cannot be read: ");
  RefusedGltf("gone", ChangedGltf("\"accessors\":[", "\"accessors\":[{},"), "it cannot be read: ");
  RefusedGltf("empty", ChangedGltf("\"meshes\":[", "\"meshes\":[{},"), "a mesh is empty");
  const std::string target = "\"attributes\":{\"POSITION\":0},\"targets\":[{\"POSITION\":2}]";
  std::string text = ChangedGltf("\"attributes\":{\"POSITION\":0}", target);
  text.replace(text.find("\"type\":\"SCALAR\"}"), 16,
    "\"type\":\"SCALAR\"},{\"componentType\":5126,\"type\":\"VEC3\"," +
      sparse(",\"byteOffset\":0") + "}");
  WriteText(Directory + "shape.gltf", text);
  ReadTent("shape.gltf");
}

void TestDeepGltf()
{
  // A chain, with the mesh at its end.
  const auto chain = [](int count)
  {
    std::string nodes;
    for (int k = 1; k < count; ++k)
    {
      nodes += "{\"children\":[" + std::to_string(k) + "]},";
    }
    return ChangedGltf("{\"mesh\":0}", nodes + "{\"mesh\":0}");
  };
  WriteText(Directory + "thousand.gltf", chain(1000));
  ReadTent("thousand.gltf");
  RefusedGltf("chain", chain(1001), "more than 1000 deep");
  RefusedGltf("stack", chain(30000), "more than 1000 deep");
  RefusedGltf("ring", ChangedGltf("{\"mesh\":0}", "{\"children\":[1]},{\"children\":[0]}"),
    "that has a parent");
  // A ring beside the scene is never walked.
  WriteText(Directory + "beside.gltf",
    ChangedGltf("{\"mesh\":0}", "{\"mesh\":0},{\"children\":[2]},{\"children\":[1]}"));
  ReadTent("beside.gltf");
}

void TestGltfBuffers()
{
  const auto named = [](const std::string& uri)
  { return GltfText(false, ",\"uri\":\"" + uri + "\""); };
  const std::string buffer = GltfBuffer();
  WriteText(Directory + "my buf.bin", buffer);
  WriteText(Directory + "100%.bin", buffer);
  WriteText(Directory + "as%20is.bin", buffer);
  for (const char* uri :
    { "my%20buf.bin", "my buf.bin", "m%79%20buf%2Ebin", "100%.bin", "100%25.bin", "as%20is.bin" })
  {
    WriteText(Directory + "named.gltf", named(uri));
    ReadTent("named.gltf");
  }
  RefusedGltf("nobody", named("no%20body%zz%.bin"), "the file \"no body%zz%.bin\"");
  RefusedGltf("zero", named("tent.bin%00"), "that it names is not there");
  std::vector<unsigned char> text(2 * buffer.size());
  const auto length =
    vtkBase64Utilities::Encode(reinterpret_cast<const unsigned char*>(buffer.data()),
      static_cast<unsigned long>(buffer.size()), text.data());
  const std::string coded(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(length));
  const std::string begin = "data:application/octet-stream;base64,";
  WriteText(Directory + "data.gltf", named(begin + coded));
  ReadTent("data.gltf");
  RefusedGltf("plain", named("data:" + coded), "without ';base64,'");
  RefusedText("short.gltf", named(begin + coded.substr(4)), vtkErrorCode::PrematureEndOfFileError,
    "60 bytes, and there are 57");
  RefusedText("wrong.gltf", named(begin + "????" + coded.substr(4)),
    vtkErrorCode::PrematureEndOfFileError, "60 bytes, and there are 0");
  RefusedText("inside.gltf", GltfText(false, ""), vtkErrorCode::PrematureEndOfFileError,
    "60 bytes, and there are 0");
}

//------------------------------------------------------------------------------
void RefusedObj(const std::string& name, const std::string& content, const std::string& text)
{
  RefusedText(name + ".obj", content, vtkErrorCode::FileFormatError, text);
}

void TestObjLines()
{
  const std::string mark = "\xEF\xBB\xBF";
  const std::string tent = "v 0 0 0\nv 1 0 .5\nv 1. 2e0 5.0E-1 # peak\nv 0 2 -0 1 0,5 x\n"
                           "vt 0 0\nvn 0 0 1\n";
  const std::string faces = "f 1/1/1 2/1/1 3/1/1\nf 1/1/1 3/1/1 4/1/1\n";
  for (const char* first : { "# tent\n", "mtllib a.mtl\n", "o tent\n" })
  {
    RefusedObj("mark", mark + first + tent + faces, "line 1: a byte order mark of UTF-8");
  }
  RefusedObj("mark", mark + tent + faces,
    "line 1: a byte order mark of UTF-8 is in front of 'v 0 0 0'; save the file without");
  const std::string point = "a point is 'v x y z', with 3 numbers";
  for (const char* first : { "v 0,5 1 2", "v 0 0 0,5", "v 0 1,5 0" })
  {
    RefusedObj("comma", std::string("# c\n") + first + "\n" + tent + faces,
      "line 2: " + point + " and decimal points, not '" + first + "'");
  }
  for (const char* first : { "v 0 0", "v", "v a b c", "v 0 0 nan", "v 0 inf 0", "v 0 0 1e999",
         "v . 0 0", "v 1e 0 0", "v 0 0 0x10", "v - 0 0", "v 0 0 1e+", "v 1.2.3 0 0" })
  {
    RefusedObj(
      "number", tent + faces + first + " \r\n", "line 9: " + point + ", not '" + first + "'");
  }
  RefusedObj("digits", tent + faces + "v 0 0 " + std::string(50, '9') + "\n", "line 9: " + point);
  RefusedObj("texture", tent + faces + "vt 0,5 1\n", "line 9: a texture point is 'vt u v', with 2");
  RefusedObj("normal", tent + faces + "vn 0 1\n", "line 9: a normal is 'vn x y z', with 3");
  // Numbers of lines count those that go on, too.
  RefusedObj("long", tent + "f 1 \\\n 2 \\\r\n 3\nv 0 0\n", "line 10: " + point);
  for (const char* mixed : { "f 1/1/1 2 3//1", "f 1 2 3/1", "f 1//1 2/1/1 3//1", "f 1/1 2/1 3//1" })
  {
    RefusedObj("mixed", tent + mixed + "\n",
      std::string("line 7: the corners of a face are written in different ways: '") + mixed + "'");
  }
  RefusedObj("apart", tent + "f 1/ 1 2/ 1 3/ 1\n", "line 7: a face is no list of numbers");
  RefusedObj("two", tent + "f 1 2\n" + faces, "line 7: a face has 2 corners, and needs 3 at least");
  RefusedObj("one", tent + "f 1/1/1\n" + faces, "line 7: a face has 1 corners");
  RefusedObj("comment", tent + "f 1 2 3 # all\n", "line 7: a comment behind a face");
  RefusedObj("none", tent + "f\n" + faces, "line 7: a face has 0 corners");
  RefusedObj("far", tent + "f 1 2 5\n", "line 7: a face names number 5 of 4 points");
}

//------------------------------------------------------------------------------
// Cut off anywhere, a file is refused or read as far as it goes, and always in one message at most.
void TestTruncated()
{
  for (const char* name : { "tent.obj", "text.ply", "binary.ply", "text.stl", "binary.stl",
         "text.vtk", "binary.vtk", "tent.vtp", "tent.glb", "tent.gltf" })
  {
    const std::string whole = FileText(Directory + name);
    const std::string cut = Directory + "cut" + std::filesystem::path(name).extension().string();
    int refused = 0;
    for (std::size_t length = 0; length < whole.size(); length += 1 + whole.size() / 150)
    {
      WriteText(cut, whole.substr(0, length));
      vtkNew<vtkReliefMeshReader> reader;
      MessageKeeper messages(reader);
      reader->SetFileName(cut.c_str());
      reader->Update();
      const bool failed = reader->GetErrorCode() != vtkErrorCode::NoError;
      CHECK(failed
          ? messages.OneError("Cannot read") && reader->GetOutput()->GetNumberOfCells() == 0
          : reader->GetOutput()->GetNumberOfPolys() > 0);
      refused += failed ? 1 : 0;
    }
    std::cout << "  " << name << ": " << refused << " refused" << std::endl;
    CHECK(refused > 50);
  }
}

//------------------------------------------------------------------------------
// With some bytes, digits or pieces changed, a file is read or refused, in one message at most. Not
// of VTK's own formats: the reader of .vtk does not survive that, and that of .vtp prints by
// itself.
void TestDamaged()
{
  constexpr unsigned int seed = 20240611;
  std::cout << "  seed " << seed << std::endl;
  std::mt19937 random(seed);
  const auto below = [&random](std::size_t count) { return random() % count; };
  for (const char* name : { "tent.obj", "text.ply", "binary.ply", "text.stl", "binary.stl",
         "tent.glb", "tent.gltf", "full.gltf" })
  {
    const std::string whole = FileText(Directory + name);
    const std::string path =
      Directory + "damaged" + std::filesystem::path(name).extension().string();
    int refused = 0;
    for (int k = 0; k < 400; ++k)
    {
      std::string text = whole;
      for (std::size_t count = 1 + below(4); count > 0; --count)
      {
        const std::size_t at = below(text.size());
        const std::size_t digit = text.find_first_of("0123456789", at);
        switch (below(4))
        {
          case 0:
            text[at] = static_cast<char>(below(256));
            break;
          case 1:
            text.replace(
              digit < text.size() ? digit : at, 1, std::to_string(below(2) ? below(12) : random()));
            break;
          case 2:
            text.erase(at, below(8));
            break;
          default:
            text.insert(at, text.substr(below(text.size()), below(16)));
        }
        text += text.empty() ? " " : "";
      }
      WriteText(path, text);
      vtkNew<vtkReliefMeshReader> reader;
      MessageKeeper messages(reader);
      reader->SetFileName(path.c_str());
      reader->Update();
      const bool failed = reader->GetErrorCode() != vtkErrorCode::NoError;
      const bool empty = reader->GetOutput()->GetNumberOfCells() == 0;
      CHECK(failed == empty && (!failed || messages.OneError("Cannot read")));
      refused += failed ? 1 : 0;
    }
    std::cout << "  " << name << ": " << refused << " of 400 refused" << std::endl;
  }
}
}

//------------------------------------------------------------------------------
int TestReliefMeshReader(int argc, char* argv[])
{
  Directory = EmptyDirectory(argc, argv, "TestReliefMeshReader");
  vtkNew<Window> window;
  const vtkSmartPointer<vtkOutputWindow> before = vtkOutputWindow::GetInstance();
  vtkOutputWindow::SetInstance(window);
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF); // the window has all that it prints
  WriteFiles();
  TestFormats();
  TestRefusals();
  TestDamagedGltf();
  TestGltfExtensions();
  TestGltfAttributes();
  TestSparseGltf();
  TestDeepGltf();
  TestGltfBuffers();
  TestObjLines();
  TestTruncated();
  TestDamaged();
  CHECK(window->Texts.empty() && vtkOutputWindow::GetInstance() == window);
  std::cout << window->Texts;
  vtkOutputWindow::SetInstance(before);
  return Failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
