// SPDX-License-Identifier: BSD-3-Clause
// The filter with images of any shape and content in all of its inputs: heights, mask, textures,
// and an environment of any turn, radius and sampling. One error and no picture, or a picture
// without NaN.
#include "FuzzInput.h"
#include "FuzzMessages.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkImageReliefShading.h"
#include "vtkLight.h"
#include "vtkMatrix3x3.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkReliefEnvironment.h"
#include "vtkReliefMaterial.h"
#include "vtkReliefScene.h"
#include "vtkSMPTools.h"
#include "vtkSmartPointer.h"

#include <iostream>

namespace
{
vtkSmartPointer<vtkImageData> MakeImage(FuzzInput& input, int components)
{
  static const int types[] = { VTK_FLOAT, VTK_UNSIGNED_CHAR, VTK_UNSIGNED_SHORT, VTK_DOUBLE,
    VTK_SHORT, VTK_INT, VTK_LONG_LONG, VTK_FLOAT };
  auto image = vtkSmartPointer<vtkImageData>::New();
  const int i0 = input.Integer(-2, 2);
  const int j0 = input.Integer(-2, 2);
  // Mostly a picture, sometimes nothing or a volume.
  const int k1 = input.Integer(0, 15) == 0 ? 1 : 0;
  const int least = input.Integer(0, 15) == 0 ? 0 : 1;
  image->SetExtent(
    i0, i0 + input.Integer(least, 40) - 1, j0, j0 + input.Integer(least, 20) - 1, 0, k1);
  if (input.Flag())
  {
    image->SetSpacing(input.Finite(1.0), input.Finite(1.0), 1.0);
    image->SetOrigin(input.Finite(), input.Finite(), input.Finite());
  }
  if (input.Integer(0, 3) == 0)
  {
    double elements[9];
    for (double& element : elements)
    {
      element = input.Finite();
    }
    image->GetDirectionMatrix()->DeepCopy(elements);
  }
  const int type = types[input.Integer(0, 7)];
  image->AllocateScalars(type, input.Integer(0, 7) == 0 ? input.Integer(1, 5) : components);
  vtkDataArray* scalars = image->GetPointData()->GetScalars();
  double palette[8];
  for (double& value : palette)
  {
    value = input.Number();
    if (type != VTK_FLOAT && type != VTK_DOUBLE)
    {
      value = value > 0.0 && value < 65535.0 ? value : 0.0;
      value = type == VTK_UNSIGNED_CHAR || type == VTK_SHORT ? std::fmod(value, 256.0) : value;
    }
    else if (type == VTK_FLOAT && std::abs(value) > std::numeric_limits<float>::max())
    {
      value = std::copysign(std::numeric_limits<float>::infinity(), value);
    }
  }
  const vtkIdType count = scalars->GetNumberOfTuples() * scalars->GetNumberOfComponents();
  for (vtkIdType at = 0; at < count; ++at)
  {
    const int components2 = scalars->GetNumberOfComponents();
    scalars->SetComponent(
      at / components2, static_cast<int>(at % components2), palette[(at * 5 + at / 9) % 8]);
  }
  return image;
}

void SetMaterial(FuzzInput& input, vtkReliefMaterial* material)
{
  material->SetDiffuseColor(std::abs(input.Bounded(1e300)), input.Share(), input.Share());
  material->SetSpecularCoefficient(input.Share());
  material->SetForwardScatterCoefficient(input.Share());
  material->SetSpecularPower(input.NonNegative());
  if (input.Flag())
  {
    material->SetSubsurfaceDepth(input.NonNegative());
  }
  material->SetOffsetMode(AnyOffset(input));
  material->SetAttenuation(input.Flag());
  material->SetDensity(input.NonNegative());
  material->SetUseFloor(input.Flag());
  material->SetFloorHeight(input.Finite());
}

void SetEnvironment(FuzzInput& input, vtkReliefEnvironment* environment)
{
  environment->SetRotationZ(input.Finite());
  environment->SetTilt(input.Finite());
  environment->SetIntensity(input.NonNegative());
  if (input.Flag())
  {
    environment->SetRadius(input.Positive());
  }
  environment->SetSampling(input.Integer(0, 2));
  environment->SetNumberOfSamples(input.Integer(1, 24));
  switch (input.Integer(0, 7))
  {
    case 0:
      environment->SetImageToWhiteDome();
      break;
    case 1:
      break; // none
    default:
      environment->SetImage(MakeImage(input, 3));
  }
}
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  FuzzInput input(data, size);
  FuzzMessages messages;
  vtkSMPTools::SetBackend("Sequential");
  vtkNew<vtkReliefScene> scene;
  vtkNew<vtkImageReliefShading> shading;
  shading->SetScene(scene);
  vtkNew<vtkReliefEnvironment> environment;
  if (input.Integer(0, 7) > 0)
  {
    SetEnvironment(input, environment);
    scene->SetEnvironment(environment);
  }
  SetMaterial(input, scene->GetMaterial());
  const vtkSmartPointer<vtkImageData> heights = MakeImage(input, 1);
  shading->SetInputData(heights);
  if (input.Flag())
  {
    vtkSmartPointer<vtkImageData> mask = MakeImage(input, 1);
    if (input.Integer(0, 7) > 0)
    {
      int extent[6];
      heights->GetExtent(extent);
      const vtkSmartPointer<vtkDataArray> old = mask->GetPointData()->GetScalars();
      mask->SetExtent(extent);
      mask->AllocateScalars(VTK_UNSIGNED_CHAR, 1);
      vtkDataArray* scalars = mask->GetPointData()->GetScalars();
      for (vtkIdType at = 0; at < scalars->GetNumberOfTuples(); ++at)
      {
        scalars->SetComponent(at, 0,
          old->GetNumberOfTuples() > 0 &&
            old->GetComponent(at % old->GetNumberOfTuples(), 0) > 0.0);
      }
    }
    shading->SetMaskData(mask);
  }
  if (input.Flag())
  {
    shading->SetDiffuseTextureData(MakeImage(input, 3));
  }
  if (input.Flag())
  {
    shading->SetSpecularTextureData(MakeImage(input, 4));
  }
  shading->SetStretchTextures(input.Flag());
  scene->SetHeightScale(input.Finite(1.0));
  scene->SetIntegrator(input.Integer(0, 3) == 0 ? 1 : 0);
  scene->SetNumberOfSteps(input.Integer(1, 40));
  scene->SetTolerance(input.NonNegative());
  scene->SetNumberOfSunSamples(input.Integer(1, 8));
  if (input.Flag())
  {
    vtkLight* sun = scene->AddSun(
      input.Finite(), std::fmod(input.Finite(), 90.0), std::fmod(input.NonNegative(), 90.0));
    sun->SetIntensity(input.Finite());
  }
  if (input.Flag())
  {
    vtkNew<vtkLight> lamp;
    lamp->SetLightTypeToSceneLight();
    lamp->PositionalOn();
    lamp->SetPosition(input.Number(), input.Number(), input.Number());
    lamp->SetFocalPoint(input.Number(), input.Number(), input.Number());
    lamp->SetPositional(input.Flag());
    lamp->SetIntensity(input.Number());
    scene->AddLight(lamp);
  }
  shading->SetGenerateIllumination(input.Flag());
  shading->SetGenerateThickness(input.Flag());
  shading->SetGenerateNormals(input.Flag());
  if (std::getenv("RELIEF_FUZZ_VERBOSE"))
  {
    double range[2];
    heights->GetScalarRange(range);
    std::cout << "heights from " << range[0] << " to " << range[1] << std::endl;
    heights->Print(std::cout);
    scene->Print(std::cout);
    std::cout << std::flush;
  }
  const bool setUp = messages.Count() == 0;
  shading->Update();
  vtkImageData* output = shading->GetOutput();
  FUZZ_CHECK(setUp);
  if (messages.Count() > 0)
  {
    FUZZ_CHECK(messages.Count() == 1);
    FUZZ_CHECK(output->GetNumberOfPoints() == 0);
    return 0;
  }
  FUZZ_CHECK(output->GetNumberOfPoints() == heights->GetNumberOfPoints());
  vtkDataArray* colors = output->GetPointData()->GetScalars();
  for (vtkIdType at = 0; at < colors->GetNumberOfTuples(); ++at)
  {
    for (int c = 0; c < 4; ++c)
    {
      FUZZ_CHECK(!std::isnan(colors->GetComponent(at, c)));
    }
  }
  return 0;
}
