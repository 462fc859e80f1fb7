// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Writes the table of parameters and the usual sun as JSON, from which the package's keywords and
/// types are made when it is built.
///
///     reliefWebParameters FILE

#include "SceneParameters.h"

#include <cmath>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <sstream>

namespace
{

namespace parameters = relief::parameters;

std::string Quoted(const std::string& text)
{
  std::string quoted = "\"";
  for (const char c : text)
  {
    quoted += c == '"' || c == '\\' ? std::string("\\") + c : std::string(1, c);
  }
  return quoted + "\"";
}

/// JSON knows no infinity.
std::string Number(double value)
{
  std::ostringstream text;
  text << std::setprecision(15) << value;
  return std::isfinite(value) ? text.str() : "null";
}

std::string Entry(const parameters::Parameter& parameter)
{
  std::ostringstream text;
  text << "{ \"owner\": " << Quoted(parameters::NameAsKey(parameters::NameOf(parameter.Of)))
       << ", \"name\": " << Quoted(parameter.Name) << ", \"key\": " << Quoted(parameter.Key)
       << ",\n    \"kind\": " << Quoted(parameters::NameOf(parameter.Is))
       << ", \"unit\": " << Quoted(parameter.Unit) << ", \"default\": [";
  for (int k = 0; k < parameters::Size(parameter); ++k)
  {
    text << (k == 0 ? "" : ", ") << Number(parameter.Default[static_cast<std::size_t>(k)]);
  }
  text << "], \"minimum\": " << Number(parameter.Taken.Least)
       << ", \"maximum\": " << Number(parameter.Taken.Greatest)
       << ", \"minimumOpen\": " << (parameter.Taken.Open ? "true" : "false")
       << ",\n    \"choices\": [";
  for (std::size_t k = 0; k < parameter.Choices.size(); ++k)
  {
    text << (k == 0 ? "" : ", ") << "{ \"name\": " << Quoted(parameter.Choices[k].Name)
         << ", \"word\": " << Quoted(parameter.Choices[k].Word) << " }";
  }
  text << "], \"ofSuns\": " << (parameter.OfSuns ? "true" : "false")
       << ", \"label\": " << Quoted(parameter.Label)
       << ",\n    \"group\": " << Quoted(parameters::NameAsKey(parameters::NameOf(parameter.In)))
       << ", \"slider\": [" << Number(parameter.SliderFrom) << ", " << Number(parameter.SliderTo)
       << ", " << Number(parameter.SliderPower) << "]"
       << ",\n    \"help\": " << Quoted(parameter.Help) << " }";
  return text.str();
}

}

int main(int argc, char* argv[])
{
  if (argc != 2)
  {
    std::cerr << "usage: reliefWebParameters FILE\n";
    return 2;
  }
  std::ofstream file(argv[1]);
  file << "{ \"usual\": { \"azimuth\": " << Number(parameters::UsualAzimuth)
       << ", \"altitude\": " << Number(parameters::UsualAltitude)
       << ", \"turbidity\": " << Number(parameters::UsualTurbidity) << " },\n\"parameters\": ";
  const char* separator = "[\n  ";
  for (const parameters::Parameter& parameter : parameters::All())
  {
    file << separator << Entry(parameter);
    separator = ",\n  ";
  }
  file << "\n] }\n";
  file.close();
  if (!file)
  {
    std::cerr << "cannot write " << argv[1] << "\n";
    return 1;
  }
  return 0;
}
