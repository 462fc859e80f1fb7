// SPDX-License-Identifier: BSD-3-Clause
#include "SceneJSON.h"

#include "vtkErrorCode.h"

#include "FileGuard.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <memory>
#include <sstream>

namespace relief::io
{
namespace
{
const char* const Infinite = "infinite";

// The fewest digits, not in exponents where people would not write them.
std::string NumberText(double value)
{
  if (value == 0.0)
  {
    return std::signbit(value) ? "-0.0" : "0";
  }
  if (!std::isfinite(value))
  {
    throw Failure(vtkErrorCode::UnknownError, "a light has numbers that are not finite");
  }
  const double size = std::abs(value);
  char text[64];
  const std::to_chars_result end = size >= 1e-5 && size < 1e15
    ? std::to_chars(text, text + sizeof(text), value, std::chars_format::fixed)
    : std::to_chars(text, text + sizeof(text), value);
  return std::string(text, end.ptr);
}

std::string Quoted(const std::string& text)
{
  return Json::valueToQuotedString(text.c_str());
}

// A value as part of a message.
std::string Shown(const Json::Value& value)
{
  Json::StreamWriterBuilder builder;
  builder["indentation"] = "";
  std::string text = Json::writeString(builder, value);
  const std::size_t longest = 60;
  return text.size() > longest ? text.substr(0, longest) + " ..." : text;
}

std::string Listed(const std::vector<std::string>& names)
{
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
  {
    text += (i == 0 ? "" : i + 1 < names.size() ? ", " : " or ") + Quoted(names[i]);
  }
  return text;
}
}

//------------------------------------------------------------------------------
void JSONWriter::Item(const char* key, const std::string& value)
{
  this->Result += this->First ? "" : ",";
  this->Result += this->Depth > 0 ? "\n" + std::string(2 * this->Depth, ' ') : "";
  this->Result += (key ? Quoted(key) + ": " : "") + value;
  this->First = false;
}

//------------------------------------------------------------------------------
void JSONWriter::Begin(const char* key, char bracket)
{
  this->Item(key, std::string(1, bracket));
  ++this->Depth;
  this->First = true;
}

//------------------------------------------------------------------------------
void JSONWriter::End(char bracket)
{
  --this->Depth;
  this->Result += this->First ? "" : "\n" + std::string(2 * this->Depth, ' ');
  this->Result += bracket;
  this->First = false;
}

//------------------------------------------------------------------------------
void JSONWriter::Number(const char* key, double value)
{
  this->Item(key, NumberText(value));
}

//------------------------------------------------------------------------------
void JSONWriter::Count(const char* key, int value)
{
  this->Item(key, std::to_string(value));
}

//------------------------------------------------------------------------------
void JSONWriter::Vector(const char* key, const double* value, int size)
{
  std::string text;
  for (int i = 0; i < size; ++i)
  {
    text += (i == 0 ? "" : ", ") + NumberText(value[i]);
  }
  this->Item(key, "[" + text + "]");
}

//------------------------------------------------------------------------------
void JSONWriter::Parameter(const parameters::Parameter& parameter, const parameters::Values& value)
{
  const char* key = parameter.Key.c_str();
  switch (parameter.Is)
  {
    case parameters::Kind::Length:
      this->Item(key, std::isinf(value[0]) ? Quoted(Infinite) : NumberText(value[0]));
      break;
    case parameters::Kind::Flag:
      this->Item(key, value[0] != 0.0 ? "true" : "false");
      break;
    case parameters::Kind::Choice:
      this->Text(key, parameters::Text(parameter, value));
      break;
    case parameters::Kind::Color:
    case parameters::Kind::Range:
      this->Vector(key, value.data(), parameters::Size(parameter));
      break;
    default:
      this->Number(key, value[0]);
  }
}

//------------------------------------------------------------------------------
void JSONWriter::Text(const char* key, const std::string& value)
{
  this->Item(key, Quoted(value));
}

//------------------------------------------------------------------------------
JSONDocument::JSONDocument(const std::string& text)
  : Source(text)
{
  Json::CharReaderBuilder builder;
  Json::CharReaderBuilder::strictMode(&builder.settings_);
  builder["stackLimit"] = 32;
  const std::unique_ptr<Json::CharReader> reader(builder.newCharReader());
  std::string errors;
  bool parsed = false;
  try
  {
    parsed = reader->parse(text.data(), text.data() + text.size(), &this->Root, &errors);
  }
  catch (const Json::Exception&)
  {
    throw Failure(vtkErrorCode::FileFormatError, "it is no scene: it is nested too deeply");
  }
  if (!parsed)
  {
    // The first of them: "* Line 3, Column 5" and, below it, what is wrong.
    std::istringstream lines(errors);
    std::string where;
    std::string what;
    std::getline(lines, where);
    std::getline(lines, what);
    where.erase(0, where.find_first_not_of("* "));
    what.erase(0, what.find_first_not_of(' '));
    std::transform(where.begin(), where.end(), where.begin(),
      [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    throw Failure(vtkErrorCode::FileFormatError,
      "it is not JSON: " + OneLine(what.empty() ? where : where + ": " + what));
  }
  if (!this->Root.isObject())
  {
    throw Failure(vtkErrorCode::FileFormatError,
      "it holds " + Shown(this->Root) + ", an object with the key \"reliefScene\" is expected");
  }
}

//------------------------------------------------------------------------------
int JSONDocument::GetLine(const Json::Value& value) const
{
  const auto end =
    this->Source.begin() + std::min<std::ptrdiff_t>(value.getOffsetStart(), this->Source.size());
  return 1 + static_cast<int>(std::count(this->Source.begin(), end, '\n'));
}

//------------------------------------------------------------------------------
JSONReader::JSONReader(JSONDocument& document)
  : JSONReader(document, document.Root, std::string())
{
}

//------------------------------------------------------------------------------
JSONReader::JSONReader(JSONDocument& document, const Json::Value& object, const std::string& path)
  : Document(document)
  , Value(object)
  , Path(path)
{
}

//------------------------------------------------------------------------------
std::string JSONReader::PathOf(const std::string& key) const
{
  return this->Path + (this->Path.empty() || key.empty() ? "" : ".") + key;
}

//------------------------------------------------------------------------------
void JSONReader::Fail(const char* key, const std::string& reason)
{
  const Json::Value* value =
    this->Value.isObject() && this->Value.isMember(key) ? &this->Value[key] : &this->Value;
  const std::string path = this->PathOf(key);
  throw Failure(vtkErrorCode::FileFormatError,
    "line " + std::to_string(this->Document.GetLine(*value)) + (path.empty() ? "" : ", " + path) +
      ": " + reason);
}

//------------------------------------------------------------------------------
void JSONReader::Expect(const char* key, const std::string& what)
{
  this->Fail(key, Shown(this->Value[key]) + " was given, " + what + " is expected");
}

//------------------------------------------------------------------------------
const Json::Value* JSONReader::Find(const char* key)
{
  this->Known.insert(key);
  return this->Value.isMember(key) ? &this->Value[key] : nullptr;
}

//------------------------------------------------------------------------------
const Json::Value& JSONReader::Need(const char* key)
{
  const Json::Value* value = this->Find(key);
  if (!value)
  {
    this->Fail("", "the key " + Quoted(key) + " is missing");
  }
  return *value;
}

//------------------------------------------------------------------------------
void JSONReader::Check(const char* key, const std::optional<parameters::Refusal>& refusal)
{
  if (refusal)
  {
    this->Fail(key, refusal->Reason());
  }
}

//------------------------------------------------------------------------------
double JSONReader::NeedNumber(const char* key)
{
  const Json::Value& value = this->Need(key);
  if (!value.isNumeric())
  {
    this->Expect(key, "a number");
  }
  return value.asDouble();
}

//------------------------------------------------------------------------------
int JSONReader::NeedCount(const char* key)
{
  const Json::Value& value = this->Need(key);
  if (!value.isInt())
  {
    this->Expect(key, "a whole number");
  }
  return value.asInt();
}

//------------------------------------------------------------------------------
int JSONReader::NeedChoice(const char* key, const std::vector<std::string>& names)
{
  const Json::Value& value = this->Need(key);
  const std::string word = value.isString() ? value.asString() : std::string();
  const auto found = std::find_if(names.begin(), names.end(),
    [&word](const std::string& name) { return parameters::SameWord(name, word); });
  if (found == names.end())
  {
    this->Expect(key, Listed(names));
  }
  return static_cast<int>(found - names.begin());
}

//------------------------------------------------------------------------------
void JSONReader::NeedVector(const char* key, double* result, int size)
{
  const Json::Value& value = this->Need(key);
  bool good = value.isArray() && value.size() == static_cast<Json::ArrayIndex>(size);
  for (int i = 0; good && i < size; ++i)
  {
    good = value[i].isNumeric();
    result[i] = good ? value[i].asDouble() : 0.0;
  }
  if (!good)
  {
    this->Expect(key, "an array of " + std::to_string(size) + " numbers");
  }
}

//------------------------------------------------------------------------------
std::string JSONReader::NeedText(const char* key)
{
  const Json::Value& value = this->Need(key);
  if (!value.isString() || value.asString().empty())
  {
    this->Expect(key, "a text");
  }
  return value.asString();
}

//------------------------------------------------------------------------------
bool JSONReader::Number(const char* key, double& value)
{
  const bool found = this->Find(key) != nullptr;
  value = found ? this->NeedNumber(key) : value;
  return found;
}

//------------------------------------------------------------------------------
bool JSONReader::Vector(const char* key, double* value, int size)
{
  const bool found = this->Find(key) != nullptr;
  if (found)
  {
    this->NeedVector(key, value, size);
  }
  return found;
}

//------------------------------------------------------------------------------
bool JSONReader::Parameter(const parameters::Parameter& parameter, parameters::Values& value)
{
  const char* key = parameter.Key.c_str();
  const Json::Value* found = this->Find(key);
  if (!found)
  {
    return false;
  }
  switch (parameter.Is)
  {
    case parameters::Kind::Length:
      if (!found->isNumeric() && *found != Infinite)
      {
        this->Expect(key, "a number or " + Quoted(Infinite));
      }
      value[0] = found->isNumeric() ? found->asDouble() : std::numeric_limits<double>::infinity();
      break;
    case parameters::Kind::Count:
      value[0] = this->NeedCount(key);
      break;
    case parameters::Kind::Flag:
      if (!found->isBool())
      {
        this->Expect(key, "true or false");
      }
      value[0] = found->asBool() ? 1.0 : 0.0;
      break;
    case parameters::Kind::Choice:
    {
      // As the command line spells it, too.
      const int place = found->isString() ? FindChoice(parameter, found->asString()) : -1;
      std::vector<std::string> names;
      for (const parameters::Choice& choice : parameter.Choices)
      {
        names.emplace_back(choice.Name);
      }
      value[0] = place < 0 ? this->NeedChoice(key, names) : place;
      break;
    }
    case parameters::Kind::Color:
    case parameters::Kind::Range:
      this->NeedVector(key, value.data(), parameters::Size(parameter));
      break;
    default:
      value[0] = this->NeedNumber(key);
  }
  this->Check(key, parameters::Check(parameter, value));
  return true;
}

//------------------------------------------------------------------------------
void JSONReader::Object(const char* key, const std::function<void(JSONReader&)>& read)
{
  if (const Json::Value* value = this->Find(key))
  {
    if (!value->isObject())
    {
      this->Expect(key, "an object");
    }
    JSONReader inner(this->Document, *value, this->PathOf(key));
    read(inner);
    inner.Finish();
  }
}

//------------------------------------------------------------------------------
void JSONReader::Objects(const char* key, const std::function<void(JSONReader&)>& read)
{
  const Json::Value* array = this->Find(key);
  if (!array)
  {
    return;
  }
  if (!array->isArray() ||
    !std::all_of(array->begin(), array->end(), [](const Json::Value& v) { return v.isObject(); }))
  {
    this->Expect(key, "an array of objects");
  }
  for (Json::ArrayIndex i = 0; i < array->size(); ++i)
  {
    JSONReader inner(
      this->Document, (*array)[i], this->PathOf(key) + "[" + std::to_string(i) + "]");
    read(inner);
    inner.Finish();
  }
}

//------------------------------------------------------------------------------
void JSONReader::Finish()
{
  for (const std::string& key : this->Value.getMemberNames())
  {
    if (this->Known.count(key) == 0)
    {
      std::string& unknown = this->Document.UnknownKeys;
      unknown += (unknown.empty() ? "" : ", ") + this->PathOf(key) + " (line " +
        std::to_string(this->Document.GetLine(this->Value[key])) + ")";
    }
  }
}
}
