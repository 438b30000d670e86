// SPDX-License-Identifier: BSD-2-Clause
// MeshEmitter samples a mesh. It chooses a triangle in proportion to its area, then a point uniform
// on it, so that the density is 1 / area everywhere. Areas and their sums are in double.
#include <algorithm>
#include <utility>

#include "core/geometry/triangle_mesh.h"
#include "core/geometry/triangle_point.h"
#include "core/geometry/vec3d.h"
#include "core/math/half_space.h"
#include "core/math/sampling/distribution.h"
#include "core/math/sampling/sampling.h"

namespace exphoton {

class MeshEmitter final : public EmitterSurface {
 public:
  explicit MeshEmitter(const TriangleMesh& mesh) : mesh_(mesh) {
    std::vector<double> areas;
    areas.reserve(mesh.TriangleCount());
    for (const auto& v : mesh.indices) {
      const Vec3d a(mesh.p[v[0]]);
      areas.push_back(Length(Cross(Vec3d(mesh.p[v[1]]) - a, Vec3d(mesh.p[v[2]]) - a)) / 2);
      for (const std::uint32_t corner : v) bounds_.Extend(mesh.p[corner]);
    }
    byArea_ = DiscreteDistribution(areas);
    area_ = Real(byArea_.Sum());
  }

  Real Area() const override { return area_; }
  Bounds3 Bounds() const override { return bounds_; }

  EmitterSample SamplePoint(Point2 u, Real uSubLight, Real) const override {
    const auto triangle = std::uint32_t(byArea_.Sample(uSubLight).index);
    const Point2 b = SampleTriangle(u);
    const SurfaceInteraction surface = TriangleSurface(mesh_, triangle, b.x, b.y);
    return {surface, surface.uv, 1 / area_};
  }

  // The normals are those of SamplePoint.
  bool MayFace(const Bounds3& box) const override {
    return std::ranges::any_of(mesh_.indices, [&](const std::array<std::uint32_t, 3>& v) {
      const Point3 &a = mesh_.p[v[0]], &b = mesh_.p[v[1]], &c = mesh_.p[v[2]];
      const Normal3 n = TrianglePoint(Vec3d(a), Vec3d(b), Vec3d(c), 0, 0).ng;
      return !LiesBehind(box, mesh_.flipNormal ? -n : n, {a, b, c});
    });
  }

 private:
  const TriangleMesh& mesh_;
  DiscreteDistribution byArea_;
  Real area_ = 0;
  Bounds3 bounds_;
};

std::unique_ptr<EmitterSurface> MakeMeshEmitter(const TriangleMesh& mesh) {
  return std::make_unique<MeshEmitter>(mesh);
}

}  // namespace exphoton
