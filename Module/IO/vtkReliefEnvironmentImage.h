// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkReliefEnvironmentImage
 * @brief   reads the image of an environment from a file
 *
 * An environment holds an image and touches no file; this reads one with vtkOpenImageIOReader and
 * tells the environment where it came from, so that scene files can name it.
 *
 * @sa vtkReliefEnvironment vtkOpenImageIOReader vtkReliefSceneFile
 */
#ifndef vtkReliefEnvironmentImage_h
#define vtkReliefEnvironmentImage_h

#include "vtkIOReliefShadingModule.h" // For export macro
#include "vtkObject.h"

#include <string> // For std::string

class vtkReliefEnvironment;

class VTKIORELIEFSHADING_EXPORT vtkReliefEnvironmentImage : public vtkObject
{
public:
  static vtkReliefEnvironmentImage* New();
  vtkTypeMacro(vtkReliefEnvironmentImage, vtkObject);

  /**
   * Reads a latitude-longitude image and sets it together with its file's name. Returns false, and
   * keeps the old image, if the file cannot be read; one error of the environment then says which
   * and why.
   */
  static bool Read(vtkReliefEnvironment* environment, VTK_FILEPATH const char* fileName);

  /**
   * The same without reporting an error: returns why the file cannot be read, as a part of a
   * sentence that does not name it, or an empty text.
   */
  static std::string TryToRead(
    vtkReliefEnvironment* environment, VTK_FILEPATH const char* fileName);

protected:
  vtkReliefEnvironmentImage() = default;
  ~vtkReliefEnvironmentImage() override = default;

private:
  vtkReliefEnvironmentImage(const vtkReliefEnvironmentImage&) = delete;
  void operator=(const vtkReliefEnvironmentImage&) = delete;
};

#endif
