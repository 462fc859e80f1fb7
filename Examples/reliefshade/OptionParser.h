// SPDX-License-Identifier: BSD-3-Clause
#ifndef OptionParser_h
#define OptionParser_h

#include <CLI/CLI.hpp>

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace reliefshade
{

/// The number that a word is as a whole; else a Failure that names the option and the word.
double toNumber(const std::string& option, const std::string& word);

/// A whole number of at least 1.
int toCount(const std::string& option, const std::string& word);

/// Finite numbers between commas, as many as one of `counts` says.
std::vector<double> toNumbers(
  const std::string& option, const std::string& list, const std::vector<std::size_t>& counts);

/// The parts of a list between its commas; at least one.
std::vector<std::string> split(const std::string& list);

/// Turns what a setter of the scene has said against a value into a Failure of the option: the
/// ranges are written down once, in the module.
void refuseWhatTheSceneRefuses(const std::string& option);

/// Adds the kinds of option that this program has to CLI11's parser. What a setter makes the scene
/// report becomes a Failure.
class OptionParser
{
public:
  explicit OptionParser(CLI::App& app)
    : App(app)
  {
  }

  /// The heading that the options added from now on have in the help.
  void SetGroup(const std::string& group) { this->Group = group; }

  using WordSetter = std::function<void(const std::string&)>;
  using NumberSetter = std::function<void(double)>;
  using NumbersSetter = std::function<void(const std::vector<double>&)>;
  using Choices = std::vector<std::pair<std::string, std::function<void()>>>;

  /// `value` is what the help calls the option's value.
  CLI::Option* Word(const std::string& name, const std::string& value, const std::string& help,
    const WordSetter& set);
  CLI::Option* Number(const std::string& name, const std::string& value, const std::string& help,
    const NumberSetter& set);

  /// Finite numbers between commas, as many as one of `counts` says.
  CLI::Option* Numbers(const std::string& name, const std::string& value, const std::string& help,
    const std::vector<std::size_t>& counts, const NumbersSetter& set);

  /// One of some words.
  CLI::Option* Choice(const std::string& name, const std::string& help, const Choices& choices);

  void Flag(const std::string& name, const std::string& help, bool& value);

private:
  CLI::App& App;
  std::string Group;
};

}

#endif
