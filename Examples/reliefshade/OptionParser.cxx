// SPDX-License-Identifier: BSD-3-Clause
#include "OptionParser.h"

#include "Failure.h"
#include "MessageLog.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <sstream>

namespace
{

using namespace reliefshade;

constexpr std::size_t HelpTextWidth = 64;

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

}

namespace reliefshade
{

//------------------------------------------------------------------------------
double toNumber(const std::string& option, const std::string& word)
{
  // The program never sets a locale, so this is the C locale's reading: a point, no comma.
  char* end = nullptr;
  const double number = std::strtod(word.c_str(), &end);
  if (word.empty() || std::isspace(static_cast<unsigned char>(word[0])) || *end)
  {
    throw Failure(option, "'" + word + "' is not a number", UsageFailure);
  }
  return number;
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
  const double number = toNumber(option, word);
  if (!(number >= 1.0 && number <= 1e9) || number != std::floor(number))
  {
    throw Failure(option, "'" + word + "' is not a whole number of at least 1", UsageFailure);
  }
  return static_cast<int>(number);
}

//------------------------------------------------------------------------------
void refuseWhatTheSceneRefuses(const std::string& option)
{
  if (!hasError())
  {
    return;
  }
  // "SetDensity: -1 was given, ... is expected; 1 is kept."
  std::string message = takeError();
  message.erase(0, message.find(": ") + 2);
  throw Failure(option, message.substr(0, message.rfind("; ")), UsageFailure);
}

//------------------------------------------------------------------------------
CLI::Option* OptionParser::Word(
  const std::string& name, const std::string& value, const std::string& help, const WordSetter& set)
{
  auto* option = this->App.add_option_function<std::string>(
    name,
    [name, set](const std::string& word)
    {
      set(word);
      refuseWhatTheSceneRefuses(name);
    },
    wrapped(help, HelpTextWidth));
  option->type_name(value)->group(this->Group);
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
    [name, names, choices](const std::string& word)
    {
      for (const auto& choice : choices)
      {
        if (choice.first == word)
        {
          choice.second();
          return;
        }
      }
      throw Failure(name, "'" + word + "' is none of " + names, UsageFailure);
    });
}

//------------------------------------------------------------------------------
void OptionParser::Flag(const std::string& name, const std::string& help, bool& value)
{
  this->App.add_flag(name, value, wrapped(help, HelpTextWidth))->group(this->Group);
}

}
