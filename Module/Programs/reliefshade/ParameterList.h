// SPDX-License-Identifier: BSD-3-Clause
#ifndef ParameterList_h
#define ParameterList_h

#include <string>

namespace reliefshade
{

/// The parameters that have an option, as JSON: for programs that offer them without knowing one.
std::string parameterList();

}

#endif
