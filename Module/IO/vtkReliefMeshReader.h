// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkReliefMeshReader
 * @brief   reads the polygons of a file of any format of meshes that VTK knows
 *
 * Which reader of VTK reads a file is told by its extension, in any case: OBJ (.obj), PLY (.ply),
 * STL (.stl), VTK's own (.vtp, and .vtk with polygonal data) and glTF (.gltf, .glb). What a file
 * has in several pieces becomes one mesh, and the nodes of glTF are put where they belong. Points,
 * normals and colors come as that reader gives them, in the axes and units of the file; of several
 * pieces only the arrays stay that all of them have. Pictures, skins, shapes to change into and
 * motion are not read. Not read either, and refused, is glTF with sparse accessors in its meshes,
 * with nodes more than 1000 deep below each other, or that requires extensions other than those of
 * materials, of lights and KHR_texture_transform: compressed and quantized meshes. OBJ needs
 * decimal points, and the corners of a face written in one way.
 *
 * A file that cannot be read gives one message, with its name and the reason, an error code and an
 * empty output. What the readers of VTK report is told in that message, or as one warning where the
 * mesh could be read all the same; only damaged files of .vtk and .vtp still print warnings of no
 * object. NoFileNameError: no name. FileNotFoundError. CannotOpenFileError: a directory, or no
 * permission. UnrecognizedFileTypeError: no extension of these. PrematureEndOfFileError: an empty
 * file, or less in it than its header tells. FileFormatError: no such content, no polygons, or
 * polygons of points that are not there. UnknownError: not enough memory.
 *
 * <b>Files of strangers.</b> Files are looked through before VTK's readers get them, and damaged
 * ones have been tried in all formats. VTK's reader of .vtk does not survive all of them: that
 * of 9.1 follows damaged numbers of cells. That of .vtp may print warnings, and take minutes.
 *
 * @sa vtkDepthToHeightField
 */
#ifndef vtkReliefMeshReader_h
#define vtkReliefMeshReader_h

#include "vtkIOReliefShadingModule.h" // For export macro
#include "vtkPolyDataAlgorithm.h"

#include <string> // For std::string
#include <vector> // For std::vector

class VTKIORELIEFSHADING_EXPORT vtkReliefMeshReader : public vtkPolyDataAlgorithm
{
public:
  static vtkReliefMeshReader* New();
  vtkTypeMacro(vtkReliefMeshReader, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The file. Default: null.
   */
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  /**
   * Whether a file's name has the extension of a mesh.
   */
  static bool IsMeshFile(const std::string& fileName);

  /**
   * The other files that such a file is read from: those beside it in which glTF keeps its numbers.
   * Files that are not there are left out. Empty where the file cannot be read, which reports no
   * error.
   */
  static std::vector<std::string> GetFilesBeside(const std::string& fileName);

protected:
  vtkReliefMeshReader();
  ~vtkReliefMeshReader() override;

  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  char* FileName = nullptr;

private:
  vtkReliefMeshReader(const vtkReliefMeshReader&) = delete;
  void operator=(const vtkReliefMeshReader&) = delete;
};

#endif
