// SPDX-License-Identifier: BSD-2-Clause
// The header of a PLY file: what elements follow, how many, with which properties, in which form.
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
  PlyType countType = PlyType::Uint8;  // of a list
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;
  int IndexOf(std::string_view property) const;  // -1: has none of that name
};

struct PlyHeader {
  PlyFormat format = PlyFormat::Ascii;
  std::vector<PlyElement> elements;
  std::size_t bytes = 0;  // of the header itself, end_header line included
};

std::size_t PlySize(PlyType type);  // in a binary file

// Throws PlyError.
PlyHeader ParsePlyHeader(std::string_view bytes);

}  // namespace exphoton
