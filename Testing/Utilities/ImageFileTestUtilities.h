// SPDX-License-Identifier: BSD-3-Clause
#ifndef ImageFileTestUtilities_h
#define ImageFileTestUtilities_h

#include "FileTestUtilities.h"

#include <OpenImageIO/imageio.h>

/// Writes values, the top row first, with OpenImageIO alone.
template <typename T>
bool WriteFile(const std::string& name, const OIIO::ImageSpec& spec, const std::vector<T>& values)
{
  auto output = OIIO::ImageOutput::create(name);
  const OIIO::TypeDesc type = OIIO::BaseTypeFromC<T>::value;
  bool written = output && output->open(name, spec) && output->write_image(type, values.data()) &&
    output->close();
  if (output)
  {
    output->geterror();
  }
  return written;
}

/// The values of a file, the top row first, with OpenImageIO alone; empty where it cannot be read.
inline std::vector<float> ReadFile(const std::string& name, OIIO::ImageSpec& spec)
{
  OIIO::ImageSpec configuration;
  configuration.attribute("oiio:UnassociatedAlpha", 1);
  auto input = OIIO::ImageInput::open(name, &configuration);
  if (!input)
  {
    OIIO::geterror();
    return {};
  }
  spec = input->spec();
  std::vector<float> values(spec.image_pixels() * spec.nchannels);
  return input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeFloat, values.data())
    ? values
    : std::vector<float>();
}

#endif
