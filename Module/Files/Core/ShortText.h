// SPDX-License-Identifier: BSD-3-Clause
#ifndef ShortText_h
#define ShortText_h

#include <cstddef>
#include <string>

namespace relief::io
{

/// A name or a word of a file as a message shows it: of a long one the beginning and the end, about
/// as many bytes as given.
std::string Shortened(const std::string& text, std::size_t longest = 64);

}

#endif
