// SPDX-License-Identifier: BSD-2-Clause
// CutOutTriangle is a triangle of a mesh with an alpha texture, as a Shape of its own. Where alpha
// is 0, rays of all kinds pass. Meshes without alpha stay flat arrays and do not pay for the test.
#pragma once

#include <cstdint>
#include <memory>

#include "core/geometry/shape.h"
#include "core/geometry/triangle_mesh.h"

namespace exphoton {

class CutOutTriangle final : public Shape {
 public:
  // `mesh` has an alpha texture.
  CutOutTriangle(std::shared_ptr<const TriangleMesh> mesh, std::uint32_t index)
      : mesh_(std::move(mesh)), index_(index) {}

  // Area, SamplePoint and EmitterProblem belong to the whole triangle. An area light cannot be cut
  // out, so they are not used.
  Real Area() const override;
  const char* EmitterProblem() const override { return "A cut-out triangle does not emit."; }
  EmitterSample SamplePoint(Point2 u, Real uSubLight, Real time) const override;
  Bounds3 Bounds() const override;

  std::optional<ShapeHit> Intersect(const Ray& ray) const override;
  SurfaceInteraction Surface(const Ray& ray, const ShapeHit& hit) const override;

 private:
  const Point3& Corner(std::size_t i) const { return mesh_->p[mesh_->indices[index_][i]]; }

  std::shared_ptr<const TriangleMesh> mesh_;
  std::uint32_t index_;
};

}  // namespace exphoton
