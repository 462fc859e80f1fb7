// SPDX-License-Identifier: BSD-3-Clause
#include "vtkReliefSceneFile.h"

#include "vtkErrorCode.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkReliefEnvironment.h"
#include "vtkReliefScene.h"
#include "vtkReliefSetters.h"

#include "FileGuard.h"
#include "SameFile.h"
#include "SceneText.h"
#include "TemporaryFile.h"

#include <vtksys/FStream.hxx>
#include <vtksys/SystemTools.hxx>

#include <cerrno>
#include <cstring>

vtkStandardNewMacro(vtkReliefSceneFile);

using relief::io::Brief;
using relief::io::Failure;
using relief::io::Guard;
using relief::io::IsReadFrom;
using relief::io::SceneFromText;
using relief::io::SceneToText;
using relief::io::TemporaryFile;
using vtksys::SystemTools;

namespace
{
const std::size_t LargestFile = 16 * 1024 * 1024; // a light takes some 200 bytes

// With its slash; empty if there is no name.
std::string FolderOf(const char* fileName)
{
  if (!fileName || !*fileName)
  {
    return std::string();
  }
  const std::string folder = SystemTools::GetFilenamePath(fileName);
  return folder.empty() ? "./" : folder.back() == '/' ? folder : folder + "/";
}

std::string CheckedName(const char* fileName)
{
  if (!fileName || !*fileName)
  {
    throw Failure(vtkErrorCode::NoFileNameError, "no file name is set");
  }
  return fileName;
}

std::string ReadWholeFile(const std::string& name)
{
  if (!SystemTools::PathExists(name))
  {
    throw Failure(vtkErrorCode::FileNotFoundError, "the file does not exist");
  }
  if (SystemTools::FileIsDirectory(name))
  {
    throw Failure(vtkErrorCode::CannotOpenFileError, "it is a folder");
  }
  errno = 0;
  vtksys::ifstream file(name.c_str(), std::ios::binary);
  if (!file)
  {
    throw Failure(vtkErrorCode::CannotOpenFileError, std::strerror(errno));
  }
  std::string text(LargestFile + 1, '\0');
  file.read(&text[0], static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(file.gcount()));
  if (text.empty())
  {
    throw Failure(vtkErrorCode::PrematureEndOfFileError, "the file is empty");
  }
  if (text.size() > LargestFile)
  {
    throw Failure(vtkErrorCode::FileFormatError, "the file is too large for a scene");
  }
  return text;
}

// Not over the picture that the scene names.
void CheckTarget(const std::string& name, vtkReliefEnvironment* environment)
{
  const char* picture = environment ? environment->GetFileName() : nullptr;
  if (picture && *picture && IsReadFrom(picture, name))
  {
    throw Failure(vtkErrorCode::CannotOpenFileError,
      "it is the picture of the scene's environment; choose another name");
  }
}

void WriteWholeFile(const std::string& name, const std::string& text)
{
  TemporaryFile file(name);
  file.Write(text.data(), text.size());
  if (const int error = file.Finish())
  {
    throw Failure(
      vtkErrorCode::OutOfDiskSpaceError, std::string("writing failed: ") + std::strerror(error));
  }
  file.Keep();
}
}

//------------------------------------------------------------------------------
vtkReliefSceneFile::vtkReliefSceneFile()
  : Scene(vtkSmartPointer<vtkReliefScene>::New())
{
}

//------------------------------------------------------------------------------
vtkReliefSceneFile::~vtkReliefSceneFile()
{
  this->SetFileName(nullptr);
}

//------------------------------------------------------------------------------
void vtkReliefSceneFile::SetScene(vtkReliefScene* scene)
{
  relief::SetObject(this, this->Scene, scene, "Scene");
}

//------------------------------------------------------------------------------
vtkReliefScene* vtkReliefSceneFile::GetScene()
{
  return this->Scene;
}

//------------------------------------------------------------------------------
std::string vtkReliefSceneFile::GetSubject()
{
  return this->FileName && *this->FileName
    ? "\"" + relief::io::Shortened(this->FileName, relief::io::LongestName) + "\""
    : "the scene";
}

//------------------------------------------------------------------------------
bool vtkReliefSceneFile::Finish(const char* what, unsigned long code, const std::string& reason)
{
  this->ErrorCode = code;
  this->ErrorReason = reason;
  if (code != vtkErrorCode::NoError)
  {
    vtkErrorMacro("Cannot " << what << " " << this->GetSubject() << ": " << reason << ".");
  }
  return code == vtkErrorCode::NoError;
}

//------------------------------------------------------------------------------
bool vtkReliefSceneFile::Read()
{
  std::string text;
  std::string reason;
  const unsigned long code =
    Guard([&] { text = ReadWholeFile(CheckedName(this->FileName)); }, reason);
  return code == vtkErrorCode::NoError ? this->FromText(text) : this->Finish("read", code, reason);
}

//------------------------------------------------------------------------------
bool vtkReliefSceneFile::FromText(const std::string& text)
{
  vtkNew<vtkReliefScene> read;
  relief::io::SceneTextReport report;
  std::string reason;
  const unsigned long code =
    Guard([&] { report = SceneFromText(text, FolderOf(this->FileName), read); }, reason);
  if (code == vtkErrorCode::NoError)
  {
    this->Scene->ShallowCopy(read);
  }
  this->NamesHeightScale = report.NamesHeightScale;
  if (!report.UnknownKeys.empty())
  {
    vtkWarningMacro(<< Brief("In " + this->GetSubject() +
                         " these keys are not known, and left out: " + report.UnknownKeys)
                    << ".");
  }
  return this->Finish("read", code, reason);
}

//------------------------------------------------------------------------------
bool vtkReliefSceneFile::Write()
{
  std::string reason;
  const unsigned long code = Guard(
    [&]
    {
      const std::string name = CheckedName(this->FileName);
      CheckTarget(name, this->Scene->GetEnvironment());
      WriteWholeFile(name, SceneToText(this->Scene, FolderOf(this->FileName)));
    },
    reason);
  return this->Finish("write", code, reason);
}

//------------------------------------------------------------------------------
std::string vtkReliefSceneFile::ToText()
{
  std::string text;
  std::string reason;
  const unsigned long code =
    Guard([&] { text = SceneToText(this->Scene, FolderOf(this->FileName)); }, reason);
  this->Finish("write", code, reason);
  return text;
}

//------------------------------------------------------------------------------
void vtkReliefSceneFile::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
  os << indent << "Scene:\n";
  this->Scene->PrintSelf(os, indent.GetNextIndent());
  os << indent << "NamesHeightScale: " << (this->NamesHeightScale ? "On" : "Off") << "\n";
  os << indent << "ErrorCode: " << this->ErrorCode << "\n";
  os << indent << "ErrorReason: " << this->ErrorReason << "\n";
}
