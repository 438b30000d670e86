// SPDX-License-Identifier: BSD-2-Clause
// FinishMesh moves meshes to world space and checks them. The other functions check parameters and
// sizes.
#include "shapes/mesh/finish_mesh.h"

#include "core/base/log.h"
#include "core/base/memory.h"
#include "core/geometry/vec3d.h"
#include "core/params/param_table.h"
#include "core/scattering/texture.h"

namespace exphoton {
namespace {

void MoveToWorld(const ShapeContext& context, const std::string& positionParam,
                 TriangleMesh* mesh) {
  for (Point3& p : mesh->p) {
    p = context.objectToWorld.ApplyPoint(p);
    if (!IsFinite(p))
      throw ParamError{positionParam, "has a point that the transformation takes to infinity", ""};
  }
  for (Normal3& n : mesh->n) n = NormalizeOr(context.objectToWorld.ApplyNormal(n), Normal3());
  for (Vector3& s : mesh->s) s = NormalizeOr(context.objectToWorld.ApplyVector(s), Vector3());
  mesh->flipNormal = context.FlipsNormal();
}

// Counts the triangles with unusable vertex normals: one is 0, or they cancel.
std::size_t CountUselessNormals(const TriangleMesh& mesh) {
  std::size_t count = 0;
  for (const auto& v : mesh.indices) {
    const Vec3d a(mesh.n[v[0]]), b(mesh.n[v[1]]), c(mesh.n[v[2]]);
    const bool hasZero = Dot(a, a) == 0 || Dot(b, b) == 0 || Dot(c, c) == 0;
    if (hasZero || Length(a + b + c) < 1e-6) ++count;
  }
  return count;
}

std::size_t CountUselessTangents(const TriangleMesh& mesh) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < mesh.s.size(); ++i) {
    const bool isAlongNormal =
        !mesh.n.empty() && Length(Cross(Vec3d(mesh.s[i]), Vec3d(mesh.n[i]))) < 1e-6;
    if (mesh.s[i] == Vector3() || isAlongNormal) ++count;
  }
  return count;
}

void SetAlpha(const std::shared_ptr<const Texture<Real>>& alpha, const ShapeContext& context,
              TriangleMesh* mesh) {
  const std::optional<Real> constant = alpha->ConstantValue();
  if (!constant) {
    mesh->alpha = alpha;
  } else if (*constant == 0 && mesh->TriangleCount() > 0) {
    context.log.Warning("the mesh is invisible, because its alpha is 0", context.where);
    mesh->indices.clear();
  }
}

}  // namespace

std::vector<std::array<std::uint32_t, 3>> CheckedTriangles(const std::vector<int>& indices,
                                                           std::size_t vertexCount,
                                                           const std::string& param) {
  if (indices.size() % 3 != 0) {
    throw ParamError{
        param, "needs three numbers a triangle, but has " + std::to_string(indices.size()), ""};
  }
  std::vector<std::array<std::uint32_t, 3>> triangles(indices.size() / 3);
  for (std::size_t i = 0; i < indices.size(); ++i) {
    if (indices[i] < 0 || std::size_t(indices[i]) >= vertexCount) {
      throw ParamError{param,
                       "has " + std::to_string(indices[i]) + " as number " + std::to_string(i + 1) +
                           ", but vertices are numbered 0 to " +
                           std::to_string(std::ptrdiff_t(vertexCount) - 1),
                       ""};
    }
    triangles[i / 3][i % 3] = std::uint32_t(indices[i]);
  }
  return triangles;
}

void CheckTriangleCount(double count, const std::string& param) {
  constexpr double kMost = 1 << 27;
  if (count <= kMost) return;
  throw ParamError{param, "would make " + std::to_string(std::int64_t(count)) + " triangles",
                   "at most " + std::to_string(std::int64_t(kMost))};
}

void CheckMemory(double bytes, const std::string& subject, const std::string& hint,
                 const SourceLocation& where) {
  if (bytes <= UsableMemory()) return;
  throw Error(ExitStatus::Resource,
              subject + " needs about " + Megabytes(bytes) + ", and " + MemoryLimit(), where, hint);
}

std::unique_ptr<ShapeGeometry> FinishMesh(std::unique_ptr<TriangleMesh> mesh,
                                          const ShapeContext& context,
                                          const std::string& positionParam,
                                          const std::shared_ptr<const Texture<Real>>& alpha) {
  MoveToWorld(context, positionParam, mesh.get());
  const std::size_t total = mesh->TriangleCount(), dropped = mesh->DropDegenerate();
  if (total == 0) {
    context.log.Warning("the mesh has no triangles", context.where);
  } else if (dropped > 0) {
    context.log.Warning(std::to_string(dropped) + " of " + std::to_string(total) +
                            " triangles have no area and are left out",
                        context.where);
  }
  if (alpha) SetAlpha(alpha, context, mesh.get());
  const std::size_t normals = mesh->n.empty() ? 0 : CountUselessNormals(*mesh);
  const std::size_t tangents = CountUselessTangents(*mesh);
  if (normals + tangents > 0) {
    context.log.Warning(
        "the mesh has " + std::to_string(normals) + " triangles whose vertex normals are 0 or " +
            "cancel and " + std::to_string(tangents) +
            " tangents that are 0 or along the normal: plain geometry is used there",
        context.where);
  }
  return std::make_unique<ShapeGeometry>(std::move(mesh));
}

}  // namespace exphoton
