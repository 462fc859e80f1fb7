// SPDX-License-Identifier: BSD-3-Clause
#ifndef Failure_h
#define Failure_h

#include "FileGuard.h"

#include <stdexcept>
#include <string>
#include <vector>

namespace reliefshade
{

/// What the program can end with, as --help lists it.
enum ExitCode
{
  Success = 0,
  RunFailure = 1,
  UsageFailure = 2,
  Interrupted = 130 // 128 + SIGINT, as shells report it
};

/// What the user may choose otherwise to get on. The message says nothing of it: a command line has
/// an option for it, a window a dialog or a menu, and each its own words.
enum class Remedy
{
  None,
  Band,      ///< another band of the file
  Channel,   ///< one of its channels
  Colors,    ///< what its colours mean, or one of them
  Indices,   ///< the indices of a palette
  Degrees,   ///< no degrees
  NumberType ///< another type of numbers in the picture
};

/// A reason to stop that the user can act on: one brief line about one file or option.
class Failure : public std::runtime_error
{
public:
  Failure(const std::string& subject, const std::string& message, ExitCode code = RunFailure,
    Remedy mends = Remedy::None)
    : std::runtime_error(relief::io::Brief(subject.empty() ? message : subject + ": " + message))
    , Code(code)
    , Mends(mends)
  {
  }

  ExitCode Code;
  Remedy Mends;
  std::vector<std::string> Bands; ///< to choose from: names, or empty texts
};

}

#endif
