// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkReliefSceneFile
 * @brief   a vtkReliefScene as a small text file
 *
 * The file is JSON with one key for each parameter, see Documentation/SceneFile.md. It is made to
 * be read and edited by people. Everything of a scene is in it, and every number comes back as it
 * was, to the last bit:
 *
 *  - a sun by its azimuth and altitude, with `toward`, its direction, where these angles alone
 * would give it another last digit. A positional light by its position. Of their transform matrices
 * only the result is kept, and of a sun neither where it stands nor its focal point;
 *  - an environment's image by its file's name, or as the sky that it is made of. A file in the
 * folder of the scene file or below is named relative to that folder. An image that came from
 * elsewhere cannot be named: the scene is not written.
 *
 * Keys that are missing from a file have their default value.
 *
 * <b>Errors.</b> Read and Write return false, report one error with the file's name, and set an
 * error code: NoFileNameError; FileNotFoundError; CannotOpenFileError for folders and files that
 * may not be read, or places that may not be written; PrematureEndOfFileError for an empty file;
 * FileFormatError for what is no JSON, or not of a scene, or of a newer version, or holds a value
 * that the scene refuses: the message names line and key, what was found and what was expected, or
 * the environment's image that cannot be read; OutOfDiskSpaceError; UnknownError where a scene
 * cannot be written, or memory fails. A failed Read leaves the scene as it is, a failed Write the
 * file that was there. Keys that are not known are left out with one warning that names them.
 *
 * @sa vtkReliefScene
 */
#ifndef vtkReliefSceneFile_h
#define vtkReliefSceneFile_h

#include "vtkIOReliefShadingModule.h" // For export macro
#include "vtkObject.h"
#include "vtkSmartPointer.h" // For vtkSmartPointer

#include <string> // For std::string

class vtkReliefScene;

class VTKIORELIEFSHADING_EXPORT vtkReliefSceneFile : public vtkObject
{
public:
  static vtkReliefSceneFile* New();
  vtkTypeMacro(vtkReliefSceneFile, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The file. Default: null.
   */
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  ///@{
  /**
   * The scene that is read or written. Never null: setting null is refused. Default: a new
   * vtkReliefScene.
   */
  void SetScene(vtkReliefScene* scene);
  vtkReliefScene* GetScene();
  ///@}

  ///@{
  /**
   * Reads the file into the scene, which then has a new material, new lights and a new environment,
   * or writes it. The file appears whole, under a temporary name that is then changed, or not at
   * all; never in place of the picture of the scene's environment.
   */
  bool Read();
  bool Write();
  ///@}

  ///@{
  /**
   * The same from and to a text, for network connections. FileName is not read or
   * written; an environment's image is looked for from its folder. ToText returns an empty text
   * after an error.
   */
  bool FromText(const std::string& text);
  std::string ToText();
  ///@}

  /**
   * Whether the scene that was read last names its height scale. Where it does not, the scale is
   * the default and may be chosen for the heights, by vtkReliefScene::FitHeightScale.
   */
  vtkGetMacro(NamesHeightScale, bool);

  /**
   * Of the last call, from vtkErrorCode; 0 is success.
   */
  vtkGetMacro(ErrorCode, unsigned long);

  /**
   * Why the last call failed, without the file's name and as a part of a sentence; empty after
   * success.
   */
  std::string GetErrorReason() { return this->ErrorReason; }

protected:
  vtkReliefSceneFile();
  ~vtkReliefSceneFile() override;

  char* FileName = nullptr;
  vtkSmartPointer<vtkReliefScene> Scene;
  bool NamesHeightScale = false;
  unsigned long ErrorCode = 0;
  std::string ErrorReason;

private:
  vtkReliefSceneFile(const vtkReliefSceneFile&) = delete;
  void operator=(const vtkReliefSceneFile&) = delete;

  std::string GetSubject();
  bool Finish(const char* what, unsigned long code, const std::string& reason);
};

#endif
