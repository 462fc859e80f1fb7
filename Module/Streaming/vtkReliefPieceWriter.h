// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkReliefPieceWriter
 * @brief   writes a shading of any size, piece by piece, by one process or by many
 *
 * Shades a vtkImageReliefShading in pieces that fit into memory, which wait in the folder
 * `FileName.parts`, and puts the file together when all of them are there: a GeoTIFF with the place
 * of the heights, bit for bit what vtkReliefRasterWriter writes of the whole. Each layer that the
 * shading generates gets a file of its own, `NAME-illumination.tif` and so on.
 *
 * A run that was ended before its time goes on where it was when the same is asked for again, with
 * any number of processes. Nothing is under the files' own names until all of it is there. If
 * anything that the picture depends on has changed meanwhile, that is an error, which names what;
 * remove the folder to begin anew. A piece that is damaged is told, and shaded again.
 *
 * Of several processes, which share a file system, each tells by SetProcess() which it is. They
 * take three steps, and no one takes a step before all have taken the last: Begin(), the first
 * process before the others; Shade(); Finish(). How they wait for one another is theirs; in Python
 * reliefshading.shade_pieces() does all of this over a communicator of MPI. Write() is all steps of
 * one process.
 *
 * Heights are to be such that are read as needed (vtkReliefRasterReader::ReadAsNeededOn), or to be
 * in memory. They are told apart by their hash.
 *
 * Every step returns whether it could be taken; GetErrorCode() says as well. It reports one error,
 * unless the shading has. Progress is that of the step.
 *
 * @sa vtkReliefRasterWriter vtkImageReliefShading vtkReliefRasterReader
 */
#ifndef vtkReliefPieceWriter_h
#define vtkReliefPieceWriter_h

#include "vtkAlgorithm.h"
#include "vtkIOReliefStreamingModule.h" // For export macro
#include "vtkSmartPointer.h"            // For vtkSmartPointer

#include <functional> // For std::function
#include <memory>     // For std::unique_ptr

class vtkImageReliefShading;

class VTKIORELIEFSTREAMING_EXPORT vtkReliefPieceWriter : public vtkAlgorithm
{
public:
  static vtkReliefPieceWriter* New();
  vtkTypeMacro(vtkReliefPieceWriter, vtkAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * What is shaded. Default: null.
   */
  void SetShading(vtkImageReliefShading* shading);
  vtkImageReliefShading* GetShading();
  ///@}

  ///@{
  /**
   * The file of the picture, which ends in .tif or .tiff. Default: null.
   */
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  ///@{
  /**
   * Which process this is, from 0, and of how many. Default: 0 of 1. Others than 0 <= process <
   * processes are refused.
   */
  void SetProcess(int process, int processes);
  vtkGetMacro(Process, int);
  vtkGetMacro(NumberOfProcesses, int);
  ///@}

  ///@{
  /**
   * The memory that this process may take, in kibibytes; at least 1. Pieces are cut by it, so that
   * it has to be the same for all processes, and when a run goes on. Default: the machine's.
   */
  vtkSetClampMacro(MemoryLimit, vtkTypeInt64, 1, VTK_TYPE_INT64_MAX);
  vtkGetMacro(MemoryLimit, vtkTypeInt64);
  ///@}

  ///@{
  /**
   * How the files are stored: as in vtkReliefRasterWriter. Defaults: none of these.
   */
  vtkSetMacro(CloudOptimized, bool);
  vtkGetMacro(CloudOptimized, bool);
  vtkBooleanMacro(CloudOptimized, bool);
  vtkSetMacro(Overviews, bool);
  vtkGetMacro(Overviews, bool);
  vtkBooleanMacro(Overviews, bool);
  ///@}

  /**
   * Looks at all heights, unless that has been done, cuts the picture into pieces and opens the
   * folder.
   */
  bool Begin();

  /**
   * Shades the pieces of this process that are not there yet.
   */
  bool Shade();

  /**
   * The first process writes the files and removes the folder; the others have nothing more to do.
   */
  bool Finish();

  /**
   * All three, of one process.
   */
  bool Write();

  ///@{
  /**
   * How many pieces there are, and how many of them the last Shade() has shaded.
   */
  int GetNumberOfPieces();
  vtkGetMacro(NumberOfShadedPieces, int);
  ///@}

protected:
  vtkReliefPieceWriter();
  ~vtkReliefPieceWriter() override;

  char* FileName = nullptr;
  int Process = 0;
  int NumberOfProcesses = 1;
  vtkTypeInt64 MemoryLimit;
  bool CloudOptimized = false;
  bool Overviews = false;
  int NumberOfShadedPieces = 0;

private:
  vtkReliefPieceWriter(const vtkReliefPieceWriter&) = delete;
  void operator=(const vtkReliefPieceWriter&) = delete;

  bool Try(const std::function<void()>& step);
  void GoOn(double share);

  struct Internals;
  std::unique_ptr<Internals> Internal;
  vtkSmartPointer<vtkImageReliefShading> Shading;
};

#endif
