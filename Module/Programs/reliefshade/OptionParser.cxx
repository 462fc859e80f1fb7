// SPDX-License-Identifier: BSD-3-Clause
#include "OptionParser.h"

#include "Failure.h"

#include "vtkReliefScene.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <sstream>

namespace
{

using namespace reliefshade;

namespace parameters = relief::parameters;

constexpr std::size_t HelpTextWidth = 64;
constexpr std::size_t BriefTextWidth = 49;
const char* const Infinite = "infinite";

//------------------------------------------------------------------------------
std::string wrapped(const std::string& text, std::size_t width)
{
  std::istringstream words(text);
  std::string lines;
  std::size_t used = 0;
  for (std::string word; words >> word; used += word.size())
  {
    if (used > 0 && used + 1 + word.size() > width)
    {
      lines += '\n';
      used = 0;
    }
    else if (used > 0)
    {
      lines += ' ';
      ++used;
    }
    lines += word;
  }
  return lines;
}

//------------------------------------------------------------------------------
/// A text up to the first of these marks.
std::string beginningOf(const std::string& text, const std::vector<std::string>& marks)
{
  std::size_t end = text.size();
  for (const std::string& mark : marks)
  {
    end = std::min(end, text.find(mark));
  }
  return text.substr(0, end);
}

/// The beginning of a help, which says what an option is for, and its default if that is short.
std::string briefly(const std::string& help)
{
  std::string beginning = beginningOf(help, { ". ", ": ", "; " });
  for (std::size_t comma = 0;
       beginning.size() > 2 * BriefTextWidth - 14 && comma != std::string::npos;)
  {
    comma = beginning.rfind(", ");
    beginning = beginning.substr(0, comma);
  }
  const std::string mark = "Default: ";
  const std::size_t found = help.rfind(mark);
  const std::string usual = found == std::string::npos
    ? ""
    : beginningOf(help.substr(found + mark.size()), { ". ", ", ", "; " });
  return usual.empty() || usual.size() > 12 ? beginning : beginning + " [" + usual + "]";
}

//------------------------------------------------------------------------------
/// How many letters must be put in, left out, replaced or exchanged with the next to make one word
/// of another, whatever their case.
std::size_t slipsBetween(const std::string& one, const std::string& other)
{
  const std::size_t longest = 64; // words of the program are shorter
  if (one.size() > longest || other.size() > longest)
  {
    return longest;
  }
  const auto same = [&](std::size_t i, std::size_t j)
  {
    return std::tolower(static_cast<unsigned char>(one[i])) ==
      std::tolower(static_cast<unsigned char>(other[j]));
  };
  std::vector<std::vector<std::size_t>> slips(
    one.size() + 1, std::vector<std::size_t>(other.size() + 1));
  for (std::size_t i = 0; i <= one.size(); ++i)
  {
    for (std::size_t j = 0; j <= other.size(); ++j)
    {
      if (i == 0 || j == 0)
      {
        slips[i][j] = i + j;
        continue;
      }
      const std::size_t replaced = slips[i - 1][j - 1] + (same(i - 1, j - 1) ? 0 : 1);
      slips[i][j] = std::min({ slips[i - 1][j] + 1, slips[i][j - 1] + 1, replaced });
      if (i > 1 && j > 1 && same(i - 1, j - 2) && same(i - 2, j - 1))
      {
        slips[i][j] = std::min(slips[i][j], slips[i - 2][j - 2] + 1);
      }
    }
  }
  return slips[one.size()][other.size()];
}

/// What the help calls a parameter's value.
std::string valueName(const parameters::Parameter& parameter)
{
  std::string names;
  for (const std::string& word : wordsOf(parameter))
  {
    names += (names.empty() ? "" : "|") + word;
  }
  return names.empty() ? parameter.OptionValue : names;
}

/// A value as it is typed.
std::string shown(const parameters::Parameter& parameter, const parameters::Values& values)
{
  const std::vector<std::string> words = wordsOf(parameter);
  if (!words.empty())
  {
    return words[static_cast<std::size_t>(values[0])];
  }
  std::ostringstream text;
  for (int i = 0; i < parameters::Size(parameter); ++i)
  {
    text << (i == 0 ? "" : ",");
    if (std::isinf(values[i]))
    {
      text << Infinite;
    }
    else
    {
      text << values[i];
    }
  }
  return text.str();
}

/// A sentence for the help, with a blank behind it; empty where every number is taken.
std::string rangeOf(const parameters::Parameter& parameter)
{
  const auto number = [](double value)
  {
    std::ostringstream text;
    text.precision(9);
    text << value;
    return text.str();
  };
  const parameters::Interval& taken = parameter.Taken;
  if (parameter.Is == parameters::Kind::Range)
  {
    return "LO at most HI. ";
  }
  if (parameter.Is == parameters::Kind::Flag || parameter.Is == parameters::Kind::Choice ||
    !std::isfinite(taken.Least))
  {
    return std::string();
  }
  if (std::isfinite(taken.Greatest))
  {
    return "From " + number(taken.Least) + " to " + number(taken.Greatest) + ". ";
  }
  return (taken.Open ? "Above " : "At least ") + number(taken.Least) + ". ";
}

}

namespace reliefshade
{

//------------------------------------------------------------------------------
double toNumber(const std::string& option, const std::string& word)
{
  // The program never sets a locale, so this is the C locale's reading: a point, no comma.
  char* end = nullptr;
  const double number = std::strtod(word.c_str(), &end);
  // Hexadecimal ones, which the C library takes too, are rather slips of the fingers.
  if (word.empty() || std::isspace(static_cast<unsigned char>(word[0])) || *end ||
    word.find_first_of("xX") != std::string::npos)
  {
    throw Failure(option, "'" + word + "' is not a number", UsageFailure);
  }
  if (std::isinf(number) && word.find_first_of("0123456789") != std::string::npos)
  {
    throw Failure(option, "'" + word + "' is too large a number", UsageFailure);
  }
  return number;
}

//------------------------------------------------------------------------------
double toWhole(const std::string& option, const std::string& word)
{
  const double number = toNumber(option, word);
  if (number != std::floor(number))
  {
    throw Failure(option, "'" + word + "' is not a whole number", UsageFailure);
  }
  return number;
}

//------------------------------------------------------------------------------
bool isWord(const std::string& word, const std::string& name)
{
  return parameters::SameWord(word, name);
}

//------------------------------------------------------------------------------
std::string suggestion(const std::string& word, const std::vector<std::string>& names)
{
  std::string closest;
  std::size_t least = 1 + word.size() / 4; // more slips make another word
  for (const std::string& name : names)
  {
    const std::size_t slips = slipsBetween(word, name);
    if (slips <= least && slips < name.size())
    {
      least = slips == 0 ? 0 : slips - 1;
      closest = name;
    }
  }
  return closest.empty() ? closest : "; did you mean " + closest + "?";
}

//------------------------------------------------------------------------------
int toChoice(
  const std::string& option, const std::string& word, const std::vector<std::string>& names)
{
  const auto found = std::find_if(
    names.begin(), names.end(), [&word](const std::string& name) { return isWord(word, name); });
  if (found == names.end())
  {
    std::string all;
    for (const std::string& name : names)
    {
      all += (all.empty() ? "" : "|") + name;
    }
    throw Failure(
      option, "'" + word + "' is none of " + all + suggestion(word, names), UsageFailure);
  }
  return static_cast<int>(found - names.begin());
}

//------------------------------------------------------------------------------
std::vector<std::string> split(const std::string& list)
{
  std::vector<std::string> words(1);
  for (const char c : list)
  {
    if (c == ',')
    {
      words.emplace_back();
    }
    else
    {
      words.back() += c;
    }
  }
  return words;
}

//------------------------------------------------------------------------------
std::vector<double> toNumbers(
  const std::string& option, const std::string& list, const std::vector<std::size_t>& counts)
{
  std::vector<double> numbers;
  for (const std::string& word : split(list))
  {
    numbers.push_back(toNumber(option, word));
    if (!std::isfinite(numbers.back()))
    {
      throw Failure(option, "'" + word + "' is not finite", UsageFailure);
    }
  }
  if (std::find(counts.begin(), counts.end(), numbers.size()) == counts.end())
  {
    std::string expected;
    for (const std::size_t count : counts)
    {
      expected += (expected.empty() ? "" : " or ") + std::to_string(count);
    }
    throw Failure(
      option, "'" + list + "' is not " + expected + " numbers separated by commas", UsageFailure);
  }
  return numbers;
}

//------------------------------------------------------------------------------
int toCount(const std::string& option, const std::string& word)
{
  const double number = toWhole(option, word);
  const int most = 1000000000;
  if (!(number >= 1.0 && number <= most))
  {
    throw Failure(option,
      "'" + word + "' was given, a whole number from 1 to " + std::to_string(most) + " is expected",
      UsageFailure);
  }
  return static_cast<int>(number);
}

//------------------------------------------------------------------------------
double toBytes(const std::string& option, const std::string& word)
{
  static const std::string units = "KMGT";
  const std::size_t unit =
    word.empty() ? std::string::npos : units.find(static_cast<char>(std::toupper(word.back())));
  const std::string digits = word.substr(0, word.size() - (unit == std::string::npos ? 0 : 1));
  char* end = nullptr;
  const double number = digits.empty() ? 0.0 : std::strtod(digits.c_str(), &end);
  if (digits.empty() || *end != '\0' || !(number > 0.0) || !std::isfinite(number))
  {
    throw Failure(option,
      "'" + word + "' was given, a number of bytes such as 800M or 1.5G is expected", UsageFailure);
  }
  return number *
    (unit == std::string::npos ? 1.0 : std::pow(1024.0, 1.0 + static_cast<double>(unit)));
}

//------------------------------------------------------------------------------
void refuse(const std::string& option, const std::optional<parameters::Refusal>& refusal)
{
  if (refusal)
  {
    throw Failure(option, refusal->Reason(), UsageFailure);
  }
}

//------------------------------------------------------------------------------
parameters::Values toValues(const parameters::Parameter& parameter, const std::string& word)
{
  const std::string option = parameter.Option;
  parameters::Values values{ 0.0, 0.0, 0.0 };
  switch (parameter.Is)
  {
    case parameters::Kind::Choice:
    case parameters::Kind::Flag:
    {
      // As scenes spell it, too.
      const int place = parameters::FindChoice(parameter, word);
      values[0] = place < 0 ? toChoice(option, word, wordsOf(parameter)) : place;
      break;
    }
    case parameters::Kind::Color:
    case parameters::Kind::Range:
    {
      const auto size = static_cast<std::size_t>(parameters::Size(parameter));
      const std::vector<double> numbers = toNumbers(option, word, { size });
      std::copy(numbers.begin(), numbers.end(), values.begin());
      break;
    }
    case parameters::Kind::Count:
      values[0] = toWhole(option, word);
      break;
    case parameters::Kind::Length:
      values[0] =
        isWord(word, Infinite) ? std::numeric_limits<double>::infinity() : toNumber(option, word);
      break;
    default:
      values[0] = toNumber(option, word);
  }
  refuse(option, parameters::Check(parameter, values));
  return values;
}

//------------------------------------------------------------------------------
std::string helpOf(const parameters::Parameter& parameter, vtkObject* owner,
  const std::string& more, const std::string& usual)
{
  const std::string value =
    owner ? shown(parameter, parameter.Get(owner)) : shown(parameter, parameter.Default);
  const bool degrees = parameter.Unit == std::string("degrees");
  return parameter.Help + std::string(degrees ? ", in degrees. " : ". ") +
    (more.empty() ? more : more + ". ") + rangeOf(parameter) +
    "Default: " + (usual.empty() ? value : usual);
}

//------------------------------------------------------------------------------
CLI::Option* OptionParser::Word(
  const std::string& name, const std::string& value, const std::string& help, const WordSetter& set)
{
  auto* option = this->App.add_option_function<std::string>(name, set);
  option->type_name(value);
  this->Explain(option, help);
  return option;
}

//------------------------------------------------------------------------------
CLI::Option* OptionParser::Number(const std::string& name, const std::string& value,
  const std::string& help, const NumberSetter& set)
{
  return this->Word(
    name, value, help, [name, set](const std::string& word) { set(toNumber(name, word)); });
}

//------------------------------------------------------------------------------
CLI::Option* OptionParser::Numbers(const std::string& name, const std::string& value,
  const std::string& help, const std::vector<std::size_t>& counts, const NumbersSetter& set)
{
  return this->Word(name, value, help,
    [name, counts, set](const std::string& list) { set(toNumbers(name, list, counts)); });
}

//------------------------------------------------------------------------------
CLI::Option* OptionParser::Choice(
  const std::string& name, const std::string& help, const Choices& choices)
{
  std::string names;
  for (const auto& choice : choices)
  {
    names += (names.empty() ? "" : "|") + choice.first;
  }
  return this->Word(name, names, help,
    [name, choices](const std::string& word)
    {
      std::vector<std::string> words;
      for (const auto& choice : choices)
      {
        words.push_back(choice.first);
      }
      choices[static_cast<std::size_t>(toChoice(name, word, words))].second();
    });
}

//------------------------------------------------------------------------------
std::vector<std::string> wordsOf(const parameters::Parameter& parameter)
{
  if (parameter.Is == parameters::Kind::Flag)
  {
    return { "off", "on" };
  }
  std::vector<std::string> words;
  for (const parameters::Choice& choice : parameter.Choices)
  {
    words.push_back(choice.Word);
  }
  return words;
}

//------------------------------------------------------------------------------
const parameters::Parameter* automaticOf(const parameters::Parameter& parameter)
{
  return std::string(parameter.OptionValue).find("|auto") != std::string::npos
    ? &parameters::Find(parameter.Of, std::string("Automatic") + parameter.Name)
    : nullptr;
}

//------------------------------------------------------------------------------
void OptionParser::Parameter(
  const parameters::Parameter& parameter, const std::string& help, const Owner& owner)
{
  const std::string value = valueName(parameter);
  const parameters::Parameter* automatic = automaticOf(parameter);
  this->Word(parameter.Option, value, help,
    [&parameter, automatic, owner](const std::string& word)
    {
      if (automatic && isWord(word, "auto"))
      {
        automatic->Set(owner(), { 1.0, 0.0, 0.0 });
        return;
      }
      parameter.Set(owner(), toValues(parameter, word));
    });
}

//------------------------------------------------------------------------------
void OptionParser::Flag(const std::string& name, const std::string& help, bool& value)
{
  this->Explain(this->App.add_flag(name, value), help);
}

//------------------------------------------------------------------------------
void OptionParser::Explain(CLI::Option* option, const std::string& help)
{
  option->description(wrapped(help, HelpTextWidth))->group(this->Group);
  this->Briefs.emplace_back(option, wrapped(briefly(help), BriefTextWidth));
}

//------------------------------------------------------------------------------
void OptionParser::BeBrief()
{
  for (const auto& brief : this->Briefs)
  {
    brief.first->description(brief.second);
  }
}

//------------------------------------------------------------------------------
void addSceneParameters(
  OptionParser& parser, vtkReliefScene* scene, parameters::Group group, const std::string& more)
{
  for (const parameters::Parameter* parameter : parameters::Of(parameters::Owner::Scene))
  {
    if (parameter->Option && parameter->In == group)
    {
      parser.Parameter(*parameter, helpOf(*parameter, scene, more), [scene] { return scene; });
    }
  }
}

}
