// SPDX-License-Identifier: BSD-2-Clause
// ParsePly reads the body of a PLY file. It trusts counts only as far as the file is long enough.
#include "shapes/mesh/ply_reader.h"

#include <zlib.h>

#include <bit>
#include <charconv>
#include <cstring>

#include "core/base/memory.h"
#include "core/files/input_file.h"
#include "core/files/open_file.h"
#include "shapes/mesh/ply_header.h"

namespace exphoton {
namespace {

// NumberStream reads numbers one after the other, in any format.
class NumberStream {
 public:
  NumberStream(std::string_view bytes, PlyFormat format) : rest_(bytes), format_(format) {}

  double Next(PlyType type) {
    if (format_ == PlyFormat::Ascii) return NextWord();
    const std::size_t size = PlySize(type);
    if (rest_.size() < size) throw PlyError("it ends before all its data");
    unsigned char raw[8];
    std::memcpy(raw, rest_.data(), size);
    rest_.remove_prefix(size);
    if ((format_ == PlyFormat::BigEndian) == (std::endian::native == std::endian::little))
      std::reverse(raw, raw + size);
    return Decode(raw, type);
  }

  // Throws PlyError if the remaining data is too short for this many rows.
  void NeedRows(std::uint64_t rows, const PlyElement& element) const {
    std::uint64_t least = 0;
    for (const PlyProperty& property : element.properties) {
      const PlyType type = property.isList ? property.countType : property.type;
      least += format_ == PlyFormat::Ascii ? 1 : PlySize(type);
    }
    if (least == 0 || rows <= rest_.size() / least) return;
    throw PlyError("it claims " + std::to_string(rows) + " rows of \"" + element.name +
                   "\", more than its size allows");
  }

 private:
  template <class T>
  static double As(const unsigned char* raw) {
    T value;
    std::memcpy(&value, raw, sizeof value);
    return double(value);
  }
  static double Decode(const unsigned char* raw, PlyType type) {
    switch (type) {
      case PlyType::Int8:
        return As<std::int8_t>(raw);
      case PlyType::Uint8:
        return As<std::uint8_t>(raw);
      case PlyType::Int16:
        return As<std::int16_t>(raw);
      case PlyType::Uint16:
        return As<std::uint16_t>(raw);
      case PlyType::Int32:
        return As<std::int32_t>(raw);
      case PlyType::Uint32:
        return As<std::uint32_t>(raw);
      case PlyType::Float32:
        return As<float>(raw);
      case PlyType::Float64:
        return As<double>(raw);
    }
    return 0;
  }
  double NextWord() {
    constexpr std::string_view kSpace = " \t\r\n";
    rest_.remove_prefix(std::min(rest_.find_first_not_of(kSpace), rest_.size()));
    if (rest_.empty()) throw PlyError("it ends before all its data");
    const std::string_view word = rest_.substr(0, rest_.find_first_of(kSpace));
    rest_.remove_prefix(word.size());
    const char* begin = word.data() + (word[0] == '+' ? 1 : 0);
    double value = 0;
    const auto result = std::from_chars(begin, word.data() + word.size(), value);
    if (result.ec != std::errc() || result.ptr != word.data() + word.size())
      throw PlyError("it has \"" + std::string(word.substr(0, 40)) + "\" instead of a number");
    return value;
  }

  std::string_view rest_;
  PlyFormat format_;
};

// Calls visit(scalars, entries) for every row. `entries` holds the entries of the list property
// `list` (-1: none); other lists are skipped.
template <class Visit>
void ForEachRow(NumberStream& stream, const PlyElement& element, int list, Visit&& visit) {
  stream.NeedRows(element.count, element);
  std::vector<double> scalars(element.properties.size()), entries;
  for (std::uint64_t row = 0; row < element.count; ++row) {
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
      const PlyProperty& property = element.properties[i];
      if (!property.isList) {
        scalars[i] = stream.Next(property.type);
        continue;
      }
      const double count = stream.Next(property.countType);
      if (!(count >= 0) || count != std::floor(count) || count > 1e9)
        throw PlyError("it has a list with " + std::to_string(count) + " entries");
      if (int(i) == list) entries.clear();
      for (std::int64_t k = 0; k < std::int64_t(count); ++k) {
        const double value = stream.Next(property.type);
        if (int(i) == list) entries.push_back(value);
      }
    }
    visit(scalars, entries);
  }
}

int FirstOf(const PlyElement& element, std::initializer_list<const char*> names) {
  for (const char* name : names) {
    const int index = element.IndexOf(name);
    if (index >= 0 && !element.properties[std::size_t(index)].isList) return index;
  }
  return -1;
}

Real FiniteReal(double value, const char* what) {
  const Real rounded = Real(value);
  if (!std::isfinite(rounded))
    throw PlyError(std::string("it has a ") + what + " that is not a finite number");
  return rounded;
}

void ReadVertices(NumberStream& stream, const PlyElement& element, TriangleMesh* mesh) {
  const int p[3] = {FirstOf(element, {"x"}), FirstOf(element, {"y"}), FirstOf(element, {"z"})};
  const int n[3] = {FirstOf(element, {"nx"}), FirstOf(element, {"ny"}), FirstOf(element, {"nz"})};
  const int uv[2] = {FirstOf(element, {"u", "s", "texture_u", "texture_s"}),
                     FirstOf(element, {"v", "t", "texture_v", "texture_t"})};
  if (p[0] < 0 || p[1] < 0 || p[2] < 0) throw PlyError("its vertices have no x, y and z");
  if (element.count >= (std::uint64_t(1) << 32)) throw PlyError("it has too many vertices");
  const bool hasN = n[0] >= 0 && n[1] >= 0 && n[2] >= 0, hasUv = uv[0] >= 0 && uv[1] >= 0;
  ForEachRow(stream, element, -1, [&](const std::vector<double>& row, const auto&) {
    const auto at = [&](int index, const char* what) {
      return FiniteReal(row[std::size_t(index)], what);
    };
    mesh->p.push_back({at(p[0], "position"), at(p[1], "position"), at(p[2], "position")});
    if (hasN) mesh->n.push_back({at(n[0], "normal"), at(n[1], "normal"), at(n[2], "normal")});
    if (hasUv)
      mesh->uv.push_back({at(uv[0], "texture coordinate"), at(uv[1], "texture coordinate")});
  });
}

void ReadFaces(NumberStream& stream, const PlyElement& element, std::uint64_t vertexCount,
               TriangleMesh* mesh) {
  int list = element.IndexOf("vertex_indices");
  if (list < 0) list = element.IndexOf("vertex_index");
  if (list < 0 || !element.properties[std::size_t(list)].isList)
    throw PlyError("its faces have no list \"vertex_indices\"");
  std::uint64_t face = 0;
  ForEachRow(stream, element, list, [&](const auto&, const std::vector<double>& corners) {
    if (corners.size() != 3 && corners.size() != 4) {
      throw PlyError("its face " + std::to_string(face) + " has " + std::to_string(corners.size()) +
                     " corners: only 3 and 4 are possible");
    }
    std::uint32_t v[4] = {0, 0, 0, 0};
    for (std::size_t i = 0; i < corners.size(); ++i) {
      if (!(corners[i] >= 0 && corners[i] < double(vertexCount)) ||
          corners[i] != std::floor(corners[i])) {
        throw PlyError("its face " + std::to_string(face) + " names a vertex outside 0 to " +
                       std::to_string(std::int64_t(vertexCount) - 1));
      }
      v[i] = std::uint32_t(corners[i]);
    }
    mesh->indices.push_back({v[0], v[1], v[2]});
    if (corners.size() == 4) mesh->indices.push_back({v[0], v[2], v[3]});
    ++face;
  });
}

}  // namespace

std::unique_ptr<TriangleMesh> ParsePly(std::string_view bytes) {
  const PlyHeader header = ParsePlyHeader(bytes);
  NumberStream stream(bytes.substr(header.bytes), header.format);
  const PlyElement *vertices = nullptr, *faces = nullptr;
  for (const PlyElement& element : header.elements) {
    if (element.name == "vertex") vertices = &element;
    if (element.name == "face") faces = &element;
  }
  if (!vertices) throw PlyError("it has no vertices");
  if (!faces) throw PlyError("it has no faces");
  auto mesh = std::make_unique<TriangleMesh>();
  for (const PlyElement& element : header.elements) {
    if (&element == vertices) {
      ReadVertices(stream, element, mesh.get());
    } else if (&element == faces) {
      ReadFaces(stream, element, vertices->count, mesh.get());
    } else if (!element.properties.empty()) {
      ForEachRow(stream, element, -1, [](const auto&, const auto&) {});
    }
  }
  return mesh;
}

std::unique_ptr<TriangleMesh> ReadPly(const std::string& path, std::uint64_t mostBytes) {
  if (mostBytes == 0) mostBytes = std::uint64_t(std::min(UsableMemory() / 2, 0x1p33));
  Descriptor opened([&] {
    try {
      return OpenRegularFile(path);
    } catch (const InputFileError& error) {
      throw PlyError(std::string("it cannot be read: ") + error.what());
    }
  }());
  // zlib reads uncompressed files unchanged.
  const std::unique_ptr<gzFile_s, int (*)(gzFile)> file(gzdopen(opened.Release(), "rb"), gzclose);
  if (!file) throw PlyError("it cannot be opened");
  std::string bytes;
  std::vector<char> block(std::size_t(1) << 20);
  for (;;) {
    const int count = gzread(file.get(), block.data(), unsigned(block.size()));
    if (count < 0) throw PlyError("it cannot be read, or is not valid gzip data");
    if (count == 0) break;
    if (!gzdirect(file.get()) && bytes.size() + std::size_t(count) > mostBytes) {
      throw PlyError("it is longer than the limit of " + std::to_string(mostBytes >> 20) +
                     " MiB, decompressed");
    }
    bytes.append(block.data(), std::size_t(count));
  }
  int status = Z_OK;
  gzerror(file.get(), &status);
  if (status != Z_OK) throw PlyError("its compressed data end too early");
  return ParsePly(bytes);
}

}  // namespace exphoton
