// SPDX-License-Identifier: BSD-3-Clause
#include "ImageFileAttributes.h"

#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkSmartPointer.h"
#include "vtkStringArray.h"

#include "ImageFileAccess.h"

#include <cstring>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace relief::io
{
using OIIO::TypeDesc;

namespace
{
// Whether an attribute tells how the file that it came from was stored.
bool DescribesStorage(const std::string& name)
{
  static const std::set<std::string> names = { "Orientation", "compression", "CompressionQuality",
    "planarconfig", "ChannelNames", "DataWindowOrigin" };
  static const std::set<std::string> prefixes = []
  {
    std::set<std::string> result = { "oiio" };
    std::istringstream formats(std::string(OIIO::get_string_attribute("format_list")));
    for (std::string format; std::getline(formats, format, ',');)
    {
      result.insert(format);
    }
    return result;
  }();
  const size_t colon = name.find(':');
  return names.count(name) || name.compare(0, 10, "ICCProfile") == 0 ||
    (colon != std::string::npos && prefixes.count(name.substr(0, colon)));
}
}

//------------------------------------------------------------------------------
void AddAttributes(const OIIO::ImageSpec& spec, vtkFieldData* fieldData)
{
  for (const OIIO::ParamValue& attribute : spec.extra_attribs)
  {
    const TypeDesc type = attribute.type();
    const int values = static_cast<int>(type.basevalues()) * attribute.nvalues();
    vtkSmartPointer<vtkAbstractArray> array;
    if (type.basetype == TypeDesc::STRING)
    {
      auto strings = vtkSmartPointer<vtkStringArray>::New();
      for (int i = 0; i < values; ++i)
      {
        strings->InsertNextValue(attribute.get_string_indexed(i));
      }
      array = strings;
    }
    else if (VTKType(type) != VTK_VOID && values > 0)
    {
      vtkSmartPointer<vtkDataArray> numbers;
      numbers.TakeReference(vtkDataArray::CreateDataArray(VTKType(type)));
      numbers->SetNumberOfComponents(type.aggregate);
      numbers->SetNumberOfTuples(values / type.aggregate);
      if (type.basetype == TypeDesc::HALF)
      {
        for (int i = 0; i < values; ++i)
        {
          numbers->SetComponent(
            i / type.aggregate, i % type.aggregate, attribute.get_float_indexed(i));
        }
      }
      else
      {
        std::memcpy(numbers->GetVoidPointer(0), attribute.data(), attribute.datasize());
      }
      array = numbers;
    }
    if (array)
    {
      array->SetName(attribute.name().c_str());
      fieldData->AddArray(array);
    }
  }

  vtkNew<vtkStringArray> channels;
  channels->SetName("ChannelNames");
  for (const std::string& name : spec.channelnames)
  {
    channels->InsertNextValue(name);
  }
  fieldData->AddArray(channels);

  vtkNew<vtkIntArray> origin;
  origin->SetName("DataWindowOrigin");
  origin->SetNumberOfComponents(2);
  origin->InsertNextTuple2(spec.x, spec.y);
  fieldData->AddArray(origin);

  // It has been carried out.
  if (vtkDataArray* orientation = fieldData->GetArray("Orientation"))
  {
    orientation->Fill(1.0);
  }
}

//------------------------------------------------------------------------------
void AddAttributes(vtkFieldData* fieldData, OIIO::ImageSpec& spec)
{
  const size_t largest = 64 * 1024;
  for (int a = 0; fieldData && a < fieldData->GetNumberOfArrays(); ++a)
  {
    vtkAbstractArray* array = fieldData->GetAbstractArray(a);
    const std::string name = array->GetName() ? array->GetName() : "";
    const size_t values = static_cast<size_t>(array->GetNumberOfValues());
    if (name.empty() || values == 0 || DescribesStorage(name))
    {
      continue;
    }
    if (auto strings = vtkStringArray::SafeDownCast(array))
    {
      size_t bytes = 0;
      std::vector<const char*> texts;
      for (vtkIdType i = 0; i < strings->GetNumberOfValues(); ++i)
      {
        texts.push_back(strings->GetValue(i).c_str());
        bytes += strings->GetValue(i).size() + 1;
      }
      if (bytes <= largest)
      {
        const TypeDesc type(TypeDesc::STRING, values > 1 ? static_cast<int>(values) : 0);
        spec.attribute(name, type, texts.data());
      }
    }
    else if (auto numbers = vtkDataArray::SafeDownCast(array))
    {
      TypeDesc type = FileType(numbers->GetDataType());
      if (type == TypeDesc::UNKNOWN || values * type.size() > largest)
      {
        continue;
      }
      // Tuples that OpenImageIO has a name for stay tuples, others become plain arrays.
      const int components = numbers->GetNumberOfComponents();
      const bool tuples = components == 2 || components == 3 || components == 4 || components == 16;
      type.aggregate = static_cast<unsigned char>(tuples ? components : 1);
      const int elements = static_cast<int>(values) / type.aggregate;
      type.arraylen = elements > 1 ? elements : 0;
      spec.attribute(name, type, numbers->GetVoidPointer(0));
    }
  }
}
}
