// SPDX-License-Identifier: BSD-3-Clause
#include "GltfMesh.h"

#include "GltfFileChecks.h"

#include "vtkAppendPolyData.h"
#include "vtkCommand.h"
#include "vtkFloatArray.h"
#include "vtkGLTFDocumentLoader.h"
#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <vtk_jsoncpp.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

namespace relief::io
{

namespace
{
using Model = vtkGLTFDocumentLoader::Model;

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
  const Json::Value root = ReadGltfJson(fileName, binary);
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
  if (!PrepareGltf(fileName, root, inside, *model))
  {
    return;
  }
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
