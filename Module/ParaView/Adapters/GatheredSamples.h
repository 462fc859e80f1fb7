// SPDX-License-Identifier: BSD-3-Clause
#ifndef GatheredSamples_h
#define GatheredSamples_h

/// @file
/// The samples of an image as the model wants them: whole, in one slice, as points. ParaView gives
/// each process a piece, and light comes from anywhere; and what reads rasters for ParaView gives
/// their values to cells. Not installed.

#include "vtkNew.h"
#include "vtkType.h"

#include <array>
#include <string>
#include <tuple>

class vtkDataArray;
class vtkImageData;
class vtkMultiProcessController;

namespace relief::paraview
{
/// Which array of an image holds the samples. Without a name: the scalars of the points, else those
/// of the cells, else the only array that there is.
struct ArrayChoice
{
  bool ofCells = false;
  std::string name;
};

/// ParaView sends the association and the name of an array; the name may be empty or null.
ArrayChoice ChooseArray(int association, const char* name);

/// The array that is chosen, and whether it belongs to the cells. Null where there is none.
vtkDataArray* FindArray(vtkImageData* image, const ArrayChoice& choice, bool& ofCells);

/// Where the samples of an image of this extent are: its points, or its cells, of which there is
/// one fewer along each axis.
void FindSampleExtent(const int extent[6], bool ofCells, int samples[6]);

/// How far a sample of the cells lies from the point of its index, in steps: a half along each axis
/// that has cells.
void FindSampleShift(const int whole[6], bool ofCells, double shift[3]);

/// Makes an image of one slice of the samples, whole, in every process, as scalars of points. All
/// processes of the controller, which may be null, must call it, each with its own piece, which may
/// be null or empty. The array itself is taken, not copied, where it is already so. Field data come
/// along. Returns an empty text, or what is wrong, in every process the same; an image without
/// points is left where no process has any.
std::string GatherSamples(vtkMultiProcessController* controller, vtkImageData* piece,
  const int whole[6], int slice, const ArrayChoice& choice, vtkImageData* samples);

/// Gathered samples that stay the same object until what they are gathered from changes in any
/// process: what is made of them is kept, too.
class KeptSamples
{
public:
  KeptSamples();
  ~KeptSamples();

  /// As GatherSamples().
  std::string Update(vtkMultiProcessController* controller, vtkImageData* piece, const int whole[6],
    int slice, const ArrayChoice& choice);
  void Release();
  vtkImageData* Get() const { return this->Samples; }

private:
  using Origin =
    std::tuple<vtkImageData*, vtkMTimeType, std::array<int, 6>, int, bool, std::string>;
  vtkNew<vtkImageData> Samples;
  Origin MadeFrom;
  bool Made = false;
};
}

#endif
