// SPDX-License-Identifier: BSD-3-Clause
#include "vtkReliefEnvironment.h"

#include "SceneParameters.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkSmartPointer.h"

#include "Angles.h"
#include "ClearSky.h"
#include "EnvironmentMap.h"

#include <algorithm>
#include <cmath>
#include <limits>

vtkStandardNewMacro(vtkReliefEnvironment);

namespace parameters = relief::parameters;

namespace
{

vtkSmartPointer<vtkImageData> MakeImage(const relief::RadianceMap& map)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(map.GetColumns(), map.GetRows(), 1);
  vtkNew<vtkFloatArray> colors;
  colors->SetName("Radiance");
  colors->SetNumberOfComponents(3);
  colors->SetNumberOfTuples(image->GetNumberOfPoints());
  float* to = colors->GetPointer(0);
  for (int j = map.GetRows() - 1; j >= 0; --j)
  {
    for (int i = 0; i < map.GetColumns(); ++i, to += 3)
    {
      std::copy_n(&map.At(i, j).x, 3, to);
    }
  }
  image->GetPointData()->SetScalars(colors);
  return image;
}

}

class vtkReliefEnvironment::Internals
{
public:
  vtkSmartPointer<vtkImageData> Image;
};

//------------------------------------------------------------------------------
vtkReliefEnvironment::vtkReliefEnvironment()
  : Internal(new Internals)
{
  parameters::SetDefaults(this);
}

//------------------------------------------------------------------------------
vtkReliefEnvironment::~vtkReliefEnvironment() = default;

//------------------------------------------------------------------------------
void vtkReliefEnvironment::SetImage(vtkImageData* image)
{
  if (this->Internal->Image != image)
  {
    this->Internal->Image = image;
    this->ImageSource = UserImage;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkReliefEnvironment::SetFileName(const char* fileName)
{
  const std::string name = fileName ? fileName : "";
  const int source = name.empty() ? UserImage : File;
  if (this->ImageSource != source || this->FileName != name)
  {
    this->ImageSource = source;
    this->FileName = name;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
const char* vtkReliefEnvironment::GetFileName()
{
  return this->ImageSource == File ? this->FileName.c_str() : nullptr;
}

//------------------------------------------------------------------------------
vtkImageData* vtkReliefEnvironment::GetImage()
{
  return this->Internal->Image;
}

//------------------------------------------------------------------------------
void vtkReliefEnvironment::SetImageToWhiteDome()
{
  this->SetImage(MakeImage(relief::WhiteDome()));
  this->ImageSource = WhiteDome;
}

//------------------------------------------------------------------------------
void vtkReliefEnvironment::SetImageToClearSky(double azimuth, double altitude, double turbidity)
{
  if (const auto refusal = parameters::CheckClearSky(azimuth, altitude, turbidity))
  {
    vtkErrorMacro("SetImageToClearSky: " << refusal->Reason() << "; the old image is kept.");
    return;
  }
  glm::dvec3 sun;
  relief::DirectionOf(azimuth, altitude, &sun.x);
  this->SetImage(
    MakeImage(relief::ClearSky(sun, turbidity, relief::ClearSkyColumns, relief::ClearSkyRows)));
  this->ImageSource = ClearSky;
  this->ClearSkyParameters[0] = azimuth;
  this->ClearSkyParameters[1] = altitude;
  this->ClearSkyParameters[2] = turbidity;
}

//------------------------------------------------------------------------------
// What each of these takes is in the table of parameters.
void vtkReliefEnvironment::SetRotationZ(double value)
{
  parameters::Set(this, this->RotationZ, value, "RotationZ");
}

void vtkReliefEnvironment::SetTilt(double value)
{
  parameters::Set(this, this->Tilt, value, "Tilt");
}

void vtkReliefEnvironment::SetIntensity(double value)
{
  parameters::Set(this, this->Intensity, value, "Intensity");
}

void vtkReliefEnvironment::SetRadius(double value)
{
  parameters::Set(this, this->Radius, value, "Radius");
}

void vtkReliefEnvironment::SetSampling(int sampling)
{
  parameters::Set(this, this->Sampling, sampling, "Sampling");
}

void vtkReliefEnvironment::SetNumberOfSamples(int value)
{
  parameters::Set(this, this->NumberOfSamples, value, "NumberOfSamples");
}

//------------------------------------------------------------------------------
void vtkReliefEnvironment::SetRadiusToInfinity()
{
  this->SetRadius(std::numeric_limits<double>::infinity());
}

//------------------------------------------------------------------------------
void vtkReliefEnvironment::CopyAllBut(vtkReliefEnvironment* other, vtkImageData* image)
{
  parameters::Copy(other, this);
  this->Internal->Image = image;
  this->ImageSource = other->ImageSource;
  this->FileName = other->FileName;
  std::copy_n(other->ClearSkyParameters, 3, this->ClearSkyParameters);
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkReliefEnvironment::DeepCopy(vtkReliefEnvironment* other)
{
  if (other && other != this)
  {
    vtkSmartPointer<vtkImageData> image;
    if (other->GetImage())
    {
      image = vtkSmartPointer<vtkImageData>::New();
      image->DeepCopy(other->GetImage());
    }
    this->CopyAllBut(other, image);
  }
}

//------------------------------------------------------------------------------
void vtkReliefEnvironment::ShallowCopy(vtkReliefEnvironment* other)
{
  if (other && other != this)
  {
    this->CopyAllBut(other, other->GetImage());
  }
}

//------------------------------------------------------------------------------
vtkMTimeType vtkReliefEnvironment::GetMTime()
{
  const vtkMTimeType time = this->Superclass::GetMTime();
  return this->Internal->Image ? std::max(time, this->Internal->Image->GetMTime()) : time;
}

//------------------------------------------------------------------------------
void vtkReliefEnvironment::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Image: " << this->GetImage() << "\n";
  os << indent << "ImageSource: " << parameters::ImageSourceNames()[this->ImageSource] << "\n";
  os << indent << "FileName: " << (this->GetFileName() ? this->GetFileName() : "(none)") << "\n";
  os << indent << "ClearSkyParameters: " << this->ClearSkyParameters[0] << " "
     << this->ClearSkyParameters[1] << " " << this->ClearSkyParameters[2] << "\n";
  parameters::Print(this, os, indent);
}
