// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkReliefParameters
 * @brief   the list of all parameters of scenes, materials, environments and lights
 *
 * For programs that offer every parameter without knowing one: panels, keywords, files. Parameters
 * are numbered from 0, in the order of scene files. A parameter of the owner "Material" and the
 * name "Density" is set by vtkReliefMaterial::SetDensity and got by GetDensity; those of a "Light"
 * belong to vtkLight, and AngularDiameter to vtkReliefScene::SetAngularDiameter. The package
 * reliefshading has the same as a list, `reliefshading.parameters()`. An index that does not exist
 * is answered with an empty text or 0.
 *
 * @sa vtkReliefScene vtkReliefMaterial vtkReliefEnvironment
 */
#ifndef vtkReliefParameters_h
#define vtkReliefParameters_h

#include "vtkObject.h"
#include "vtkReliefShadingModule.h" // For export macro

#include <string> // For std::string

class VTKRELIEFSHADING_EXPORT vtkReliefParameters : public vtkObject
{
public:
  static vtkReliefParameters* New();
  vtkTypeMacro(vtkReliefParameters, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  static int GetNumberOfParameters();

  ///@{
  /**
   * Whose it is: Scene, Material, Environment or Light; its name as in its setter's; and its key in
   * scene files.
   */
  static std::string GetOwner(int index);
  static std::string GetName(int index);
  static std::string GetKey(int index);
  ///@}

  /**
   * number; length, which may be infinite; count, a whole number; flag; color, of three linear
   * components; range, two numbers of which the first is not the larger; choice.
   */
  static std::string GetKind(int index);

  ///@{
  /**
   * A sentence without its full stop, a short label, and the unit: degrees, or made of the unit of
   * the spacing; empty if it has none.
   */
  static std::string GetHelp(int index);
  static std::string GetLabel(int index);
  static std::string GetUnit(int index);
  ///@}

  /**
   * How many numbers its value is: 1, 2 or 3.
   */
  static int GetNumberOfComponents(int index);

  ///@{
  /**
   * Its default, and between which numbers each component lies, which may be infinite. The lower
   * end is taken itself unless it is open.
   */
  static double GetDefault(int index, int component = 0);
  static double GetMinimum(int index);
  static double GetMaximum(int index);
  static bool GetMinimumOpen(int index);
  ///@}

  ///@{
  /**
   * The names of a choice's values, which are numbered from 0. No other kind has any.
   */
  static int GetNumberOfChoices(int index);
  static std::string GetChoice(int index, int choice);
  ///@}

  /**
   * The option of the program reliefshade; empty if it has none of its own.
   */
  static std::string GetOption(int index);

protected:
  vtkReliefParameters() = default;
  ~vtkReliefParameters() override = default;

private:
  vtkReliefParameters(const vtkReliefParameters&) = delete;
  void operator=(const vtkReliefParameters&) = delete;
};

#endif
