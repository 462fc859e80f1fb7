// SPDX-License-Identifier: BSD-3-Clause
#ifndef CodeTable_h
#define CodeTable_h

#include <cstdint>

namespace relief
{

/// 8-bit codes of linear values, the same as rounding reliefEncode(): every code's range begins
/// where the curve passes half a code below it, and a table says from which code to look.
class CodeTable
{
public:
  /// The one table.
  static const CodeTable& Get();

  /// The code of a linear value; 0 of one that is not above 0 or no number.
  unsigned char operator()(float linear) const;

  /// Least value of a code.
  float GetBegin(int code) const { return this->Begin[code]; }

  /// The same in one look-up, for lanes. [0, 1] has Steps steps, in none of which two codes begin.
  /// An entry's upper 8 bits are the code at a step's beginning; if as many parts of the step as
  /// lie before the value, of Parts, are added to it, the next code carries over where it begins.
  const std::int32_t* GetEntries() const { return this->Entries; }
  static constexpr int Steps = 4096;
  static constexpr int Parts = 1 << 24;

private:
  CodeTable();
  float Begin[257];
  unsigned char First[Steps + 1];
  std::int32_t Entries[Steps + 1];
};

}

#endif
