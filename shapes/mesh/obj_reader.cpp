// SPDX-License-Identifier: BSD-2-Clause
// ParseObj: tinyobjloader parses checked lines and cuts polygons into triangles. Here, corners with
// equal numbers become one vertex.
#define TINYOBJLOADER_IMPLEMENTATION
#include <tiny_obj_loader.h>

#include <fstream>
#include <iterator>
#include <sstream>
#include <unordered_map>

#include "core/files/input_file.h"
#include "shapes/mesh/obj_lines.h"
#include "shapes/mesh/obj_reader.h"

namespace exphoton {
namespace {

struct CornerHash {
  std::size_t operator()(const std::array<int, 3>& corner) const {
    std::uint64_t hash = 0;
    for (const int index : corner)
      hash = (hash ^ std::uint32_t(index)) * 0x9e3779b97f4a7c15u, hash ^= hash >> 29;
    return std::size_t(hash);
  }
};

class ObjMeshBuilder {
 public:
  explicit ObjMeshBuilder(const tinyobj::attrib_t& lists) : lists_(lists) {}

  void AddTriangle(const tinyobj::index_t* corners) {
    std::array<std::uint32_t, 3> triangle;
    for (std::size_t i = 0; i < 3; ++i) triangle[i] = VertexOf(corners[i]);
    mesh_->indices.push_back(triangle);
  }

  // Leaves out lists that no corner names.
  std::unique_ptr<TriangleMesh> Take() {
    if (!hasUv_) mesh_->uv.clear();
    if (!hasNormals_) mesh_->n.clear();
    return std::move(mesh_);
  }

 private:
  Vec3 At(const std::vector<float>& values, int index) const {
    const float* v = values.data() + 3 * std::size_t(index);
    return {Real(v[0]), Real(v[1]), Real(v[2])};
  }

  std::uint32_t VertexOf(const tinyobj::index_t& corner) {
    const std::array key{corner.vertex_index, corner.texcoord_index, corner.normal_index};
    const auto [found, isNew] = vertices_.try_emplace(key, std::uint32_t(mesh_->p.size()));
    if (!isNew) return found->second;
    mesh_->p.push_back(At(lists_.vertices, key[0]));
    mesh_->n.push_back(key[2] < 0 ? Normal3() : At(lists_.normals, key[2]));
    Point2 uv;
    if (key[1] >= 0) {
      const float* t = lists_.texcoords.data() + 2 * std::size_t(key[1]);
      uv = {Real(t[0]), 1 - Real(t[1])};
    }
    mesh_->uv.push_back(uv);
    hasUv_ |= key[1] >= 0;
    hasNormals_ |= key[2] >= 0;
    return found->second;
  }

  const tinyobj::attrib_t& lists_;
  std::unique_ptr<TriangleMesh> mesh_ = std::make_unique<TriangleMesh>();
  std::unordered_map<std::array<int, 3>, std::uint32_t, CornerHash> vertices_;
  bool hasUv_ = false, hasNormals_ = false;
};

}  // namespace

ObjMesh ParseObj(std::string_view bytes, const std::string& group) {
  ObjLines lines = CheckObjLines(bytes, group);
  tinyobj::attrib_t lists;
  std::vector<tinyobj::shape_t> shapes;
  std::vector<tinyobj::material_t> materials;
  std::string warning, error;
  std::istringstream text(std::move(lines.text));
  if (!tinyobj::LoadObj(&lists, &shapes, &materials, &warning, &error, &text, nullptr, true, false))
    throw ObjError("it cannot be parsed: " + error);
  ObjMeshBuilder builder(lists);
  for (const tinyobj::shape_t& shape : shapes) {
    const auto& corners = shape.mesh.indices;
    for (std::size_t i = 0; i + 2 < corners.size(); i += 3) builder.AddTriangle(&corners[i]);
  }
  return {builder.Take(), lines.namesMaterials};
}

ObjMesh ReadObj(const std::string& path, const std::string& group) {
  try {
    RequireRegularFile(path);
  } catch (const InputFileError& error) {
    throw ObjError(error.what());
  }
  std::ifstream file(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  if (!file) throw ObjError("it cannot be read");
  return ParseObj(bytes, group);
}

}  // namespace exphoton
