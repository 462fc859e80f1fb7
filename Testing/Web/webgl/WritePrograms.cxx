// SPDX-License-Identifier: BSD-3-Clause
//
// Writes every program that ReliefPrograms makes, over all features, one after the other as JSON:
// what it was asked for, and its text.

#include "ReliefPrograms.h"

#include <cstdio>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>

namespace
{

std::string Quoted(const std::string& text)
{
  std::string result = "\"";
  for (const char c : text)
  {
    if (c == '"' || c == '\\')
    {
      result += '\\';
    }
    if (static_cast<unsigned char>(c) < 0x20)
    {
      char code[8];
      std::snprintf(code, sizeof(code), "\\u%04x", c);
      result += code;
      continue;
    }
    result += c;
  }
  return result + '"';
}

class Writer
{
public:
  explicit Writer(std::ostream& out)
    : Out(out)
  {
    this->Out << "[\n";
  }
  ~Writer() { this->Out << "\n]\n"; }
  Writer(const Writer&) = delete;
  void operator=(const Writer&) = delete;

  void Add(const char* kind, const relief::FieldLayout& layout, const std::string& asked,
    const std::string& text)
  {
    this->Out << (this->Count++ > 0 ? ",\n" : "") << "{\"kind\":\"" << kind
              << "\",\"tiled\":" << (layout.tiledHeights || layout.tiledBounds ? "true" : "false")
              << ',' << asked << ",\"text\":" << Quoted(text) << '}';
  }

  int GetCount() const { return this->Count; }

private:
  std::ostream& Out;
  int Count = 0;
};

std::string Flags(const char* name, std::initializer_list<std::pair<const char*, bool>> flags)
{
  std::ostringstream text;
  text << '"' << name << "\":{";
  const char* separator = "";
  for (const auto& [flag, value] : flags)
  {
    text << separator << '"' << flag << "\":" << (value ? "true" : "false");
    separator = ",";
  }
  text << '}';
  return text.str();
}

std::string Describe(const relief::LightFeatures& light)
{
  return Flags("light",
    { { "positional", light.positional }, { "surfaceNormal", light.surfaceNormal },
      { "tangentPlane", light.tangentPlane }, { "exponential", light.exponential },
      { "floor", light.floor }, { "deep", light.deep }, { "fixedStep", light.fixedStep },
      { "combined", light.combined }, { "igor", light.igor } });
}

std::string Describe(const relief::SumFeatures& sums)
{
  return Flags("sums",
    { { "diffuse", sums.diffuse }, { "scatter", sums.scatter }, { "specular", sums.specular } });
}

relief::SumFeatures Sums(int bits)
{
  relief::SumFeatures sums;
  sums.diffuse = (bits & 1) != 0;
  sums.scatter = (bits & 2) != 0;
  sums.specular = (bits & 4) != 0;
  return sums;
}

void WriteTraces(Writer& writer, const relief::FieldLayout& layout)
{
  for (int bits = 0; bits < 32; ++bits)
  {
    for (int offset = 0; offset < 3; ++offset)
    {
      for (int response = 0; response < 3; ++response)
      {
        relief::LightFeatures light;
        light.positional = (bits & 1) != 0;
        light.exponential = (bits & 2) != 0;
        light.floor = (bits & 4) != 0;
        light.fixedStep = (bits & 8) != 0;
        light.deep = (bits & 16) != 0;
        light.surfaceNormal = offset == 1;
        light.tangentPlane = offset == 2;
        light.combined = response == 1;
        light.igor = response == 2;
        writer.Add("trace", layout, Describe(light), relief::TraceProgram(layout, light));
      }
    }
  }
}

void WriteGathers(Writer& writer, const relief::FieldLayout& layout)
{
  for (int bits = 1; bits < 8; ++bits)
  {
    const relief::SumFeatures sums = Sums(bits);
    for (int offset = 0; offset < 3; ++offset)
    {
      for (int lights = 1; lights <= relief::MostGathered; ++lights)
      {
        for (const bool positional : { false, true })
        {
          // Of those whose direction it must find at each sample, one.
          if (positional && lights > 1)
          {
            continue;
          }
          relief::LightFeatures light;
          light.positional = positional;
          light.surfaceNormal = offset == 1;
          light.tangentPlane = offset == 2;
          writer.Add("gather", layout,
            Describe(light) + ',' + Describe(sums) + ",\"lights\":" + std::to_string(lights),
            relief::GatherProgram(layout, light, sums, lights));
        }
      }
    }
  }
}

void WriteComposes(Writer& writer, const relief::FieldLayout& layout)
{
  for (int bits = 0; bits < 256; ++bits)
  {
    relief::ComposeFeatures compose;
    compose.sums = Sums(bits & 7);
    compose.first = (bits & 8) != 0;
    compose.later = (bits & 16) != 0;
    compose.baseTexture = (bits & 32) != 0;
    compose.diffuseTexture = (bits & 64) != 0;
    compose.specularTexture = (bits & 128) != 0;
    writer.Add("compose", layout,
      Describe(compose.sums) + ',' +
        Flags("compose",
          { { "first", compose.first }, { "later", compose.later },
            { "baseTexture", compose.baseTexture }, { "diffuseTexture", compose.diffuseTexture },
            { "specularTexture", compose.specularTexture } }),
      relief::ComposeProgram(layout, compose));
  }
}

}

int main(int argc, char* argv[])
{
  if (argc != 2)
  {
    std::cerr << "usage: reliefWritePrograms FILE\n";
    return 1;
  }
  std::ofstream file(argv[1]);
  int count = 0;
  {
    Writer writer(file);
    for (int tiled = 0; tiled < 4; ++tiled)
    {
      relief::FieldLayout layout;
      layout.tiledHeights = (tiled & 1) != 0;
      layout.tiledBounds = (tiled & 2) != 0;
      WriteTraces(writer, layout);
      WriteGathers(writer, layout);
      WriteComposes(writer, layout);
    }
    count = writer.GetCount();
  }
  file.close();
  if (!file)
  {
    std::cerr << argv[1] << " cannot be written\n";
    return 1;
  }
  std::cout << count << " programs\n";
  return 0;
}
