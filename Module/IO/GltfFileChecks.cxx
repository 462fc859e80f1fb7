// SPDX-License-Identifier: BSD-3-Clause
#include "GltfFileChecks.h"

#include "FileGuard.h"
#include "Refusals.h"

#include "vtkBase64Utilities.h"
#include "vtkErrorCode.h"

#include "vtksys/SystemTools.hxx"

#include <vtk_jsoncpp.h>

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace relief::io
{

namespace
{
using Model = vtkGLTFDocumentLoader::Model;

bool IsIndex(std::int64_t index, std::size_t count)
{
  return index >= 0 && static_cast<std::uint64_t>(index) < count;
}

// Throws a Failure where it is none, or nested deeper than any glTF: jsoncpp ends that by itself.
Json::Value ParseJson(const std::string& text)
{
  Json::Value root;
  std::string wrong;
  try
  {
    const std::unique_ptr<Json::CharReader> reader(Json::CharReaderBuilder().newCharReader());
    if (!reader->parse(text.data(), text.data() + text.size(), &root, &wrong))
    {
      RefuseFormat("it cannot be read as JSON: " + OneLine(wrong));
    }
  }
  catch (const Json::Exception& exception)
  {
    RefuseFormat("it cannot be read as JSON: " + OneLine(exception.what()));
  }
  return root;
}

// All of the file, or of a binary one the first chunk.
Json::Value ReadJson(const std::string& fileName, bool binary)
{
  std::ifstream file(fileName, std::ios::binary);
  std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  if (binary)
  {
    constexpr std::size_t begin = 20;
    std::uint64_t length = 0;
    for (std::size_t k = 0; k < 4 && text.size() >= begin; ++k)
    {
      length |= static_cast<std::uint64_t>(static_cast<unsigned char>(text[12 + k])) << (8 * k);
    }
    if (text.size() < begin || length > text.size() - begin)
    {
      RefuseEnd("it ends early: its JSON is not all there");
    }
    text = text.substr(begin, static_cast<std::size_t>(length));
  }
  return ParseJson(text);
}

// Of the extensions that a file cannot do without, only those that leave the polygons as they are.
void CheckExtensions(const Json::Value& root)
{
  if (!root.isObject())
  {
    RefuseFormat("it is no glTF: its JSON is no object");
  }
  const Json::Value& required = root["extensionsRequired"];
  if (!required.isNull() && !required.isArray())
  {
    RefuseFormat("its extensionsRequired is no list");
  }
  for (const Json::Value& extension : required)
  {
    const std::string name = extension.isString() ? extension.asString() : "(no name)";
    if (name != "KHR_texture_transform" && name != "KHR_lights_punctual" &&
      name.compare(0, 14, "KHR_materials_") != 0)
    {
      RefuseFormat("it needs " + Shortened(name) + ", which is not read; export it without");
    }
  }
}

//------------------------------------------------------------------------------
// A name as it was before it became part of an address: %20 is a blank.
std::string Decoded(const std::string& uri)
{
  const auto digit = [](char c)
  {
    return c >= '0' && c <= '9' ? c - '0'
      : c >= 'a' && c <= 'f'    ? c - 'a' + 10
      : c >= 'A' && c <= 'F'    ? c - 'A' + 10
                                : -1;
  };
  std::string name;
  for (std::size_t at = 0; at < uri.size(); ++at)
  {
    const int high = uri[at] == '%' && at + 2 < uri.size() ? digit(uri[at + 1]) : -1;
    const int low = high >= 0 ? digit(uri[at + 2]) : -1;
    const bool coded = low >= 0 && high + low > 0;
    name += coded ? static_cast<char>(16 * high + low) : uri[at];
    at += coded ? 2 : 0;
  }
  return name;
}

[[noreturn]] void RefuseLength(std::int64_t length, std::uint64_t there)
{
  RefuseEnd("it ends early: a buffer is to have " + std::to_string(length) +
    " bytes, and there are " + std::to_string(there));
}

// Data that stand in the address itself, as text.
std::vector<char> DataBuffer(const std::string& uri, std::int64_t length)
{
  const std::string mark = ";base64,";
  const std::size_t begin = uri.find(mark);
  if (begin == std::string::npos)
  {
    RefuseFormat("a buffer is written as 'data:' without ';base64,'");
  }
  const std::string text = Decoded(uri.substr(begin + mark.size()));
  const std::uint64_t most = text.size() / 4 * 3;
  if (static_cast<std::uint64_t>(length) > most)
  {
    RefuseLength(length, most);
  }
  std::vector<char> bytes(static_cast<std::size_t>(most));
  const std::size_t count =
    vtkBase64Utilities::DecodeSafely(reinterpret_cast<const unsigned char*>(text.data()),
      text.size(), reinterpret_cast<unsigned char*>(bytes.data()), bytes.size());
  if (static_cast<std::uint64_t>(length) > count)
  {
    RefuseLength(length, count);
  }
  bytes.resize(static_cast<std::size_t>(length));
  return bytes;
}

// Where a file lies that another one names; empty if it is not there.
std::string FileBeside(const std::string& fileName, const std::string& uri)
{
  using vtksys::SystemTools;
  const std::string path = SystemTools::GetFilenamePath(fileName);
  const std::string folder = path.empty() || path.back() == '/' ? path : path + "/";
  for (const std::string& name : { folder + Decoded(uri), folder + uri })
  {
    if (SystemTools::FileExists(name, true))
    {
      return name;
    }
  }
  return std::string();
}

// Data that lie in such a file.
std::vector<char> FileBuffer(
  const std::string& fileName, const std::string& uri, std::int64_t length)
{
  using vtksys::SystemTools;
  const std::string beside = FileBeside(fileName, uri);
  if (beside.empty())
  {
    RefuseFormat("the file \"" + Shortened(Decoded(uri)) + "\" that it names is not there");
  }
  const std::uint64_t there = SystemTools::FileLength(beside);
  if (static_cast<std::uint64_t>(length) > there)
  {
    RefuseLength(length, there);
  }
  std::vector<char> bytes(static_cast<std::size_t>(length));
  std::ifstream file(beside, std::ios::binary);
  if (!file.read(bytes.data(), static_cast<std::streamsize>(bytes.size())))
  {
    RefuseFormat("the file \"" + Shortened(Decoded(uri)) + "\" that it names cannot be read");
  }
  return bytes;
}

// Where a buffer is; empty for one inside the file.
std::string AddressOf(const Json::Value& buffer)
{
  return buffer.isObject() && buffer["uri"].isString() ? buffer["uri"].asString() : "";
}

bool IsData(const std::string& uri)
{
  return uri.compare(0, 5, "data:") == 0;
}

// All buffers: inside the file, beside it, or as text. The loader does not know each way in which
// they are named, so it gets them as they are.
void ReadBuffers(const std::string& fileName, std::vector<char>& inside, Model& model)
{
  const Json::Value buffers = ParseJson(model.BufferMetaData);
  if (!buffers.isArray())
  {
    RefuseFormat("it has no buffers");
  }
  model.Buffers.clear();
  for (const Json::Value& buffer : buffers)
  {
    const std::int64_t length =
      buffer.isObject() && buffer["byteLength"].isInt64() ? buffer["byteLength"].asInt64() : -1;
    if (length < 0)
    {
      RefuseFormat("a buffer has no byteLength");
    }
    const std::string uri = AddressOf(buffer);
    if (uri.empty())
    {
      // Only the first can be inside.
      std::vector<char> bytes;
      bytes.swap(inside);
      if (static_cast<std::uint64_t>(length) > bytes.size())
      {
        RefuseLength(length, bytes.size());
      }
      model.Buffers.push_back(std::move(bytes));
    }
    else
    {
      model.Buffers.push_back(
        IsData(uri) ? DataBuffer(uri, length) : FileBuffer(fileName, uri, length));
    }
  }
  inside.clear();
  model.BufferMetaData = "[]";
}

//------------------------------------------------------------------------------
std::int64_t BytesOf(vtkGLTFDocumentLoader::ComponentType type)
{
  using Type = vtkGLTFDocumentLoader::ComponentType;
  return type == Type::BYTE || type == Type::UNSIGNED_BYTE ? 1
    : type == Type::SHORT || type == Type::UNSIGNED_SHORT  ? 2
                                                           : 4;
}

// Everything that is read lies in its buffer.
void CheckViews(const Model& model)
{
  for (const auto& view : model.BufferViews)
  {
    if (!IsIndex(view.Buffer, model.Buffers.size()) || view.ByteOffset < 0 || view.ByteLength < 0 ||
      view.ByteStride < 0 ||
      std::int64_t{ view.ByteOffset } + view.ByteLength >
        static_cast<std::int64_t>(model.Buffers[static_cast<std::size_t>(view.Buffer)].size()))
    {
      RefuseFormat("a bufferView reaches beyond its buffer");
    }
  }
}

// What a mesh uses lies in its bufferView.
void CheckAccessor(const Model& model, int index)
{
  if (!IsIndex(index, model.Accessors.size()))
  {
    RefuseFormat("a mesh names an accessor that is not there");
  }
  const auto& accessor = model.Accessors[static_cast<std::size_t>(index)];
  if (accessor.IsSparse)
  {
    RefuseFormat("its accessors are sparse, which is not read; export it without");
  }
  if (accessor.BufferView < 0)
  {
    RefuseFormat(
      "an accessor of a mesh has no bufferView, as of compressed meshes; export it without "
      "compression");
  }
  if (!IsIndex(accessor.BufferView, model.BufferViews.size()) || accessor.Count < 0)
  {
    RefuseFormat("an accessor of a mesh names a bufferView that is not there");
  }
  const auto& view = model.BufferViews[static_cast<std::size_t>(accessor.BufferView)];
  const std::int64_t element =
    BytesOf(accessor.ComponentTypeValue) * static_cast<std::int64_t>(accessor.NumberOfComponents);
  const std::int64_t stride = view.ByteStride > 0 ? view.ByteStride : element;
  if (accessor.ByteOffset < 0 ||
    accessor.ByteOffset + (std::int64_t{ accessor.Count } - 1) * stride + element > view.ByteLength)
  {
    RefuseFormat("an accessor reaches beyond its bufferView");
  }
}

bool IsOf(const vtkGLTFDocumentLoader::Accessor& accessor,
  std::initializer_list<vtkGLTFDocumentLoader::AccessorType> types)
{
  return std::find(types.begin(), types.end(), accessor.Type) != types.end();
}

bool BeginsWith(const std::string& text, const char* begin)
{
  return text.rfind(begin, 0) == 0;
}

// Numbers of points, as they are read.
void CheckIndices(const Model& model, int index)
{
  using Component = vtkGLTFDocumentLoader::ComponentType;
  CheckAccessor(model, index);
  const auto& accessor = model.Accessors[static_cast<std::size_t>(index)];
  const Component component = accessor.ComponentTypeValue;
  if (!IsOf(accessor, { vtkGLTFDocumentLoader::AccessorType::SCALAR }) ||
    (component != Component::UNSIGNED_BYTE && component != Component::UNSIGNED_SHORT &&
      component != Component::UNSIGNED_INT))
  {
    RefuseFormat("the indices of a mesh must be SCALAR, and UNSIGNED_BYTE, UNSIGNED_SHORT or "
                 "UNSIGNED_INT");
  }
}

// Points, and what there is for each of them. Arrays of other types stay empty in VTK.
void CheckAttribute(const Model& model, const std::string& name, int index, int points)
{
  using Type = vtkGLTFDocumentLoader::AccessorType;
  using Component = vtkGLTFDocumentLoader::ComponentType;
  CheckAccessor(model, index);
  const auto& accessor = model.Accessors[static_cast<std::size_t>(index)];
  const bool real = accessor.ComponentTypeValue == Component::FLOAT;
  const auto need = [&name](bool fits, const char* expected)
  {
    if (!fits)
    {
      RefuseFormat("the " + Shortened(name) + " of a mesh must be " + expected);
    }
  };
  if (name == "POSITION" || name == "NORMAL")
  {
    need(real && IsOf(accessor, { Type::VEC3 }), "VEC3 of FLOAT");
  }
  else if (name == "TANGENT")
  {
    need(real && IsOf(accessor, { Type::VEC4 }), "VEC4 of FLOAT");
  }
  else if (BeginsWith(name, "TEXCOORD_"))
  {
    need((real || accessor.Normalized) && IsOf(accessor, { Type::VEC2 }),
      "VEC2 of FLOAT or of normalized integers");
  }
  else if (BeginsWith(name, "COLOR_"))
  {
    need((real || accessor.Normalized) && IsOf(accessor, { Type::VEC3, Type::VEC4 }),
      "VEC3 or VEC4 of FLOAT or of normalized integers");
  }
  if (accessor.Count != points)
  {
    RefuseFormat("a mesh has " + std::to_string(points) + " points, and a " + Shortened(name) +
      " for " + std::to_string(accessor.Count));
  }
}

void CheckPrimitive(const Model& model, const vtkGLTFDocumentLoader::Primitive& primitive)
{
  const auto position = primitive.AttributeIndices.find("POSITION");
  if (position == primitive.AttributeIndices.end())
  {
    RefuseFormat("a mesh has no points: a POSITION is expected among its attributes");
  }
  constexpr int fan = 6;
  if (primitive.Mode < 0 || primitive.Mode > fan)
  {
    RefuseFormat(
      "the mode of a mesh is " + std::to_string(primitive.Mode) + "; 0 to 6 is expected");
  }
  CheckAccessor(model, position->second);
  const int points = model.Accessors[static_cast<std::size_t>(position->second)].Count;
  for (const auto& attribute : primitive.AttributeIndices)
  {
    CheckAttribute(model, attribute.first, attribute.second, points);
  }
  int corners = points;
  if (primitive.IndicesId >= 0)
  {
    CheckIndices(model, primitive.IndicesId);
    corners = model.Accessors[static_cast<std::size_t>(primitive.IndicesId)].Count;
  }
  if (primitive.Mode == fan && corners < 3)
  {
    RefuseFormat(
      "a fan of a mesh has " + std::to_string(corners) + " corners, and needs 3 at least");
  }
}

// Only what a mesh at rest has: shapes to change into and what moves with bones are of no use here,
// nor are integers of other programs.
void LeaveOut(Model& model)
{
  for (auto& mesh : model.Meshes)
  {
    for (auto& primitive : mesh.Primitives)
    {
      primitive.Targets.clear();
      auto& attributes = primitive.AttributeIndices;
      for (auto at = attributes.begin(); at != attributes.end();)
      {
        const bool known = at->first == "POSITION" || at->first == "NORMAL" ||
          at->first == "TANGENT" || BeginsWith(at->first, "TEXCOORD_") ||
          BeginsWith(at->first, "COLOR_");
        const bool real = IsIndex(at->second, model.Accessors.size()) &&
          model.Accessors[static_cast<std::size_t>(at->second)].ComponentTypeValue ==
            vtkGLTFDocumentLoader::ComponentType::FLOAT;
        const bool used = known || (BeginsWith(at->first, "_") && real);
        at = used ? std::next(at) : attributes.erase(at);
      }
    }
  }
}

// What is named is there.
void CheckNames(const Model& model)
{
  for (const auto& mesh : model.Meshes)
  {
    for (const auto& primitive : mesh.Primitives)
    {
      CheckPrimitive(model, primitive);
    }
  }
  std::vector<bool> below(model.Nodes.size());
  for (const auto& node : model.Nodes)
  {
    bool there = node.Mesh < 0 || IsIndex(node.Mesh, model.Meshes.size());
    for (const int child : node.Children)
    {
      there =
        there && IsIndex(child, model.Nodes.size()) && !below[static_cast<std::size_t>(child)];
      if (there)
      {
        below[static_cast<std::size_t>(child)] = true;
      }
    }
    if (!there)
    {
      RefuseFormat("a node names a mesh or a node that is not there, or that has another parent");
    }
  }
  // So nodes of a scene are not below themselves.
  for (const auto& scene : model.Scenes)
  {
    for (const unsigned int node : scene.Nodes)
    {
      if (!IsIndex(node, model.Nodes.size()) || below[node])
      {
        RefuseFormat("a scene names a node that is not there, or that has a parent");
      }
    }
  }
}

// Nodes that are not too deep below each other: the loader goes down by calling itself. Each has
// one parent at most, so the way ends.
void CheckDepth(const Model& model)
{
  constexpr int deepest = 1000;
  std::vector<std::pair<std::size_t, int>> open;
  for (const auto& scene : model.Scenes)
  {
    for (const unsigned int node : scene.Nodes)
    {
      open.emplace_back(node, 1);
    }
    while (!open.empty())
    {
      const auto [node, depth] = open.back();
      open.pop_back();
      if (depth > deepest)
      {
        RefuseFormat(
          "its nodes are more than " + std::to_string(deepest) + " deep below each other");
      }
      for (const int child : model.Nodes[node].Children)
      {
        open.emplace_back(static_cast<std::size_t>(child), depth + 1);
      }
    }
  }
}

// Whether the loader has all that the file lists: it leaves out what it finds damaged, and then
// what follows has other numbers.
bool HasAll(const Json::Value& root, const Model& model)
{
  if (root["meshes"].size() != model.Meshes.size())
  {
    RefuseFormat("a mesh is empty");
  }
  return root["accessors"].size() == model.Accessors.size() &&
    root["bufferViews"].size() == model.BufferViews.size() &&
    root["nodes"].size() == model.Nodes.size() && root["scenes"].size() == model.Scenes.size();
}
}

//------------------------------------------------------------------------------
Json::Value ReadGltfJson(const std::string& fileName, bool binary)
{
  Json::Value root = ReadJson(fileName, binary);
  CheckExtensions(root);
  return root;
}

//------------------------------------------------------------------------------
std::vector<std::string> GltfFiles(const std::string& fileName, bool binary)
{
  const Json::Value root = ReadGltfJson(fileName, binary);
  std::vector<std::string> files;
  for (const Json::Value& buffer : root["buffers"])
  {
    const std::string uri = AddressOf(buffer);
    const std::string file = uri.empty() || IsData(uri) ? std::string() : FileBeside(fileName, uri);
    if (!file.empty())
    {
      files.push_back(file);
    }
  }
  return files;
}

//------------------------------------------------------------------------------
bool PrepareGltf(
  const std::string& fileName, const Json::Value& root, std::vector<char>& inside, Model& model)
{
  if (!HasAll(root, model))
  {
    return false;
  }
  LeaveOut(model);
  ReadBuffers(fileName, inside, model);
  CheckViews(model);
  CheckNames(model);
  CheckDepth(model);
  return true;
}

}
