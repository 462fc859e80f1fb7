// SPDX-License-Identifier: BSD-3-Clause
#include "vtkReliefMeshReader.h"

#include "vtkCellArray.h"
#include "vtkCommand.h"
#include "vtkDataArray.h"
#include "vtkErrorCode.h"
#include "vtkExecutive.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkOBJReader.h"
#include "vtkObjectFactory.h"
#include "vtkPLYReader.h"
#include "vtkPolyData.h"
#include "vtkPolyDataReader.h"
#include "vtkSTLReader.h"
#include "vtkXMLPolyDataReader.h"

#include "FileGuard.h"
#include "GltfFileChecks.h"
#include "GltfMesh.h"
#include "MeshFileChecks.h"

#include "vtksys/SystemTools.hxx"

#include <algorithm>
#include <iterator>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkReliefMeshReader);

namespace
{
using relief::io::Failure;

const char* const Extensions[] = { ".obj", ".ply", ".stl", ".vtp", ".vtk", ".gltf", ".glb" };

//------------------------------------------------------------------------------
// Hears what objects report, which then is not printed, and keeps the first of each kind.
class Listener : public vtkCommand
{
public:
  static Listener* New() { return new Listener; }
  vtkTypeMacro(Listener, vtkCommand);

  void Execute(vtkObject*, unsigned long event, void* text) override
  {
    std::string& kept = event == vtkCommand::ErrorEvent ? this->Error : this->Warning;
    if (kept.empty() && text)
    {
      // Without the place in the code that it came from.
      const std::string whole = static_cast<const char*>(text);
      const std::size_t place = whole.find("): ");
      kept = relief::io::OneLine(place == std::string::npos ? whole : whole.substr(place + 3));
      // Of a pipeline, which knows no reason.
      const bool reason = whole.find("returned failure for request") == std::string::npos;
      kept = reason ? kept : "its numbers do not fit together";
    }
  }

  void Hear(vtkObject* object)
  {
    object->AddObserver(vtkCommand::ErrorEvent, this);
    object->AddObserver(vtkCommand::WarningEvent, this);
  }

  std::string Error;
  std::string Warning;
};

//------------------------------------------------------------------------------
template <class Reader>
void Run(const std::string& fileName, Listener* listener, Reader* reader, vtkPolyData* output)
{
  reader->SetFileName(fileName.c_str());
  listener->Hear(reader);
  listener->Hear(reader->GetExecutive());
  reader->Update();
  output->ShallowCopy(reader->GetOutput());
}

void RunReader(const std::string& extension, const std::string& fileName, Listener* listener,
  vtkPolyData* output)
{
  if (extension == ".obj")
  {
    Run(fileName, listener, vtkNew<vtkOBJReader>().Get(), output);
  }
  else if (extension == ".ply")
  {
    Run(fileName, listener, vtkNew<vtkPLYReader>().Get(), output);
  }
  else if (extension == ".stl")
  {
    Run(fileName, listener, vtkNew<vtkSTLReader>().Get(), output);
  }
  else if (extension == ".vtp")
  {
    vtkNew<vtkXMLPolyDataReader> reader;
    reader->SetReaderErrorObserver(listener);
    reader->SetParserErrorObserver(listener);
    Run(fileName, listener, reader.Get(), output);
  }
  else if (extension == ".vtk")
  {
    Run(fileName, listener, vtkNew<vtkPolyDataReader>().Get(), output);
  }
  else
  {
    relief::io::ReadGltf(fileName, extension == ".glb", listener, output);
  }
}

//------------------------------------------------------------------------------
void CheckFile(const std::string& fileName, const std::string& extension)
{
  using vtksys::SystemTools;
  if (fileName.empty())
  {
    throw Failure(vtkErrorCode::NoFileNameError, "no file name is set");
  }
  if (!SystemTools::PathExists(fileName))
  {
    throw Failure(vtkErrorCode::FileNotFoundError, "the file does not exist");
  }
  if (SystemTools::FileIsDirectory(fileName))
  {
    throw Failure(vtkErrorCode::CannotOpenFileError, "it is a directory");
  }
  if (!SystemTools::TestFileAccess(fileName, vtksys::TEST_FILE_READ))
  {
    throw Failure(vtkErrorCode::CannotOpenFileError, "there is no permission to read it");
  }
  if (!vtkReliefMeshReader::IsMeshFile(fileName))
  {
    throw Failure(vtkErrorCode::UnrecognizedFileTypeError,
      "'" + extension +
        "' is no extension of a mesh; .obj, .ply, .stl, .vtp, .vtk, .gltf or .glb "
        "is expected");
  }
  relief::io::CheckMeshFile(fileName, extension);
}

//------------------------------------------------------------------------------
// Whoever reads polygons follows their numbers.
bool HasAllPoints(vtkCellArray* cells, vtkIdType points)
{
  vtkDataArray* offsets = cells->GetOffsetsArray();
  const auto numbers = static_cast<double>(cells->GetConnectivityArray()->GetNumberOfValues());
  double before = 0.0;
  for (vtkIdType i = 0; i < offsets->GetNumberOfValues(); ++i)
  {
    const double offset = offsets->GetComponent(i, 0);
    if (!(offset >= before && offset <= numbers))
    {
      return false;
    }
    before = offset;
  }
  for (vtkIdType i = 0; i < cells->GetNumberOfCells(); ++i)
  {
    vtkIdType count = 0;
    const vtkIdType* ids = nullptr;
    cells->GetCellAtId(i, count, ids);
    if (!std::all_of(ids, ids + count, [points](vtkIdType id) { return id >= 0 && id < points; }))
    {
      return false;
    }
  }
  return true;
}

void CheckMesh(vtkPolyData* mesh, const std::string& error)
{
  const std::string said = error.empty() ? "" : ": " + error;
  if (mesh->GetNumberOfPolys() + mesh->GetNumberOfStrips() == 0)
  {
    const vtkIdType others = mesh->GetNumberOfVerts() + mesh->GetNumberOfLines();
    throw Failure(vtkErrorCode::FileFormatError,
      error.empty() ? "it has no polygons: " + std::to_string(mesh->GetNumberOfPoints()) +
          " points and " + std::to_string(others) + " vertices and lines"
                    : "it cannot be read" + said);
  }
  for (vtkCellArray* cells :
    { mesh->GetVerts(), mesh->GetLines(), mesh->GetPolys(), mesh->GetStrips() })
  {
    if (!HasAllPoints(cells, mesh->GetNumberOfPoints()))
    {
      throw Failure(
        vtkErrorCode::FileFormatError, "its polygons name points that it does not have" + said);
    }
  }
  if (!error.empty())
  {
    throw Failure(vtkErrorCode::PrematureEndOfFileError, "it ends early or is damaged" + said);
  }
}

// Returns what a reader of VTK warns of.
std::string Read(const std::string& fileName, vtkPolyData* output)
{
  const std::string extension = relief::io::LowerExtension(fileName);
  CheckFile(fileName, extension);
  vtkNew<Listener> listener;
  vtkNew<vtkPolyData> mesh;
  RunReader(extension, fileName, listener, mesh);
  CheckMesh(mesh, listener->Error);
  output->ShallowCopy(mesh);
  return listener->Warning;
}
}

//------------------------------------------------------------------------------
vtkReliefMeshReader::vtkReliefMeshReader()
{
  this->SetNumberOfInputPorts(0);
}

//------------------------------------------------------------------------------
vtkReliefMeshReader::~vtkReliefMeshReader()
{
  this->SetFileName(nullptr);
}

//------------------------------------------------------------------------------
bool vtkReliefMeshReader::IsMeshFile(const std::string& fileName)
{
  const std::string extension = relief::io::LowerExtension(fileName);
  return std::any_of(std::begin(Extensions), std::end(Extensions),
    [&extension](const char* known) { return extension == known; });
}

//------------------------------------------------------------------------------
std::vector<std::string> vtkReliefMeshReader::GetFilesBeside(const std::string& fileName)
{
  const std::string extension = relief::io::LowerExtension(fileName);
  std::vector<std::string> files;
  if (extension == ".gltf" || extension == ".glb")
  {
    std::string reason; // whoever reads it says so
    relief::io::Guard(
      [&] { files = relief::io::GltfFiles(fileName, extension == ".glb"); }, reason);
  }
  return files;
}

//------------------------------------------------------------------------------
int vtkReliefMeshReader::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  vtkPolyData* output = vtkPolyData::GetData(outputs, 0);
  const std::string fileName = this->FileName ? this->FileName : "";
  std::string warning;
  std::string reason;
  // Assigned and not set: SetErrorCode would mark the reader as modified.
  this->ErrorCode = relief::io::Guard([&] { warning = Read(fileName, output); }, reason);
  const std::string name = relief::io::Shortened(fileName, relief::io::LongestName);
  if (!reason.empty())
  {
    output->Initialize();
    vtkErrorMacro(<< relief::io::Brief("Cannot read \"" + name + "\": " + reason) << ".");
  }
  else if (!warning.empty())
  {
    vtkWarningMacro(<< relief::io::Brief("Reading \"" + name + "\": " + warning) << ".");
  }
  return 1;
}

//------------------------------------------------------------------------------
void vtkReliefMeshReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
}
