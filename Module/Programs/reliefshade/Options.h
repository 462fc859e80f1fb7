// SPDX-License-Identifier: BSD-3-Clause
#ifndef Options_h
#define Options_h

#include "GeoTiffForm.h"
#include "HeightScaling.h"
#include "LayersWriter.h"
#include "MeshHeights.h"
#include "RasterFiles.h"
#include "SculptedHeights.h"
#include "StandardStreams.h"
#include "SunTimes.h"

#include "vtkNew.h"
#include "vtkReliefScene.h"

#include <array>
#include <memory>
#include <optional>
#include <string>

namespace reliefshade
{

/// What the command line asks for.
struct Options
{
  std::string Input;
  /// Empty if no picture is wanted.
  std::string Output;
  /// Where INPUT or OUTPUT is a standard stream; null elsewhere. The latter's Output is the file
  /// that is to go there.
  std::unique_ptr<StandardStreams> Streams;
  bool StreamsOutput = false;
  /// The --format, empty for what the extension tells.
  std::string Format;
  std::string Mask;
  ReadOptions Reading;
  MeshView View;
  Sculpting Sculpted;
  /// From one sample to the next along x and y, in place of the file's.
  std::optional<std::array<double, 2>> Spacing;

  HeightScaling Scaling = HeightScaling::Usual;
  bool SmoothSteps = false;

  /// Material, lights and accuracy. The positions of positional lights are still those of the map.
  vtkNew<vtkReliefScene> Scene;
  /// The file that the scene was read from, and the one that it is kept in; empty for none.
  std::string SceneFile;
  std::string SavedScene;
  /// The picture that the scene's file names; empty for none.
  std::string SceneEnvironment;
  /// Suns that are placed when the heights are read, and times of several pictures.
  SunTimes Times;
  /// What of the scene is still the file's, to give way to options.
  bool LightsOfFile = false;
  bool EnvironmentOfFile = false;

  /// Files; empty for none. The scene has an environment for the first, still without an image.
  std::string Environment;
  bool MirrorEnvironment = false;
  std::string DiffuseTexture;
  std::string BaseTexture;
  std::string SpecularTexture;
  std::string Tint;

  /// VTK_FLOAT, VTK_UNSIGNED_CHAR, or VTK_VOID to go by the output's extension.
  int OutputType = VTK_VOID;
  /// The components of Output.
  enum PictureBands
  {
    AutoBands,
    Grey,
    Rgb,
    Rgba
  };
  PictureBands Bands = AutoBands;
  /// How it tells where there is no data.
  enum NoDataMarks
  {
    UsualNoData,
    ByAlpha,
    ByValue
  };
  NoDataMarks NoDataOut = UsualNoData;
  /// How TIFF is stored.
  relief::raster::GeoTiffForm Tiff;
  /// Names of layers, of those that layerNames() lists.
  LayerNames Layers;
  /// One OpenEXR file for the colour and these layers; if empty, each layer has a file of its own.
  std::string LayersFile;

  /// The picture of the first sun's shadow; empty for none.
  std::string ShadowMask;

  /// The folder of tiles for web maps, empty for none; then Output is a file in it. Their least and
  /// greatest zoom, and the samples along their sides.
  std::string TilesFolder;
  std::optional<std::array<int, 2>> TilesZoom;
  int TilesSize = 256;

  /// The file that what accuracy costs is written to; empty for none.
  std::string AccuracyReport;
  /// How many samples are retraced after shading, 0 for none, and which.
  int VerifiedSamples = 0;
  unsigned int VerifiedSeed = 1;

  int Threads = 0;
  /// What needs more is refused, in bytes; 0 for none. Whether the user has said so.
  double MemoryLimit = 0.0;
  bool MemoryLimitGiven = false;
  /// What needs more is shaded in pieces, in bytes; 0 where the user does not say.
  double Memory = 0.0;
  /// Where even the least piece needs more, the farthest heights are known by their bounds only.
  bool BoundsBeyondMemory = false;
  bool Statistics = false;
  bool Quiet = false;
};

/// Reads the command line. Returns false if it asked for help or the version, which are then
/// printed. Throws a Failure that names the option.
bool parseOptions(int argc, char* argv[], Options& options);

}

#endif
