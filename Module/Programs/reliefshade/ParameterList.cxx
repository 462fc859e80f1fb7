// SPDX-License-Identifier: BSD-3-Clause
#include "ParameterList.h"

#include "OptionParser.h"
#include "SceneParameters.h"

#include "vtk_jsoncpp.h"

#include <cmath>

namespace
{

namespace parameters = relief::parameters;

//------------------------------------------------------------------------------
/// JSON knows no infinity.
Json::Value finite(double number)
{
  return std::isfinite(number) ? Json::Value(number) : Json::Value();
}

//------------------------------------------------------------------------------
Json::Value entryOf(const parameters::Parameter& parameter)
{
  Json::Value entry;
  entry["option"] = parameter.Option;
  entry["owner"] = parameters::NameOf(parameter.Of);
  entry["name"] = parameter.Name;
  entry["label"] = parameter.Label;
  entry["group"] = parameters::NameAsKey(parameters::NameOf(parameter.In));
  entry["kind"] = parameters::NameOf(parameter.Is);
  entry["unit"] = parameter.Unit;
  entry["help"] = parameter.Help;
  entry["minimum"] = finite(parameter.Taken.Least);
  entry["maximum"] = finite(parameter.Taken.Greatest);
  entry["minimum_open"] = parameter.Taken.Open;
  entry["default"] = Json::Value(Json::arrayValue);
  for (int k = 0; k < parameters::Size(parameter); ++k)
  {
    entry["default"].append(finite(parameter.Default[static_cast<std::size_t>(k)]));
  }
  entry["choices"] = Json::Value(Json::arrayValue);
  for (const std::string& word : reliefshade::wordsOf(parameter))
  {
    entry["choices"].append(word);
  }
  // Where "auto" may be said, and whether it is what is done when nothing is.
  const parameters::Parameter* automatic = reliefshade::automaticOf(parameter);
  entry["takesAuto"] = automatic != nullptr;
  entry["auto"] = automatic != nullptr && automatic->Default[0] != 0.0;
  // What is on only where the option is given, as a floor is.
  const bool switched =
    parameter.With && parameters::Find(parameter.Of, parameter.With).Is == parameters::Kind::Flag;
  entry["offUntilGiven"] = switched;
  return entry;
}

}

namespace reliefshade
{

//------------------------------------------------------------------------------
std::string parameterList()
{
  Json::Value list(Json::arrayValue);
  for (const parameters::Parameter& parameter : parameters::All())
  {
    if (parameter.Option)
    {
      list.append(entryOf(parameter));
    }
  }
  Json::StreamWriterBuilder builder;
  builder["indentation"] = "  ";
  builder["precision"] = 15;
  return Json::writeString(builder, list) + "\n";
}

}
