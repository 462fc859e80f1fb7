// SPDX-License-Identifier: BSD-3-Clause
#ifndef AccuracyOutput_h
#define AccuracyOutput_h

#include "OutputFile.h"

#include <string>

class vtkImageReliefShading;
class vtkReliefScene;

namespace reliefshade
{

/// Whether a file of that name is one that a report can be written as.
bool isReport(const std::string& file);

/// Measures what accuracy costs, and writes it as a chart (.png), as numbers (.csv) or as a page
/// (.html).
class AccuracyOutput
{
public:
  /// Finds out at once whether the place can be written. Throws a Failure that names the file.
  explicit AccuracyOutput(const std::string& file);

  /// Measures the shading, prints which setting to take, and writes under the staged name. The
  /// scene is the one to be told, `input` the file of its heights. Throws a Failure.
  void Write(vtkImageReliefShading* shading, vtkReliefScene* scene, const std::string& input,
    bool bar) const;

  /// Takes the target's name once it is kept.
  OutputFile& GetFile() { return this->File; }

private:
  OutputFile File;
};

}

#endif
