// SPDX-License-Identifier: BSD-3-Clause
#ifndef HostInputs_h
#define HostInputs_h

/// @file
/// What the filter and the mapper take in, and how: the ports, the scene and the colour table, and
/// what is made of them and kept. Not installed.

#include "EnvironmentLights.h"
#include "PieceHeights.h"
#include "PlacedTextures.h"
#include "PreparedHeights.h"

#include "vtkIndent.h"
#include "vtkReliefShadingModule.h" // For export macro
#include "vtkSmartPointer.h"

#include <functional>
#include <iosfwd>
#include <string>

class vtkAlgorithm;
class vtkDataArray;
class vtkImageData;
class vtkInformation;
class vtkInformationVector;
class vtkObject;
class vtkReliefScene;
class vtkScalarsToColors;

namespace relief::hosts
{
class VTKRELIEFSHADING_EXPORT HostInputs
{
public:
  enum Port
  {
    HeightsPort,
    MaskPort,
    DiffusePort,
    BasePort,
    SpecularPort,
    NumberOfPorts
  };

  /// How inputs are read, as a host's setters have it.
  struct Reading
  {
    bool useNoData = false;
    double noData = 0.0;
    bool stretchTextures = false;
  };

  /// Messages are told in the host's name, and setters modify it.
  explicit HostInputs(vtkObject* host);
  ~HostInputs();
  HostInputs(const HostInputs&) = delete;
  void operator=(const HostInputs&) = delete;

  ///@{
  /// The ports: each takes an image, the later ones if there is one, and reads its scalars unless
  /// another array is named. Light comes from anywhere and textures lie anywhere, so all of each is
  /// asked for.
  static void NameArrays(vtkAlgorithm* host);
  static int FillPort(int port, vtkInformation* info);
  static void AskForAll(vtkInformationVector** inputs);
  /// Of the heights and the mask it may be a part.
  static void AskForPart(vtkInformationVector** inputs, const int extent[6]);
  ///@}

  ///@{
  /// The bodies of a host's setters. The scene is never null.
  void SetScene(vtkReliefScene* scene);
  vtkReliefScene* GetScene() const;
  void SetLookupTable(vtkScalarsToColors* table);
  vtkScalarsToColors* GetLookupTable() const;
  void SetNoDataValue(double value, double& held, bool& used);
  ///@}

  /// The latest of the host's own time and those of scene and table.
  vtkMTimeType GetMTime(vtkMTimeType own) const;

  void Print(ostream& os, vtkIndent indent, const Reading& reading) const;

  /// The heights and the mask that are at the ports, unchecked, with a scale of 1. Without heights
  /// there is no image.
  static HeightInputs ReadHeights(vtkInformationVector** inputs,
    const std::function<vtkDataArray*(int)>& arrays, const Reading& reading);

  /// Gathers what is at the ports, `arrays` telling the array to read at each, checks it, and
  /// prepares heights and places textures anew where they have changed. Heights are padded only for
  /// hosts that sweep, and where the model wants it. Returns an empty text, or what is wrong.
  std::string Update(vtkInformationVector** inputs, const std::function<vtkDataArray*(int)>& arrays,
    const Reading& reading, bool sweeps);

  ///@{
  /// The same of a piece of the picture, by the range of all heights. AskForPiece() asks the ports
  /// for what it depends on; once that has come, UpdatePiece() takes it and prepares all else.
  /// While MissesOfPiece() tells of a further extent, UpdatePieceFurther() has it brought and takes
  /// it. The updates return an empty text, or what is wrong.
  void AskForPiece(vtkInformationVector** inputs, const double range[2], const int piece[6]);
  std::string UpdatePiece(vtkInformationVector** inputs,
    const std::function<vtkDataArray*(int)>& arrays, const Reading& reading, const double range[2],
    const int piece[6]);
  bool MissesOfPiece(const Scene& scene, const int piece[6], int extent[6]);
  std::string UpdatePieceFurther(vtkAlgorithm* host, const int extent[6],
    vtkInformationVector** inputs, const std::function<vtkDataArray*(int)>& arrays,
    const Reading& reading);
  std::string RestorePiece(vtkAlgorithm* host, const int extent[6], vtkInformationVector** inputs,
    const std::function<vtkDataArray*(int)>& arrays, const Reading& reading);
  ///@}

  ///@{
  /// What the last update prepared.
  const HeightField& GetField() const
  {
    return this->OfPiece ? this->Piece.GetHeld().GetField() : this->Heights.GetField();
  }
  const ImageFrame& GetFrame() const
  {
    return this->OfPiece ? this->Piece.GetHeld().Frame : this->Heights.GetFrame();
  }
  /// The heights' image; of a piece as a whole, without heights.
  vtkImageData* GetImage(vtkInformationVector** inputs) const;
  TiledHeights* GetTiledHeights() const { return this->Heights.GetTiled(); }
  PlacedTextures& GetTextures() { return this->Textures; }
  EnvironmentLights& GetEnvironmentLights() { return this->Environment; }
  ///@}

  /// Frees what is kept between updates.
  void Release();

private:
  static std::string Bring(vtkAlgorithm* host, const int extent[6]);
  std::string Place(const TextureInput& heights, vtkInformationVector** inputs,
    const std::function<vtkDataArray*(int)>& arrays, const Reading& reading);
  bool WantsPadding(int columns) const;

  vtkObject* Host;
  vtkSmartPointer<vtkReliefScene> Scene;
  vtkSmartPointer<vtkScalarsToColors> LookupTable;
  PreparedHeights Heights;
  PieceHeights Piece;
  bool OfPiece = false; // whether these were prepared last
  PlacedTextures Textures;
  EnvironmentLights Environment;
};
}

#endif
