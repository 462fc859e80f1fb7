// SPDX-License-Identifier: BSD-3-Clause
#ifndef CommandKey_h
#define CommandKey_h

#include <string>
#include <vector>

namespace reliefshade
{

/// What the files of a run depend on before anything is read, one thing a line: the versions of
/// program and model, the words of the command line but those that do not change what comes out,
/// and size and date of the files that they name, and of others.
std::string commandKey(
  const std::vector<std::string>& words, const std::vector<std::string>& files = {});

}

#endif
