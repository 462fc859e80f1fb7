// SPDX-License-Identifier: BSD-3-Clause
#include "vtkReliefEnvironment.h"

#include "vtkCommand.h"
#include "vtkErrorCode.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkOpenImageIOReader.h"
#include "vtkPointData.h"
#include "vtkReliefAngles.h"
#include "vtkReliefConversion.h"
#include "vtkReliefMessages.h"
#include "vtkReliefSetters.h"
#include "vtkSmartPointer.h"

#include "ClearSky.h"
#include "LightSampling.h"

#include <algorithm>
#include <limits>
#include <new>
#include <tuple>

vtkStandardNewMacro(vtkReliefEnvironment);

static_assert(static_cast<int>(vtkReliefEnvironment::Uniform) ==
  static_cast<int>(relief::EnvironmentSampling::Uniform));
static_assert(static_cast<int>(vtkReliefEnvironment::SolidAngle) ==
  static_cast<int>(relief::EnvironmentSampling::SolidAngle));
static_assert(static_cast<int>(vtkReliefEnvironment::Importance) ==
  static_cast<int>(relief::EnvironmentSampling::Importance));

#define vtkReliefThisClass vtkReliefEnvironment
vtkReliefSetNumberBody(RotationZ, double, true, "a finite number");
vtkReliefSetNumberBody(Tilt, double, true, "a finite number");
vtkReliefSetNumberBody(Intensity, double, value >= 0.0, "a finite number of at least 0");
vtkReliefSetNumberBody(Sampling, int, value >= Uniform && value <= Importance,
  "Uniform (0), SolidAngle (1) or Importance (2)");
vtkReliefSetNumberBody(
  NumberOfSamples, int, value >= 1 && value <= 65536, "a number in [1, 65536]");

namespace
{

relief::RadianceMap MakeMap(const relief::ColorTexture& colors)
{
  relief::RadianceMap map(colors.columns, colors.rows);
  for (int j = 0; j < colors.rows; ++j)
  {
    for (int i = 0; i < colors.columns; ++i)
    {
      // The zenith is the picture's top row, the image's last.
      map.Set(i, j, colors.ReadColor(i, colors.rows - 1 - j));
    }
  }
  return map;
}

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

  // Kept until what they were made from changes; modification times are never given twice.
  relief::RadianceMap Map;
  vtkMTimeType MapTime = 0;
  std::vector<relief::Light> Lights;
  std::tuple<vtkMTimeType, int, int, glm::dmat3> LightsMadeFrom;
};

//------------------------------------------------------------------------------
vtkReliefEnvironment::vtkReliefEnvironment()
  : Radius(std::numeric_limits<double>::infinity())
  , Internal(new Internals)
{
}

//------------------------------------------------------------------------------
vtkReliefEnvironment::~vtkReliefEnvironment() = default;

//------------------------------------------------------------------------------
void vtkReliefEnvironment::SetImage(vtkImageData* image)
{
  if (this->Internal->Image != image)
  {
    this->Internal->Image = image;
    this->Internal->Map = relief::RadianceMap();
    this->Internal->MapTime = 0;
    this->Internal->Lights.clear();
    this->Internal->LightsMadeFrom = {};
    this->ImageSource = UserImage;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
bool vtkReliefEnvironment::SetImageToFile(const char* fileName)
{
  vtkNew<vtkOpenImageIOReader> reader;
  vtkNew<vtkReliefFirstMessage> message;
  reader->AddObserver(vtkCommand::ErrorEvent, message);
  reader->SetFileName(fileName);
  reader->Update();
  if (reader->GetErrorCode() != vtkErrorCode::NoError)
  {
    message->Text.erase(message->Text.find_last_not_of('.') + 1);
    vtkErrorMacro("SetImageToFile: " << message->Text << "; the old image is kept.");
    return false;
  }
  this->SetImage(reader->GetOutput());
  this->SetFileName(fileName);
  return true;
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
  relief::RadianceMap dome(1, 2);
  dome.Set(0, 0, glm::dvec3(1.0));
  this->SetImage(MakeImage(dome));
  this->ImageSource = WhiteDome;
}

//------------------------------------------------------------------------------
void vtkReliefEnvironment::SetImageToClearSky(double azimuth, double altitude, double turbidity)
{
  if (!std::isfinite(azimuth) || !(altitude >= 0.0 && altitude <= 90.0) ||
    !(turbidity >= 2.0 && turbidity <= 10.0))
  {
    vtkErrorMacro("SetImageToClearSky: azimuth "
      << azimuth << ", altitude " << altitude << ", turbidity " << turbidity
      << " was given, a finite azimuth, an altitude in [0, 90] degrees and a turbidity in [2, 10] "
         "are expected; the old image is kept.");
    return;
  }
  glm::dvec3 sun;
  vtkReliefDirection(azimuth, altitude, &sun.x);
  this->SetImage(MakeImage(relief::ClearSky(sun, turbidity, 256, 128)));
  this->ImageSource = ClearSky;
  this->ClearSkyParameters[0] = azimuth;
  this->ClearSkyParameters[1] = altitude;
  this->ClearSkyParameters[2] = turbidity;
}

//------------------------------------------------------------------------------
void vtkReliefEnvironment::SetRadius(double value)
{
  if (!(value > 0.0))
  {
    vtkErrorMacro("SetRadius: " << value << " was given, a number above 0 is expected; "
                                << this->Radius << " is kept.");
    return;
  }
  if (this->Radius != value)
  {
    this->Radius = value;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkReliefEnvironment::SetRadiusToInfinity()
{
  this->SetRadius(std::numeric_limits<double>::infinity());
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
  static const char* const sources[] = { "UserImage", "WhiteDome", "ClearSky", "File" };
  os << indent << "Image: " << this->GetImage() << "\n";
  os << indent << "ImageSource: " << sources[this->ImageSource] << "\n";
  os << indent << "FileName: " << (this->GetFileName() ? this->GetFileName() : "(none)") << "\n";
  os << indent << "ClearSkyParameters: " << this->ClearSkyParameters[0] << " "
     << this->ClearSkyParameters[1] << " " << this->ClearSkyParameters[2] << "\n";
  os << indent << "RotationZ: " << this->RotationZ << "\n";
  os << indent << "Tilt: " << this->Tilt << "\n";
  os << indent << "Intensity: " << this->Intensity << "\n";
  os << indent << "Radius: " << this->Radius << "\n";
  os << indent << "Sampling: "
     << (this->Sampling == Uniform         ? "Uniform"
            : this->Sampling == SolidAngle ? "SolidAngle"
                                           : "Importance")
     << "\n";
  os << indent << "NumberOfSamples: " << this->NumberOfSamples << "\n";
}

//------------------------------------------------------------------------------
std::string vtkReliefEnvironmentSampler::Sample(vtkReliefEnvironment* environment,
  const vtkReliefImageFrame& frame, std::vector<relief::Light>& lights)
{
  vtkReliefEnvironment::Internals& internal = *environment->Internal;
  vtkImageData* image = internal.Image;
  lights.clear();
  if (!image)
  {
    return std::string();
  }
  relief::ColorTexture colors;
  const std::string wrong =
    vtkReliefConvertColors(image, image->GetPointData()->GetScalars(), "environment", colors);
  if (!wrong.empty())
  {
    return wrong;
  }

  // From the image through the world to the relief's frame, one axis a column.
  const double cz = vtkReliefCosDegrees(environment->RotationZ);
  const double sz = vtkReliefSinDegrees(environment->RotationZ);
  const double ct = vtkReliefCosDegrees(environment->Tilt);
  const double st = vtkReliefSinDegrees(environment->Tilt);
  const double axes[3][3] = { { cz, ct * sz, st * sz }, { -sz, ct * cz, st * cz },
    { 0.0, -st, ct } };
  const glm::dmat3 toField(
    frame.VectorFromWorld(axes[0]), frame.VectorFromWorld(axes[1]), frame.VectorFromWorld(axes[2]));

  const vtkMTimeType time = image->GetMTime();
  try
  {
    if (internal.MapTime != time)
    {
      internal.Map = MakeMap(colors);
      internal.MapTime = time;
      if (internal.Map.GetCleaned() > 0)
      {
        vtkWarningWithObjectMacro(environment,
          "The image has " << internal.Map.GetCleaned()
                           << " texels that are not finite, negative or above "
                           << relief::RadianceMap::Largest
                           << "; a negative component counts as 0, the others as black texels.");
      }
    }
    const auto madeFrom =
      std::make_tuple(time, environment->Sampling, environment->NumberOfSamples, toField);
    if (internal.LightsMadeFrom != madeFrom)
    {
      internal.Lights = relief::SampleEnvironment(internal.Map,
        static_cast<relief::EnvironmentSampling>(environment->Sampling),
        environment->NumberOfSamples, toField);
      internal.LightsMadeFrom = madeFrom;
    }
    lights = internal.Lights;
  }
  catch (const std::bad_alloc&)
  {
    return "there is not enough memory for the environment's lights";
  }
  for (relief::Light& light : lights)
  {
    light.intensity = environment->Intensity;
  }
  return std::string();
}
