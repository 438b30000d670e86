// SPDX-License-Identifier: BSD-2-Clause
// ParsePlyHeader checks every line. It never allocates memory by a count that the file claims.
#include "shapes/mesh/ply_header.h"

#include <charconv>
#include <optional>

#include "shapes/mesh/ply_reader.h"

namespace exphoton {
namespace {

std::vector<std::string_view> Words(std::string_view line) {
  std::vector<std::string_view> words;
  std::size_t at = 0;
  while ((at = line.find_first_not_of(" \t\r", at)) != std::string_view::npos) {
    const std::size_t end = std::min(line.find_first_of(" \t\r", at), line.size());
    words.push_back(line.substr(at, end - at));
    at = end;
  }
  return words;
}

PlyType TypeNamed(std::string_view name) {
  struct Entry {
    std::string_view oldName, newName;
    PlyType type;
  };
  constexpr Entry kTypes[] = {
      {"char", "int8", PlyType::Int8},        {"uchar", "uint8", PlyType::Uint8},
      {"short", "int16", PlyType::Int16},     {"ushort", "uint16", PlyType::Uint16},
      {"int", "int32", PlyType::Int32},       {"uint", "uint32", PlyType::Uint32},
      {"float", "float32", PlyType::Float32}, {"double", "float64", PlyType::Float64}};
  for (const Entry& entry : kTypes)
    if (name == entry.oldName || name == entry.newName) return entry.type;
  throw PlyError("its header has the unknown type \"" + std::string(name) + "\"");
}

PlyFormat FormatNamed(const std::vector<std::string_view>& words) {
  if (words.size() == 3 && words[2] == "1.0") {
    if (words[1] == "ascii") return PlyFormat::Ascii;
    if (words[1] == "binary_little_endian") return PlyFormat::LittleEndian;
    if (words[1] == "binary_big_endian") return PlyFormat::BigEndian;
  }
  throw PlyError("its format is not ascii, binary_little_endian or binary_big_endian 1.0");
}

PlyElement ElementOf(const std::vector<std::string_view>& words) {
  PlyElement element;
  const std::string_view count = words.size() == 3 ? words[2] : std::string_view();
  const auto result = std::from_chars(count.data(), count.data() + count.size(), element.count);
  if (count.empty() || result.ec != std::errc() || result.ptr != count.data() + count.size())
    throw PlyError("its header has an element without a valid count");
  element.name = words[1];
  return element;
}

PlyProperty PropertyOf(const std::vector<std::string_view>& words) {
  PlyProperty property;
  if (words.size() == 3) {
    property.type = TypeNamed(words[1]);
  } else if (words.size() == 5 && words[1] == "list") {
    property.isList = true;
    property.countType = TypeNamed(words[2]);
    property.type = TypeNamed(words[3]);
  } else {
    throw PlyError("its header has a property that is neither a number nor a list");
  }
  property.name = words.back();
  return property;
}

}  // namespace

int PlyElement::IndexOf(std::string_view property) const {
  for (std::size_t i = 0; i < properties.size(); ++i)
    if (properties[i].name == property) return int(i);
  return -1;
}

std::size_t PlySize(PlyType type) {
  switch (type) {
    case PlyType::Int8:
    case PlyType::Uint8:
      return 1;
    case PlyType::Int16:
    case PlyType::Uint16:
      return 2;
    case PlyType::Int32:
    case PlyType::Uint32:
    case PlyType::Float32:
      return 4;
    case PlyType::Float64:
      return 8;
  }
  return 1;
}

PlyHeader ParsePlyHeader(std::string_view bytes) {
  PlyHeader header;
  std::optional<PlyFormat> format;
  for (int line = 0;; ++line) {
    const std::size_t end = bytes.find('\n', header.bytes);
    if (end == std::string_view::npos) {
      throw PlyError(line == 0 ? "it is not a PLY file (the first line must be \"ply\")"
                               : "its header has no \"end_header\"");
    }
    const auto words = Words(bytes.substr(header.bytes, end - header.bytes));
    header.bytes = end + 1;
    if (line == 0) {
      if (words.size() != 1 || words[0] != "ply")
        throw PlyError("it is not a PLY file (the first line must be \"ply\")");
    } else if (words.empty() || words[0] == "comment" || words[0] == "obj_info") {
      continue;
    } else if (words[0] == "format") {
      format = FormatNamed(words);
    } else if (words[0] == "element") {
      header.elements.push_back(ElementOf(words));
    } else if (words[0] == "property") {
      if (header.elements.empty()) throw PlyError("its header has a property before any element");
      header.elements.back().properties.push_back(PropertyOf(words));
    } else if (words[0] == "end_header") {
      break;
    } else {
      throw PlyError("its header has the unknown line \"" + std::string(words[0].substr(0, 40)) +
                     "\"");
    }
  }
  if (!format) throw PlyError("its header has no format line");
  header.format = *format;
  return header;
}

}  // namespace exphoton
