// SPDX-License-Identifier: BSD-3-Clause
#ifndef SceneJSON_h
#define SceneJSON_h

/// @file
/// Writes JSON that people like to read, and reads JSON with messages that people understand. Both
/// classes have the same methods for values, so that one list of keys serves both. Private to the
/// module.

#include "vtkReliefMessages.h"
#include "vtkSmartPointer.h"

#include "vtk_jsoncpp.h"

#include <functional>
#include <set>
#include <string>
#include <vector>

class vtkObject;

namespace relief::io
{
/// Objects have a key in each line, vectors are in one line. Numbers have as few digits as bring
/// them back to the last bit.
class JSONWriter
{
public:
  void BeginObject(const char* key) { this->Begin(key, '{'); }
  void EndObject() { this->End('}'); }
  void BeginArray(const char* key) { this->Begin(key, '['); }
  void EndArray() { this->End(']'); }

  // The last argument is what a JSONReader calls.
  void Number(const char* key, double value, const std::function<void(double)>& = {});
  void Length(const char* key, double value, const std::function<void(double)>& = {});
  void Count(const char* key, int value, const std::function<void(int)>& = {});
  void Flag(const char* key, bool value, const std::function<void(bool)>& = {});
  void Choice(const char* key, int value, const std::vector<const char*>& names,
    const std::function<void(int)>& = {});
  void Vector(
    const char* key, const double* value, int size, const std::function<void(const double*)>& = {});
  void Text(const char* key, const std::string& value);

  std::string GetText() const { return this->Result + "\n"; }

private:
  void Begin(const char* key, char bracket);
  void End(char bracket);
  void Item(const char* key, const std::string& value);

  std::string Result;
  int Depth = 0;
  bool First = true;
};

/// A text that has been parsed. The constructor throws a Failure that names line and column.
class JSONDocument
{
public:
  explicit JSONDocument(const std::string& text);

  /// Errors of this object are mistakes in the file.
  void Watch(vtkObject* object);

  std::string GetUnknownKeys() const { return this->UnknownKeys; }

private:
  friend class JSONReader;
  int GetLine(const Json::Value& value) const;

  const std::string& Source;
  Json::Value Root;
  std::string UnknownKeys;
  vtkSmartPointer<vtkReliefFirstMessage> Message;
};

/// Reads one object of a document. Methods throw a Failure, FileFormatError, for a value of another
/// type and for one that its setter refuses; those named Need do for a missing key too.
class JSONReader
{
public:
  explicit JSONReader(JSONDocument& document);

  void Number(const char* key, double, const std::function<void(double)>& set);
  void Length(const char* key, double, const std::function<void(double)>& set);
  void Count(const char* key, int, const std::function<void(int)>& set);
  void Flag(const char* key, bool, const std::function<void(bool)>& set);
  void Choice(const char* key, int, const std::vector<const char*>& names,
    const std::function<void(int)>& set);
  void Vector(
    const char* key, const double*, int size, const std::function<void(const double*)>& set);
  void Object(const char* key, const std::function<void(JSONReader&)>& read);
  void Objects(const char* key, const std::function<void(JSONReader&)>& read);

  double NeedNumber(const char* key);
  int NeedCount(const char* key);
  int NeedChoice(const char* key, const std::vector<const char*>& names);
  void NeedVector(const char* key, double* value, int size);
  std::string NeedText(const char* key);

  /// Runs a step that may make a watched object report an error.
  void Check(const std::function<void()>& step);

  [[noreturn]] void Fail(const char* key, const std::string& reason);

  /// All other keys are unknown.
  void Finish();

private:
  JSONReader(JSONDocument& document, const Json::Value& object, const std::string& path);

  const Json::Value* Find(const char* key);
  const Json::Value& Need(const char* key);
  [[noreturn]] void Expect(const char* key, const std::string& what);
  void Set(const char* key, const std::function<void()>& step);
  std::string PathOf(const std::string& key) const;

  JSONDocument& Document;
  const Json::Value& Value;
  std::string Path;
  std::set<std::string> Known;
};
}

#endif
