// SPDX-License-Identifier: BSD-3-Clause
#include "CommandKey.h"

#include "SurveyFile.h"

#include "vtkImageReliefShading.h"

#include <algorithm>
#include <sstream>

namespace
{

/// Options that only say how a run is done, and those of them that have a value.
const std::vector<std::string> Indifferent = { "--memory", "--memory-limit", "--quiet",
  "--statistics", "--threads", "--xyz" };
const std::vector<std::string> WithValue = { "--memory", "--memory-limit", "--threads", "--xyz" };

bool isAmong(const std::string& word, const std::vector<std::string>& words)
{
  return std::find(words.begin(), words.end(), word) != words.end();
}

//------------------------------------------------------------------------------
/// A word, and what file it names, if it does.
std::string lineOf(const std::string& word, const std::string& file)
{
  const std::string state = relief::raster::StateOfInput(file);
  return word + (state.empty() ? "" : " (" + state + ")") + "\n";
}

}

namespace reliefshade
{

//------------------------------------------------------------------------------
std::string commandKey(const std::vector<std::string>& words, const std::vector<std::string>& files)
{
  std::ostringstream key;
  key << "reliefshade " RELIEFSHADE_VERSION ", model " << vtkImageReliefShading::GetModelVersion()
      << "\n";
  for (std::size_t k = 0; k < words.size(); ++k)
  {
    const std::size_t equals =
      words[k].compare(0, 2, "--") == 0 ? words[k].find('=') : std::string::npos;
    const std::string option = words[k].substr(0, equals);
    if (isAmong(option, Indifferent))
    {
      k += isAmong(option, WithValue) && equals == std::string::npos ? 1 : 0;
      continue;
    }
    const std::string value = equals == std::string::npos ? words[k] : words[k].substr(equals + 1);
    key << lineOf(words[k], value);
  }
  for (const std::string& file : files)
  {
    key << lineOf(file, file);
  }
  return key.str();
}

}
