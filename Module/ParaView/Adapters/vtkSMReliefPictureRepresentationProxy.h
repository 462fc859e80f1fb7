// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSMReliefPictureRepresentationProxy
 * @brief   how ParaView shows a shaded picture: as it is
 *
 * ParaView colours what it shows by a colour map, with a legend beside it. A shaded picture has
 * colours of its own, so choosing the display "Picture" turns that off; any other kind of display
 * is as ever.
 */
#ifndef vtkSMReliefPictureRepresentationProxy_h
#define vtkSMReliefPictureRepresentationProxy_h

#include "vtkParaViewReliefShadingModule.h" // For export macro
#include "vtkSMPVRepresentationProxy.h"

class VTKPARAVIEWRELIEFSHADING_EXPORT vtkSMReliefPictureRepresentationProxy
  : public vtkSMPVRepresentationProxy
{
public:
  static vtkSMReliefPictureRepresentationProxy* New();
  vtkTypeMacro(vtkSMReliefPictureRepresentationProxy, vtkSMPVRepresentationProxy);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * As the superclass's, but "Picture" uses no colour map.
   */
  bool SetRepresentationType(const char* type) override;

protected:
  vtkSMReliefPictureRepresentationProxy();
  ~vtkSMReliefPictureRepresentationProxy() override;

private:
  vtkSMReliefPictureRepresentationProxy(const vtkSMReliefPictureRepresentationProxy&) = delete;
  void operator=(const vtkSMReliefPictureRepresentationProxy&) = delete;
};

#endif
