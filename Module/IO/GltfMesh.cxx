// SPDX-License-Identifier: BSD-3-Clause
#include "GltfMesh.h"

#include "FileGuard.h"

#include "vtkAppendPolyData.h"
#include "vtkCommand.h"
#include "vtkErrorCode.h"
#include "vtkFloatArray.h"
#include "vtkGLTFDocumentLoader.h"
#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include "vtksys/SystemTools.hxx"

#include <vtk_jsoncpp.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace relief::io
{

namespace
{
using Model = vtkGLTFDocumentLoader::Model;

[[noreturn]] void Refuse(const std::string& reason)
{
  throw Failure(vtkErrorCode::FileFormatError, reason);
}

[[noreturn]] void RefuseEnd(const std::string& reason)
{
  throw Failure(vtkErrorCode::PrematureEndOfFileError, reason);
}

bool IsIndex(std::int64_t index, std::size_t count)
{
  return index >= 0 && static_cast<std::uint64_t>(index) < count;
}

//------------------------------------------------------------------------------
// How long each buffer is, which must be there: inside the file, beside it, or as text.
std::vector<std::int64_t> FindBuffers(
  const std::string& fileName, const Model& model, const std::vector<char>& inside)
{
  using vtksys::SystemTools;
  Json::Value buffers;
  const std::string& text = model.BufferMetaData;
  const std::unique_ptr<Json::CharReader> reader(Json::CharReaderBuilder().newCharReader());
  std::string wrong;
  if (!reader->parse(text.data(), text.data() + text.size(), &buffers, &wrong) ||
    !buffers.isArray())
  {
    Refuse("it has no buffers");
  }
  std::vector<std::int64_t> lengths;
  for (const Json::Value& buffer : buffers)
  {
    const std::int64_t length =
      buffer.isObject() && buffer["byteLength"].isInt64() ? buffer["byteLength"].asInt64() : -1;
    if (length < 0)
    {
      Refuse("a buffer has no byteLength");
    }
    const std::string uri = buffer["uri"].isString() ? buffer["uri"].asString() : "";
    const bool data = uri.compare(0, 5, "data:") == 0;
    const std::string beside = SystemTools::GetFilenamePath(fileName) + "/" + uri;
    if (!uri.empty() && !data && !SystemTools::FileExists(beside, true))
    {
      Refuse("the file \"" + Shortened(uri) + "\" that it names is not there");
    }
    const std::int64_t there = uri.empty() ? static_cast<std::int64_t>(inside.size())
      : data                               ? static_cast<std::int64_t>(uri.size() / 4 * 3)
             : static_cast<std::int64_t>(SystemTools::FileLength(beside));
    if (length > there)
    {
      RefuseEnd("it ends early: a buffer is to have " + std::to_string(length) +
        " bytes, and there are " + std::to_string(there));
    }
    lengths.push_back(length);
  }
  return lengths;
}

//------------------------------------------------------------------------------
std::int64_t BytesOf(vtkGLTFDocumentLoader::ComponentType type)
{
  using Type = vtkGLTFDocumentLoader::ComponentType;
  return type == Type::BYTE || type == Type::UNSIGNED_BYTE ? 1
    : type == Type::SHORT || type == Type::UNSIGNED_SHORT  ? 2
                                                           : 4;
}

// Everything that is read lies in its buffer.
void CheckViews(const Model& model, const std::vector<std::int64_t>& buffers)
{
  for (const auto& view : model.BufferViews)
  {
    if (!IsIndex(view.Buffer, buffers.size()) || view.ByteOffset < 0 || view.ByteLength < 0 ||
      std::int64_t{ view.ByteOffset } + view.ByteLength >
        buffers[static_cast<std::size_t>(view.Buffer)])
    {
      Refuse("a bufferView reaches beyond its buffer");
    }
  }
  for (const auto& accessor : model.Accessors)
  {
    if (accessor.BufferView < 0 && accessor.Count >= 0 && accessor.Count < 1 << 28)
    {
      continue; // zeros
    }
    if (!IsIndex(accessor.BufferView, model.BufferViews.size()) || accessor.Count < 0)
    {
      Refuse("an accessor has no bufferView");
    }
    const auto& view = model.BufferViews[static_cast<std::size_t>(accessor.BufferView)];
    const std::int64_t element =
      BytesOf(accessor.ComponentTypeValue) * static_cast<std::int64_t>(accessor.NumberOfComponents);
    const std::int64_t stride = view.ByteStride > 0 ? view.ByteStride : element;
    if (accessor.ByteOffset < 0 ||
      accessor.ByteOffset + (std::int64_t{ accessor.Count } - 1) * stride + element >
        view.ByteLength)
    {
      Refuse("an accessor reaches beyond its bufferView");
    }
    const auto& sparse = accessor.SparseObject;
    if (accessor.IsSparse &&
      (sparse.Count < 0 || sparse.Count > accessor.Count ||
        !IsIndex(sparse.IndicesBufferView, model.BufferViews.size()) ||
        !IsIndex(sparse.ValuesBufferView, model.BufferViews.size())))
    {
      Refuse("a sparse accessor is damaged");
    }
  }
}

// What is named is there.
void CheckNames(const Model& model)
{
  for (const auto& mesh : model.Meshes)
  {
    for (const auto& primitive : mesh.Primitives)
    {
      bool there = primitive.IndicesId < 0 || IsIndex(primitive.IndicesId, model.Accessors.size());
      for (const auto& attribute : primitive.AttributeIndices)
      {
        there = there && IsIndex(attribute.second, model.Accessors.size());
      }
      if (!there)
      {
        Refuse("a mesh names an accessor that is not there");
      }
    }
  }
  std::vector<bool> below(model.Nodes.size());
  for (const auto& node : model.Nodes)
  {
    bool there = node.Mesh < 0 || IsIndex(node.Mesh, model.Meshes.size());
    for (const int child : node.Children)
    {
      there =
        there && IsIndex(child, model.Nodes.size()) && !below[static_cast<std::size_t>(child)];
      if (there)
      {
        below[static_cast<std::size_t>(child)] = true;
      }
    }
    if (!there)
    {
      Refuse("a node names a mesh or a node that is not there, or that has another parent");
    }
  }
  // So nodes of a scene are not below themselves.
  for (const auto& scene : model.Scenes)
  {
    for (const unsigned int node : scene.Nodes)
    {
      if (!IsIndex(node, model.Nodes.size()) || below[node])
      {
        Refuse("a scene names a node that is not there, or that has a parent");
      }
    }
  }
}

//------------------------------------------------------------------------------
// A mesh where its node puts it.
vtkSmartPointer<vtkPolyData> Transformed(vtkPolyData* mesh, vtkMatrix4x4* matrix)
{
  auto result = vtkSmartPointer<vtkPolyData>::New();
  result->ShallowCopy(mesh);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(mesh->GetNumberOfPoints());
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    double point[4] = { 0.0, 0.0, 0.0, 1.0 };
    mesh->GetPoint(i, point);
    matrix->MultiplyPoint(point, point);
    points->SetPoint(i, point);
  }
  result->SetPoints(points);
  vtkDataArray* own = mesh->GetPointData()->GetNormals();
  if (own && own->GetNumberOfComponents() == 3)
  {
    // Planes turn with the transposed inverse.
    double turn[3][3];
    for (int row = 0; row < 3; ++row)
    {
      for (int column = 0; column < 3; ++column)
      {
        turn[row][column] = matrix->GetElement(row, column);
      }
    }
    vtkMath::Invert3x3(turn, turn);
    vtkMath::Transpose3x3(turn, turn);
    vtkNew<vtkFloatArray> normals;
    normals->SetName(own->GetName());
    normals->SetNumberOfComponents(3);
    normals->SetNumberOfTuples(own->GetNumberOfTuples());
    for (vtkIdType i = 0; i < own->GetNumberOfTuples(); ++i)
    {
      double normal[3];
      own->GetTuple(i, normal);
      vtkMath::Multiply3x3(turn, normal, normal);
      vtkMath::Normalize(normal);
      normals->SetTuple(i, normal);
    }
    result->GetPointData()->SetNormals(normals);
  }
  return result;
}

//------------------------------------------------------------------------------
// A node and those below it.
void AddNode(const Model& model, std::size_t index, vtkMatrix4x4* above, vtkAppendPolyData* append)
{
  const auto& node = model.Nodes[index];
  vtkNew<vtkMatrix4x4> matrix;
  matrix->DeepCopy(above);
  if (node.Transform)
  {
    vtkMatrix4x4::Multiply4x4(above, node.Transform, matrix);
  }
  if (node.Mesh >= 0)
  {
    for (const auto& primitive : model.Meshes[static_cast<std::size_t>(node.Mesh)].Primitives)
    {
      if (primitive.Geometry && primitive.Geometry->GetNumberOfCells() > 0)
      {
        append->AddInputData(Transformed(primitive.Geometry, matrix));
      }
    }
  }
  for (const int child : node.Children)
  {
    AddNode(model, static_cast<std::size_t>(child), matrix, append);
  }
}
}

//------------------------------------------------------------------------------
void ReadGltf(const std::string& fileName, bool binary, vtkCommand* listener, vtkPolyData* output)
{
  vtkNew<vtkGLTFDocumentLoader> loader;
  loader->AddObserver(vtkCommand::ErrorEvent, listener);
  loader->AddObserver(vtkCommand::WarningEvent, listener);
  std::vector<char> inside;
  if (!loader->LoadModelMetaDataFromFile(fileName) ||
    (binary && !loader->LoadFileBuffer(fileName, inside)))
  {
    return;
  }
  const std::shared_ptr<Model> model = loader->GetInternalModel();
  CheckViews(*model, FindBuffers(fileName, *model, inside));
  CheckNames(*model);
  // Pictures, skins and motion are of no use here.
  model->Images.clear();
  model->Textures.clear();
  model->Materials.clear();
  model->Skins.clear();
  model->Animations.clear();
  for (auto& node : model->Nodes)
  {
    node.Skin = -1;
  }
  if (!loader->LoadModelData(inside) || !loader->BuildModelVTKGeometry())
  {
    return;
  }
  vtkNew<vtkAppendPolyData> append;
  vtkNew<vtkMatrix4x4> top;
  const std::size_t scene = static_cast<std::size_t>(std::max(model->DefaultScene, 0));
  if (scene < model->Scenes.size())
  {
    for (const unsigned int node : model->Scenes[scene].Nodes)
    {
      AddNode(*model, node, top, append);
    }
  }
  if (append->GetNumberOfInputConnections(0) > 0)
  {
    append->Update();
    output->ShallowCopy(append->GetOutput());
  }
}

}
