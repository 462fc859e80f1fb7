// SPDX-License-Identifier: BSD-3-Clause
#include "SculptingOptions.h"

#include "Failure.h"
#include "OptionParser.h"
#include "Options.h"

#include "vtkNormalMapToHeightField.h"

namespace
{

using namespace reliefshade;

//------------------------------------------------------------------------------
std::array<double, 3> toDirection(const std::string& option, const std::vector<double>& numbers)
{
  if (numbers[0] == 0.0 && numbers[1] == 0.0 && numbers[2] == 0.0)
  {
    throw Failure(option, "0,0,0 is no direction", UsageFailure);
  }
  return { numbers[0], numbers[1], numbers[2] };
}

}

namespace reliefshade
{

//------------------------------------------------------------------------------
void addSculptingOptions(OptionParser& parser, Options& options)
{
  const auto set = [](auto& member, auto value) { return [&member, value] { member = value; }; };
  parser.SetGroup("Heights of meshes and of normal maps, and reliefs");
  parser.Numbers("--view", "X,Y,Z",
    "From where a mesh is seen. A vector from it toward the eye in the mesh's own axes, of any "
    "length but 0. Default: 0,0,1",
    { 3 },
    [&options](const std::vector<double>& v)
    { options.View.Direction = toDirection("--view", v); });
  parser.Numbers("--view-up", "X,Y,Z",
    "What of a mesh points up in the picture, as --view has it. Default: 0,1,0; where the view is "
    "along that, -z as seen from above and z as seen from below",
    { 3 },
    [&options](const std::vector<double>& v) { options.View.Up = toDirection("--view-up", v); });
  parser.Word("--resolution", "N",
    "How many samples a mesh has along its longer side. 1 to 65536. Default: 1024",
    [&options](const std::string& word)
    {
      options.View.Resolution = toCount("--resolution", word);
      if (*options.View.Resolution > 65536)
      {
        throw Failure("--resolution", "at most 65536 is possible", UsageFailure);
      }
    });
  parser.Choice("--normal-map",
    "INPUT is a picture of a surface's normals, from which its heights are found, in the unit of "
    "--spacing; a georeference is not read. Where green points: up, down, or what suits the "
    "picture "
    "better",
    { { "auto", set(options.Sculpted.Green, vtkNormalMapToHeightField::AutomaticGreen) },
      { "up", set(options.Sculpted.Green, vtkNormalMapToHeightField::Up) },
      { "down", set(options.Sculpted.Green, vtkNormalMapToHeightField::Down) } });
  parser.Choice("--normal-method",
    "How normals become heights: smoothly, with cliffs where the normals ask for them, or by sums "
    "along rows and columns, for comparison. Default: least-squares",
    { { "least-squares",
        set(options.Sculpted.Integration, vtkNormalMapToHeightField::LeastSquares) },
      { "cliffs",
        set(options.Sculpted.Integration, vtkNormalMapToHeightField::DiscontinuityPreserving) },
      { "path-sums", set(options.Sculpted.Integration, vtkNormalMapToHeightField::PathSums) } });
  parser.Word("--relief", "SHARE",
    "Squeezes the depth of INPUT into a relief, as sculptors do, of so much of its height. Above "
    "0, "
    "at most 1: 0.02 for a medal",
    [&options](const std::string& word)
    {
      const double share = toNumbers("--relief", word, { 1 })[0];
      if (!(share > 0.0 && share <= 1.0))
      {
        throw Failure(
          "--relief", word + " was given, a share above 0 and at most 1 is expected", UsageFailure);
      }
      options.Sculpted.Relief = share;
    });
}

}
