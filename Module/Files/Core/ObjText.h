// SPDX-License-Identifier: BSD-3-Clause
#ifndef ObjText_h
#define ObjText_h

/// @file
/// The text of a mesh in the format OBJ: points and the faces between them, and whether every
/// program reads it alike.

#include <cstdint>
#include <string>
#include <vector>

namespace relief::io
{

/// Reads a text line by line. Where its lines come from, and what becomes of points and faces, is
/// told by who derives from it.
class ObjText
{
public:
  virtual ~ObjText() = default;

  /// Takes all lines. Returns an empty text, or what is wrong and in which line. Numbers must be
  /// decimal ones that a float can hold, faces must name points, texture points and normals that
  /// come before them, and have three corners that are written alike. Colors behind points and all
  /// other lines are not read.
  std::string Read();

protected:
  enum Kind
  {
    Points,
    TexturePoints,
    Normals,
    NumberOfKinds
  };

  /// The next line without its end. Returns whether there is one.
  virtual bool NextLine(std::string& line) = 0;

  /// A decimal number of a point, a texture point or a normal. Returns whether a float can hold it.
  /// `plain`: it is so short that it does.
  virtual bool TakeNumber(Kind kind, const char* begin, const char* end, bool plain) = 0;

  /// A face by its points, from 0; its numbers are those of points that have been taken.
  virtual void TakeFace(const std::vector<std::uint64_t>& corners) = 0;

private:
  // One line, which may have gone on behind a backslash.
  struct Line
  {
    std::string Text;
    std::uint64_t Number = 0; // from 1; of the first of its lines
  };

  bool NextWhole(Line& line);
  std::string ReadLine(const Line& line);
  std::string ReadNumbers(const Line& line, Kind kind);
  std::string ReadFace(const Line& line);
  std::string ReadCorner(const Line& line, const char*& at, int& way);

  std::uint64_t Counts[NumberOfKinds] = { 0, 0, 0 };
  std::uint64_t Lines = 0;
  std::vector<std::uint64_t> Corners;
};

}

#endif
