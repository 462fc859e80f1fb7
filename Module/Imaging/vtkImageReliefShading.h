// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkImageReliefShading
 * @brief   shades a height field: light, soft shadow, translucency and highlights in one pass
 *
 * Input 0 is an image of heights, one component of any numeric type, one slice in x and y. Input 1,
 * optional, is a mask of the same extent, one component of any numeric type: where it is 0 there is
 * no data. NaN, infinite and NoDataValue heights are no data either.
 *
 * Inputs 2, 3 and 4, optional, are textures for the diffuse, base and specular colour: one slice of
 * 1 component (grey), 2 (grey, alpha), 3 (RGB) or 4 (RGB, alpha). unsigned char and unsigned short
 * are sRGB-encoded and 255 and 65535 are 1; float and double are linear; other types are refused.
 * Where alpha is less than 1, and beyond the texture, the material's own constant colour shows. A
 * texture may have another size than the heights: each sample takes the colour at its own position
 * in the world, bilinear between the centres of the texels. Where the texture is much finer than
 * the heights, this picks out single texels: average it to their spacing first. Texels are read
 * where they are: no texture is copied, and only a LookupTable's colours take memory.
 *
 * The output has the input's extent and four components, red, green, blue and alpha: alpha is 1
 * (255) where there is data; elsewhere all four are 0. Float output is linear, 8-bit output is
 * clamped to [0, 1] and sRGB-encoded. Layers that are switched on come as further point arrays of
 * the names of their switches; they are NaN where there is no data.
 *
 * The light that reaches a sample from any direction depends on the whole field, so the whole input
 * is asked for whatever part of the output is, unless HeightRange tells how high it reaches: then a
 * part of the output asks for the heights that its light can touch. Results do not depend on
 * threads or pieces. Threads are vtkSMPTools's. Cost: O(samples x lights x length of the shadows).
 *
 * Bad input (no scalars, a wrong number of components, several slices, no extent, a mask of another
 * extent, a texture of a type that is not listed, a light that is not finite) reports one error and
 * gives an empty output. A texture that lies nowhere on the heights, and texels that are negative
 * or not finite, which count as 0, are told by a warning.
 *
 * Algorithm: F. N. Pramananda Perumal, "An integrated model for direct illumination, subsurface
 * scattering, specular highlights and shadow computation", MSc thesis, Texas A&M University, 2017,
 * chapters 3 and 4, with the thickness summed in closed form over the bilinear surface.
 *
 * @sa vtkReliefScene vtkReliefMaterial vtkReliefStatistics
 */
#ifndef vtkImageReliefShading_h
#define vtkImageReliefShading_h

#include "vtkImageAlgorithm.h"
#include "vtkReliefShadingModule.h" // For export macro

#include <array>  // For std::array
#include <memory> // For std::unique_ptr
#include <string> // For std::string
#include <vector> // For std::vector

class vtkScalarsToColors;

class vtkReliefScene;
class vtkReliefStatistics;

namespace relief
{
class HeightField;
struct Scene;
namespace hosts
{
class TiledHeights;
}
}

class VTKRELIEFSHADING_EXPORT vtkImageReliefShading : public vtkImageAlgorithm
{
public:
  static vtkImageReliefShading* New();
  vtkTypeMacro(vtkImageReliefShading, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The scene: material, lights, height scale, accuracy. Never null: setting null is refused.
   * Default: a new vtkReliefScene.
   */
  void SetScene(vtkReliefScene* scene);
  vtkReliefScene* GetScene();
  ///@}

  ///@{
  /**
   * The mask, input 1: where it is 0 there is no data. Null for none.
   */
  void SetMaskConnection(vtkAlgorithmOutput* port) { this->SetInputConnection(1, port); }
  void SetMaskData(vtkDataObject* mask) { this->SetInputData(1, mask); }
  ///@}

  ///@{
  /**
   * Textures for the diffuse, base and specular colour, inputs 2, 3 and 4: see above. Each lies
   * over the material's constant colour, the diffuse one over the LookupTable's colours too. Null
   * for none.
   */
  void SetDiffuseTextureConnection(vtkAlgorithmOutput* port) { this->SetInputConnection(2, port); }
  void SetDiffuseTextureData(vtkDataObject* texture) { this->SetInputData(2, texture); }
  void SetBaseTextureConnection(vtkAlgorithmOutput* port) { this->SetInputConnection(3, port); }
  void SetBaseTextureData(vtkDataObject* texture) { this->SetInputData(3, texture); }
  void SetSpecularTextureConnection(vtkAlgorithmOutput* port) { this->SetInputConnection(4, port); }
  void SetSpecularTextureData(vtkDataObject* texture) { this->SetInputData(4, texture); }
  ///@}

  ///@{
  /**
   * On: textures cover the whole field, edge to edge, whatever their own origin, spacing and
   * direction say; a texture's first texel lies at the first sample. For pictures that know no
   * position. Off: each lies where its image does in the world. Default: off.
   */
  vtkSetMacro(StretchTextures, bool);
  vtkGetMacro(StretchTextures, bool);
  vtkBooleanMacro(StretchTextures, bool);
  ///@}

  ///@{
  /**
   * A table that gives the diffuse colour by height, as cartographers tint: vtkLookupTable,
   * vtkColorTransferFunction, or any other. It maps the input's own values, before HeightScale; its
   * colours are sRGB-encoded, as VTK's tables are for the screen. Where its opacity is less than 1
   * the material's diffuse colour shows through. The colours take 4 bytes a sample, kept between
   * updates. Null, the default, for none.
   */
  void SetLookupTable(vtkScalarsToColors* table);
  vtkScalarsToColors* GetLookupTable();
  ///@}

  ///@{
  /**
   * The height that marks samples without data, in the input's own values, and whether there is
   * one. Setting the value turns UseNoDataValue on. NaN is no data in any case. Default: off.
   */
  void SetNoDataValue(double value);
  vtkGetMacro(NoDataValue, double);
  vtkSetMacro(UseNoDataValue, bool);
  vtkGetMacro(UseNoDataValue, bool);
  vtkBooleanMacro(UseNoDataValue, bool);
  ///@}

  ///@{
  /**
   * The least and the greatest of all heights, in the input's own values, before HeightScale and
   * without those that are no data; and whether they are known. Then a part of the output asks for
   * a part of the heights and the mask, as vtkImageDataStreamer and pieces over MPI want it: the
   * part itself and what its light can touch, R / tan(a) samples toward a sun at the altitude a
   * over a relief of R samples, and as much as lies between it and a lamp. Where rays leave the
   * data, at holes and borders, further extents are asked for while the filter runs, as far as the
   * border if need be. A part equals that of the whole bit for bit, and the whole that without a
   * range, if the range is exact; a wider one asks for more, and may change illuminations within
   * the tolerance. A range that heights lie outside of is an error.
   *
   * Heights that are read as they are needed (vtkReliefRasterReader::ReadAsNeededOn()) want no
   * range. Textures are asked for whole, and all is where the whole must be known: for 8-bit output
   * with automatic exposure, and on systems that cannot reserve memory (Windows). Setting the range
   * turns UseHeightRange on. Default: 0 to 0, off.
   */
  void SetHeightRange(double least, double greatest);
  void SetHeightRange(const double range[2]) { this->SetHeightRange(range[0], range[1]); }
  vtkGetVector2Macro(HeightRange, double);
  vtkSetMacro(UseHeightRange, bool);
  vtkGetMacro(UseHeightRange, bool);
  vtkBooleanMacro(UseHeightRange, bool);
  ///@}

  ///@{
  /**
   * VTK_FLOAT for linear RGBA, or VTK_UNSIGNED_CHAR for sRGB-encoded RGBA. Default: VTK_FLOAT.
   */
  void SetOutputScalarType(int type);
  vtkGetMacro(OutputScalarType, int);
  void SetOutputScalarTypeToFloat() { this->SetOutputScalarType(VTK_FLOAT); }
  void SetOutputScalarTypeToUnsignedChar() { this->SetOutputScalarType(VTK_UNSIGNED_CHAR); }
  ///@}

  ///@{
  /**
   * The layer "Illumination": d, the share of light that gets through to a sample, averaged over
   * the lights by weight times intensity; 0 without light. Lights that are black do not count. An
   * environment counts as level ground in the open has it, so that a sky alone gives that 1.
   * Default: off.
   */
  vtkSetMacro(GenerateIllumination, bool);
  vtkGetMacro(GenerateIllumination, bool);
  vtkBooleanMacro(GenerateIllumination, bool);
  ///@}

  ///@{
  /**
   * The layer "Thickness": r, how much of the ray toward the first light that is switched on runs
   * inside the material, in the unit of the spacing; infinite where the light is below the horizon.
   * FixedStep's is its count times its step. Default: off.
   */
  vtkSetMacro(GenerateThickness, bool);
  vtkGetMacro(GenerateThickness, bool);
  vtkBooleanMacro(GenerateThickness, bool);
  ///@}

  ///@{
  /**
   * The layer "Shadow": the share of the first sun's disc that the relief hides from a sample, from
   * 0, lit, to 1, in shadow; 0 or 1 where the sun has no width. Geometry alone: depth, floor and
   * everything else of the material do not matter, and slopes that face away are in shadow. As a
   * scene without a sun has none, that is an error. Default: off.
   */
  vtkSetMacro(GenerateShadow, bool);
  vtkGetMacro(GenerateShadow, bool);
  vtkBooleanMacro(GenerateShadow, bool);
  ///@}

  ///@{
  /**
   * The layer "Normals": unit surface normals in world coordinates, three components. Default: off.
   */
  vtkSetMacro(GenerateNormals, bool);
  vtkGetMacro(GenerateNormals, bool);
  vtkBooleanMacro(GenerateNormals, bool);
  ///@}

  ///@{
  /**
   * The layers "Base", "Diffuse", "Scatter" and "Specular": linear RGB contributions that sum to
   * the colour. Default: off.
   */
  vtkSetMacro(GenerateBase, bool);
  vtkGetMacro(GenerateBase, bool);
  vtkBooleanMacro(GenerateBase, bool);
  vtkSetMacro(GenerateDiffuse, bool);
  vtkGetMacro(GenerateDiffuse, bool);
  vtkBooleanMacro(GenerateDiffuse, bool);
  vtkSetMacro(GenerateScatter, bool);
  vtkGetMacro(GenerateScatter, bool);
  vtkBooleanMacro(GenerateScatter, bool);
  vtkSetMacro(GenerateSpecular, bool);
  vtkGetMacro(GenerateSpecular, bool);
  vtkBooleanMacro(GenerateSpecular, bool);
  ///@}

  ///@{
  /**
   * The most memory for illuminations that are kept between updates, in kibibytes: while only
   * colours, intensities, coefficients or falloffs change, no ray of these lights is traced again,
   * and when one light moves, only that light's. A light takes 4 bytes a sample, so the default
   * keeps 64 lights of 1024 x 1024 samples, or 4 of 4096 x 4096; the first lights are kept. 0 keeps
   * none. Default: 262144, which is 256 MiB.
   */
  void SetCacheMemoryLimit(unsigned long kibibytes);
  vtkGetMacro(CacheMemoryLimit, unsigned long);
  ///@}

  ///@{
  /**
   * The most memory, in kibibytes, that heights may take which an extent of the output depends on,
   * where they are read as they are needed (vtkReliefRasterReader::ReadAsNeededOn()); of heights in
   * memory nothing is limited. EstimateMemory() tells what they take. At least 0. Default:
   * VTK_DOUBLE_MAX, no limit.
   */
  void SetHeightMemoryLimit(double kibibytes);
  vtkGetMacro(HeightMemoryLimit, double);
  ///@}

  enum BeyondMemoryModes
  {
    BeyondMemoryRefuse,
    BeyondMemoryBounds
  };

  ///@{
  /**
   * What is done with an extent that depends on heights that would take more than
   * HeightMemoryLimit, as it may with a low sun: smaller extents may take less. Refuse: an error.
   * Bounds: the regions farthest from the extent, 64 x 64 samples each, are left out, as few as the
   * limit demands, never those at holes and borders. Illuminations are found twice where they
   * depend on these, with the least and with the greatest height of each; the middle is taken, and
   * half of the difference is the error. No ray is cut short there, so that all of the scene's
   * Tolerance is left for it; where it is more, at any sample and of any light, that is an error,
   * which says by how much. The layers Thickness and Shadow, and FixedStep, know no tolerance:
   * there both must be the same. The statistics tell what was taken of the tolerance, and how many
   * regions were left out. Where none were, the output is bit for bit that of all heights. Default:
   * Refuse.
   */
  void SetBeyondMemory(int mode);
  vtkGetMacro(BeyondMemory, int);
  void SetBeyondMemoryToRefuse() { this->SetBeyondMemory(BeyondMemoryRefuse); }
  void SetBeyondMemoryToBounds() { this->SetBeyondMemory(BeyondMemoryBounds); }
  ///@}

  /**
   * Frees what is kept between updates: illuminations, the prepared heights, 8 bytes a sample, the
   * LookupTable's colours, and the environment's map, 12 bytes a texel, with its lights.
   */
  void ReleaseCache();

  /**
   * What the last update did.
   */
  vtkReliefStatistics* GetStatistics();

  /**
   * The version of the model, which is raised when the same heights and scene give other results.
   */
  static int GetModelVersion();

  /**
   * A hash of the input's heights, 16 hexadecimal digits, that tells them apart from others: of
   * their values in single precision before HeightScale, of where there are no data, and of the
   * extent's size. It does not depend on the type of the heights, on the machine or on threads. The
   * input is updated; every height is read. Empty, with an error, if there are no heights that can
   * be shaded.
   */
  std::string GetHeightHash();

  ///@{
  /**
   * What an update of an extent of the output would take, where the heights are read as they are
   * needed (vtkReliefRasterReader::ReadAsNeededOn()): about how much memory, in kibibytes, for the
   * heights that it depends on, the output itself not included; more than HeightMemoryLimit where
   * it would fail, even with BeyondMemory at Bounds. And how much work, in numbers that
   * mean something beside one another only. The input is updated. 0 for heights in memory, and,
   * with an error, where nothing can be shaded.
   */
  double EstimateMemory(const int extent[6]) VTK_SIZEHINT(extent, 6);
  double EstimateWork(const int extent[6]) VTK_SIZEHINT(extent, 6);
  ///@}

  /**
   * Changes with the scene and the lookup table.
   */
  vtkMTimeType GetMTime() override;

protected:
  vtkImageReliefShading();
  ~vtkImageReliefShading() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestUpdateExtent(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  double NoDataValue = 0.0;
  bool UseNoDataValue = false;
  double HeightRange[2] = { 0.0, 0.0 };
  bool UseHeightRange = false;
  bool StretchTextures = false;
  int OutputScalarType = VTK_FLOAT;
  bool GenerateIllumination = false;
  bool GenerateThickness = false;
  bool GenerateShadow = false;
  bool GenerateNormals = false;
  bool GenerateBase = false;
  bool GenerateDiffuse = false;
  bool GenerateScatter = false;
  bool GenerateSpecular = false;
  unsigned long CacheMemoryLimit = 262144;
  double HeightMemoryLimit = VTK_DOUBLE_MAX;
  int BeyondMemory = BeyondMemoryRefuse;

private:
  // They look at what is shaded, as the model takes it.
  friend class vtkReliefAccuracyReport;
  friend class vtkReliefVerification;

  int Shade(vtkInformationVector** inputs, vtkInformationVector* outputs);
  vtkInformationVector** UpdateInputs();
  vtkMTimeType GetPipelineMTime();
  std::string PrepareModel(const relief::HeightField*& field, relief::Scene& scene,
    relief::hosts::TiledHeights** tiled = nullptr);
  void ProvideSamples(const std::vector<std::array<int, 2>>& samples);

  vtkImageReliefShading(const vtkImageReliefShading&) = delete;
  void operator=(const vtkImageReliefShading&) = delete;

  class Internals;
  std::unique_ptr<Internals> Internal;
};

#endif
