// SPDX-License-Identifier: BSD-3-Clause
#include "AccuracyOutput.h"

#include "AccuracyChart.h"
#include "AccuracyPage.h"
#include "Failure.h"
#include "ImageFormats.h"
#include "MessageLog.h"
#include "PictureOutput.h"
#include "Watch.h"

#include "vtkImageData.h"
#include "vtkImageReliefShading.h"
#include "vtkNew.h"
#include "vtkReliefAccuracyReport.h"
#include "vtkReliefScene.h"

#include <iostream>

namespace
{

using namespace reliefshade;

//------------------------------------------------------------------------------
/// Words in lines of so many characters at most.
std::vector<std::string> wrap(const std::string& words, std::size_t most)
{
  std::vector<std::string> lines;
  for (std::size_t begin = 0; begin < words.size();)
  {
    std::size_t end = words.size();
    if (end - begin > most)
    {
      end = words.rfind(' ', begin + most);
    }
    lines.push_back(words.substr(begin, end - begin));
    begin = end + 1;
  }
  return lines;
}

//------------------------------------------------------------------------------
void writeChart(const OutputFile& file, const AccuracyTable& table)
{
  std::vector<std::string> captions = wrap(adviceOf(table), 120);
  for (const std::string& note : notesOf(table))
  {
    captions.push_back(note);
  }
  writePicture(file.Name(), imageFormats().Paint(drawAccuracy(table, captions)));
  stopIfInterrupted();
  if (hasError())
  {
    throw Failure(file.Target(), file.Reword(takeError()));
  }
}

//------------------------------------------------------------------------------
std::string pageOf(const AccuracyTable& table, vtkImageReliefShading* shading,
  vtkReliefScene* scene, const std::string& input)
{
  AccuracySubject subject;
  subject.Input = input;
  int size[3];
  vtkImageData::SafeDownCast(shading->GetInputDataObject(0, 0))->GetDimensions(size);
  subject.Columns = size[0];
  subject.Rows = size[1];
  std::string reason;
  subject.Scene = imageFormats().SceneText("scene.json", scene, reason);
  if (subject.Scene.empty()) // an environment that no file holds
  {
    takeError();
    subject.Scene = reason;
  }
  return toPage(table, subject);
}

}

namespace reliefshade
{

//------------------------------------------------------------------------------
bool isReport(const std::string& file)
{
  const std::string extension = relief::io::LowerExtension(file);
  return extension == ".png" || extension == ".csv" || extension == ".html";
}

//------------------------------------------------------------------------------
AccuracyOutput::AccuracyOutput(const std::string& file)
  : File(file)
{
  aboutFile(file, [&] { relief::io::CheckPlace(this->File.Name()); });
}

//------------------------------------------------------------------------------
void AccuracyOutput::Write(
  vtkImageReliefShading* shading, vtkReliefScene* scene, const std::string& input, bool bar) const
{
  vtkNew<vtkReliefAccuracyReport> report;
  report->SetShading(shading);
  watch(report, bar, "measuring");
  report->Update();
  stopIfInterrupted();
  if (hasError())
  {
    throw Failure(input, takeError());
  }
  const AccuracyTable table = readTable(report);
  const std::string extension = relief::io::LowerExtension(this->File.Target());
  if (extension == ".png")
  {
    writeChart(this->File, table);
  }
  else
  {
    this->File.WriteText(extension == ".csv" ? toCsv(table) : pageOf(table, shading, scene, input));
  }
  std::cout << adviceOf(table) << std::endl;
}

}
