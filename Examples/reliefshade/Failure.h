// SPDX-License-Identifier: BSD-3-Clause
#ifndef Failure_h
#define Failure_h

#include <stdexcept>
#include <string>

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

/// A reason to stop that the user can act on: one line about one file or option.
class Failure : public std::runtime_error
{
public:
  Failure(const std::string& subject, const std::string& message, ExitCode code = RunFailure)
    : std::runtime_error(subject.empty() ? message : subject + ": " + message)
    , Code(code)
  {
  }

  ExitCode Code;
};

}

#endif
