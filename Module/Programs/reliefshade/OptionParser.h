// SPDX-License-Identifier: BSD-3-Clause
#ifndef OptionParser_h
#define OptionParser_h

#include "SceneParameters.h"

#include <CLI/CLI.hpp>

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

class vtkReliefScene;

namespace reliefshade
{

/// The number that a word is as a whole; else a Failure that names the option and the word.
double toNumber(const std::string& option, const std::string& word);

/// A whole number of any size.
double toWhole(const std::string& option, const std::string& word);

/// Whether a word is that name, in any spelling: FixedStep is fixed-step.
bool isWord(const std::string& word, const std::string& name);

/// A part of a message: "; did you mean --sun?" of a word that is nearly one of some names, else
/// empty.
std::string suggestion(const std::string& word, const std::vector<std::string>& names);

/// The place of a word among the names that are taken; else a Failure that lists them.
int toChoice(
  const std::string& option, const std::string& word, const std::vector<std::string>& names);

/// A whole number of at least 1.
int toCount(const std::string& option, const std::string& word);

/// A number of bytes, above 0, with K, M, G or T for powers of 1024 behind it.
double toBytes(const std::string& option, const std::string& word);

/// Finite numbers between commas, as many as one of `counts` says.
std::vector<double> toNumbers(
  const std::string& option, const std::string& list, const std::vector<std::size_t>& counts);

/// The parts of a list between its commas; at least one.
std::vector<std::string> split(const std::string& list);

/// A parameter's value from a word, as its help says; else a Failure that names the option.
relief::parameters::Values toValues(
  const relief::parameters::Parameter& parameter, const std::string& word);

/// Makes a Failure of what is not taken.
void refuse(const std::string& option, const std::optional<relief::parameters::Refusal>& refusal);

/// What a parameter means, `more` about it, what it takes, and its default: `usual` or, if that is
/// empty, the value that the owner has.
std::string helpOf(const relief::parameters::Parameter& parameter, vtkObject* owner,
  const std::string& more = std::string(), const std::string& usual = std::string());

/// The words that a choice takes on the command line; none for another kind.
std::vector<std::string> wordsOf(const relief::parameters::Parameter& parameter);

/// The switch of a parameter that takes "auto" on the command line; null for another one.
const relief::parameters::Parameter* automaticOf(const relief::parameters::Parameter& parameter);

/// Adds the kinds of option that this program has to CLI11's parser.
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
  using Owner = std::function<vtkObject*()>;
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

  /// The option of a parameter. The help is that of helpOf; the owner is asked for when the option
  /// is given.
  void Parameter(
    const relief::parameters::Parameter& parameter, const std::string& help, const Owner& owner);

  void Flag(const std::string& name, const std::string& help, bool& value);

  /// Gives an option of the parser's group its help: all of it, and its beginning for BeBrief.
  void Explain(CLI::Option* option, const std::string& help);
  /// From now on the parser's help has a line or two for each option, up to the first full stop,
  /// colon or semicolon, and its default.
  void BeBrief();

private:
  CLI::App& App;
  std::vector<std::pair<CLI::Option*, std::string>> Briefs;
  std::string Group;
};

/// Adds the options of a scene's own parameters that belong together.
void addSceneParameters(OptionParser& parser, vtkReliefScene* scene,
  relief::parameters::Group group, const std::string& more = std::string());

}

#endif
