// SPDX-License-Identifier: BSD-3-Clause
#ifndef SceneJSON_h
#define SceneJSON_h

/// @file
/// Writes JSON that people like to read, and reads JSON with messages that people understand.
/// Private to the module.

#include "SceneParameters.h"

#include "vtk_jsoncpp.h"

#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

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

  void Number(const char* key, double value);
  void Count(const char* key, int value);
  void Vector(const char* key, const double* value, int size);
  void Text(const char* key, const std::string& value);
  void Parameter(const parameters::Parameter& parameter, const parameters::Values& value);

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

  std::string GetUnknownKeys() const { return this->UnknownKeys; }

private:
  friend class JSONReader;
  int GetLine(const Json::Value& value) const;

  const std::string& Source;
  Json::Value Root;
  std::string UnknownKeys;
};

/// Reads one object of a document. Methods throw a Failure, FileFormatError, for a value of another
/// type and for one that its parameter does not take; those named Need do for a missing key too.
class JSONReader
{
public:
  explicit JSONReader(JSONDocument& document);

  /// Returns false, and leaves the value as it is, where the key is missing.
  bool Number(const char* key, double& value);
  bool Vector(const char* key, double* value, int size);
  bool Parameter(const parameters::Parameter& parameter, parameters::Values& value);
  void Object(const char* key, const std::function<void(JSONReader&)>& read);
  void Objects(const char* key, const std::function<void(JSONReader&)>& read);

  double NeedNumber(const char* key);
  int NeedCount(const char* key);
  int NeedChoice(const char* key, const std::vector<std::string>& names);
  void NeedVector(const char* key, double* value, int size);
  std::string NeedText(const char* key);

  [[noreturn]] void Fail(const char* key, const std::string& reason);
  /// Fails if there is a refusal.
  void Check(const char* key, const std::optional<parameters::Refusal>& refusal);

  /// All other keys are unknown.
  void Finish();

private:
  JSONReader(JSONDocument& document, const Json::Value& object, const std::string& path);

  const Json::Value* Find(const char* key);
  const Json::Value& Need(const char* key);
  [[noreturn]] void Expect(const char* key, const std::string& what);
  std::string PathOf(const std::string& key) const;

  JSONDocument& Document;
  const Json::Value& Value;
  std::string Path;
  std::set<std::string> Known;
};
}

#endif
