// SPDX-License-Identifier: BSD-3-Clause

// Writes the definitions of ParaView's proxies: templates whose instructions are filled in from the
// table of parameters.
//
//     reliefProxyDefinitions TEMPLATE RESULT
//
// An instruction is a line of its own:
//
//     <?relief-include FILE PREFIX?>   a template beside this one; @P@ in it becomes PREFIX
//     <?relief-properties?>            definitions of all parameters
//     <?relief-group GROUP [PREFIX]?>  the names of a group's parameters, of those of the scene,
//     its
//                                      material and environment, or of Sun or Lamp
//     <?relief-decorator?>             of a group of properties of a display: it shows while that
//     kind
//                                      of display, which is named as the prefix, is chosen
//
// Names of properties begin with the prefix of the template. It fails, and writes nothing, where a
// parameter is in no group or in two: none can be left out.

#include "SceneParameters.h"

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{
using namespace relief::parameters;

// A parameter as ParaView has it: lights' parameters are there for a sun and for a lamp.
struct Entry
{
  const Parameter* Of;
  std::string Owner; // what vtkPVReliefScene::SetParameter has before the dot
  std::string Name;  // of the property, without the template's prefix
  Values Default;
};

std::vector<Entry> Entries()
{
  std::vector<Entry> entries;
  for (const Parameter& parameter : All())
  {
    const std::string name = parameter.Name;
    if (parameter.Of == Owner::Light)
    {
      // Color, not DiffuseColor: a light of this model has no other.
      const std::string own = parameter.Is == Kind::Color ? "Color" : name;
      Entry sun{ &parameter, "Sun", "Sun" + own, parameter.Default };
      sun.Default[0] = name == "Intensity" ? UsualIntensity : sun.Default[0];
      entries.push_back(sun);
      if (!parameter.OfSuns)
      {
        entries.push_back({ &parameter, "Lamp", "Lamp" + own, parameter.Default });
      }
      continue;
    }
    const bool prefixed = parameter.Of == Owner::Environment;
    entries.push_back({ &parameter, NameOf(parameter.Of), (prefixed ? "Environment" : "") + name,
      parameter.Default });
  }
  return entries;
}

std::string Escaped(const std::string& text)
{
  static const std::map<char, std::string> entities = { { '&', "&amp;" }, { '<', "&lt;" },
    { '>', "&gt;" }, { '"', "&quot;" } };
  std::string result;
  for (const char c : text)
  {
    const auto entity = entities.find(c);
    result += entity == entities.end() ? std::string(1, c) : entity->second;
  }
  return result;
}

// An infinite length is 0 in ParaView, whose XML knows no infinity.
std::string NumberText(double value)
{
  std::ostringstream text;
  text.precision(15);
  text << (std::isinf(value) ? 0.0 : value);
  return text.str();
}

std::string Repeated(const std::string& text, int times)
{
  std::string result = text;
  for (int i = 1; i < times; ++i)
  {
    result += " " + text;
  }
  return result;
}

std::string DefaultText(const Entry& entry)
{
  std::string result = NumberText(entry.Default[0]);
  for (int i = 1; i < Size(*entry.Of); ++i)
  {
    result += " " + NumberText(entry.Default[static_cast<std::size_t>(i)]);
  }
  return result;
}

std::string Documentation(const Entry& entry)
{
  const Parameter& parameter = *entry.Of;
  std::string text = std::string(parameter.Help) + ".";
  if (*parameter.Unit)
  {
    text += std::string(" Unit: ") + parameter.Unit + ".";
  }
  if (parameter.Is == Kind::Length)
  {
    text += " 0 is infinite.";
  }
  if (parameter.Is == Kind::Color)
  {
    text += " Linear red, green and blue.";
  }
  if (parameter.Is == Kind::Number || parameter.Is == Kind::Count)
  {
    const Interval& taken = parameter.Taken;
    if (std::isfinite(taken.Least) && std::isfinite(taken.Greatest))
    {
      text += " From " + NumberText(taken.Least) + " to " + NumberText(taken.Greatest) + ".";
    }
    else if (std::isfinite(taken.Least))
    {
      text += std::string(taken.Open ? " Above " : " At least ") + NumberText(taken.Least) + ".";
    }
  }
  return text;
}

// The parameter's domain: what the panel offers, not what is taken. Sliders end where they are
// useful; other values can be typed.
std::string Domain(const Parameter& parameter)
{
  std::ostringstream xml;
  const std::string ends = " min=\"" + Repeated(NumberText(parameter.SliderFrom), Size(parameter)) +
    "\" max=\"" + Repeated(NumberText(parameter.SliderTo), Size(parameter)) + "\"";
  switch (parameter.Is)
  {
    case Kind::Flag:
      return "<BooleanDomain name=\"bool\"/>";
    case Kind::Choice:
      xml << "<EnumerationDomain name=\"enum\">";
      for (std::size_t i = 0; i < parameter.Choices.size(); ++i)
      {
        xml << "<Entry text=\"" << Escaped(parameter.Choices[i].Label) << "\" value=\"" << i
            << "\"/>";
      }
      xml << "</EnumerationDomain>";
      return xml.str();
    case Kind::Count:
      return "<IntRangeDomain name=\"range\"" + ends + "/>";
    case Kind::Color:
      return "<DoubleRangeDomain name=\"range\" min=\"0 0 0\" max=\"1 1 1\"/>";
    default:
      return "<DoubleRangeDomain name=\"range\"" + ends + "/>";
  }
}

std::string Decorator(
  const std::string& mode, const std::string& property, const std::string& values)
{
  return "<PropertyWidgetDecorator type=\"GenericDecorator\" mode=\"" + mode + "\" property=\"" +
    property + "\" values=\"" + values + "\"/>";
}

// What the parameter depends on: another one of its owner's, a flag that finds its value, or which
// lights there are.
std::string Decorators(const Entry& entry, const std::string& prefix)
{
  const Parameter& parameter = *entry.Of;
  std::string hints;
  const std::string before =
    prefix + (parameter.Of == Owner::Environment ? std::string("Environment") : std::string());
  if (parameter.With)
  {
    hints +=
      Decorator("enabled_state", before + parameter.With, std::to_string(parameter.WithValue));
  }
  for (const Parameter* other : Of(parameter.Of))
  {
    if (std::string(other->Name) == std::string("Automatic") + parameter.Name)
    {
      hints += Decorator("enabled_state", before + other->Name, "0");
    }
  }
  if (entry.Owner == "Sun" || std::string(parameter.Name) == "NumberOfSunSamples")
  {
    hints += Decorator("visibility", prefix + "Lighting", "0 4");
  }
  if (parameter.Of == Owner::Environment)
  {
    hints += Decorator("visibility", prefix + "Lighting", "4");
  }
  if (entry.Owner == "Lamp")
  {
    hints += Decorator("visibility", prefix + "UseLamp", "1");
  }
  return hints;
}

std::string Definition(const Entry& entry, const std::string& prefix)
{
  const Parameter& parameter = *entry.Of;
  const bool whole =
    parameter.Is == Kind::Flag || parameter.Is == Kind::Choice || parameter.Is == Kind::Count;
  const std::string element = whole ? "IntVectorProperty" : "DoubleVectorProperty";
  const std::string widget = parameter.Is == Kind::Color ? "color_selector"
    : parameter.Is == Kind::Range                        ? "double_range"
                                                         : "";
  std::ostringstream xml;
  xml << "      <" << element << " name=\"" << prefix << entry.Name
      << "\" command=\"SetParameter\" initial_string=\"" << entry.Owner << "." << parameter.Name
      << "\" number_of_elements=\"" << Size(parameter) << "\" default_values=\""
      << DefaultText(entry) << "\"";
  if (!widget.empty())
  {
    xml << " panel_widget=\"" << widget << "\"";
  }
  if (parameter.In == Group::Accuracy || std::string(parameter.Name) == "NumberOfSunSamples")
  {
    xml << " panel_visibility=\"advanced\"";
  }
  xml << ">\n        " << Domain(parameter) << "\n        <Documentation>"
      << Escaped(Documentation(entry)) << "</Documentation>\n";
  const std::string hints = Decorators(entry, prefix);
  if (!hints.empty())
  {
    xml << "        <Hints>" << hints << "</Hints>\n";
  }
  xml << "      </" << element << ">\n";
  return xml.str();
}

// Fills in templates.
class Filler
{
public:
  std::string Fill(const std::string& file, const std::string& prefix);
  void CheckThatAllAreThere() const;

private:
  std::string Instruct(
    const std::vector<std::string>& words, const std::string& folder, const std::string& prefix);
  std::string NameGroup(
    const std::string& group, const std::string& owner, const std::string& prefix);

  std::map<std::string, std::multiset<std::string>> Grouped; // names, by prefix
};

//------------------------------------------------------------------------------
std::string Filler::NameGroup(
  const std::string& group, const std::string& owner, const std::string& prefix)
{
  bool any = false;
  std::string names;
  for (const Entry& entry : Entries())
  {
    const bool ofLight = entry.Of->Of == Owner::Light;
    const bool inGroup = group == NameOf(entry.Of->In);
    any = any || inGroup;
    if (inGroup && (owner.empty() ? !ofLight : entry.Owner == owner))
    {
      names += "            <Property name=\"" + prefix + entry.Name + "\"/>\n";
      this->Grouped[prefix].insert(entry.Name);
    }
  }
  if (!any)
  {
    throw std::runtime_error("there is no group " + group);
  }
  return names;
}

//------------------------------------------------------------------------------
std::string Filler::Instruct(
  const std::vector<std::string>& words, const std::string& folder, const std::string& prefix)
{
  if (words[0] == "relief-include" && words.size() >= 2)
  {
    return this->Fill(folder + words[1], words.size() > 2 ? words[2] : std::string());
  }
  if (words[0] == "relief-properties")
  {
    std::string definitions;
    for (const Entry& entry : Entries())
    {
      definitions += Definition(entry, prefix);
    }
    return definitions;
  }
  if (words[0] == "relief-group" && words.size() >= 2)
  {
    return this->NameGroup(words[1], words.size() > 2 ? words[2] : std::string(), prefix);
  }
  if (words[0] == "relief-decorator")
  {
    return prefix.empty()
      ? std::string()
      : "            <Hints>" + Decorator("visibility", "Representation", prefix) + "</Hints>\n";
  }
  throw std::runtime_error("there is no instruction " + words[0]);
}

//------------------------------------------------------------------------------
std::string Filler::Fill(const std::string& file, const std::string& prefix)
{
  std::ifstream in(file);
  if (!in)
  {
    throw std::runtime_error("cannot read " + file);
  }
  const std::string folder = file.substr(0, file.find_last_of('/') + 1);
  std::string result;
  std::string line;
  while (std::getline(in, line))
  {
    const auto begin = line.find("<?relief-");
    const auto end = line.find("?>");
    if (begin != std::string::npos && end != std::string::npos)
    {
      std::istringstream text(line.substr(begin + 2, end - begin - 2));
      std::vector<std::string> words;
      for (std::string word; text >> word;)
      {
        words.push_back(word);
      }
      result += this->Instruct(words, folder, prefix);
      continue;
    }
    for (auto at = line.find("@P@"); at != std::string::npos; at = line.find("@P@", at))
    {
      line.replace(at, 3, prefix);
    }
    result += line + "\n";
  }
  return result;
}

//------------------------------------------------------------------------------
void Filler::CheckThatAllAreThere() const
{
  for (const auto& [prefix, names] : this->Grouped)
  {
    // A display names its properties twice: what it hands on, and what the panel shows of them.
    const std::size_t times = prefix.empty() ? 1 : 2;
    for (const Entry& entry : Entries())
    {
      if (names.count(entry.Name) != times)
      {
        throw std::runtime_error("the parameter " + prefix + entry.Name + " is in " +
          std::to_string(names.count(entry.Name)) + " groups, not in " + std::to_string(times));
      }
    }
  }
}
}

//------------------------------------------------------------------------------
int main(int argc, char* argv[])
{
  if (argc != 3)
  {
    std::cerr << "usage: reliefProxyDefinitions TEMPLATE RESULT\n";
    return EXIT_FAILURE;
  }
  try
  {
    Filler filler;
    const std::string text = filler.Fill(argv[1], "");
    filler.CheckThatAllAreThere();
    std::ofstream out(argv[2]);
    out << text << std::flush;
    if (!out)
    {
      throw std::runtime_error(std::string("cannot write ") + argv[2]);
    }
  }
  catch (const std::exception& e)
  {
    std::cerr << "reliefProxyDefinitions: " << e.what() << "\n";
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
