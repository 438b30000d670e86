// SPDX-License-Identifier: BSD-2-Clause
// PlyHeader holds the header of a PLY file: the format, and the elements with their properties.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace exphoton {

enum class PlyFormat { Ascii, LittleEndian, BigEndian };
enum class PlyType { Int8, Uint8, Int16, Uint16, Int32, Uint32, Float32, Float64 };

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::Float32;
  bool isList = false;
  PlyType countType = PlyType::Uint8;  // type of a list's length
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;
  int IndexOf(std::string_view property) const;  // -1: no such property
};

struct PlyHeader {
  PlyFormat format = PlyFormat::Ascii;
  std::vector<PlyElement> elements;
  std::size_t bytes = 0;  // size of the header, including the end_header line
};

std::size_t PlySize(PlyType type);  // bytes in a binary file

// Throws PlyError if the header is not valid.
PlyHeader ParsePlyHeader(std::string_view bytes);

}  // namespace exphoton
