// SPDX-License-Identifier: BSD-3-Clause
#ifndef EnvironmentSection_h
#define EnvironmentSection_h

#include "Section.h"

#include "vtkSmartPointer.h"

class QPushButton;
class vtkReliefEnvironment;

namespace reliefviewer
{

/// Light from all around: a picture, or a sky.
class EnvironmentSection : public Section
{
  Q_OBJECT

public:
  EnvironmentSection(Document* document, QWidget* parent);
  ~EnvironmentSection() override;

signals:
  /// The user is to choose a picture.
  void pictureWanted();

private:
  vtkReliefEnvironment* Environment() const;
  void AddSource();
  void AddSkyFields();
  void AddCommonFields();

  /// The one that the check box took away, to be put back by it.
  vtkSmartPointer<vtkReliefEnvironment> Removed;
  QPushButton* Picture;
};

}

#endif
