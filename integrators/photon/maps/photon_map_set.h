// SPDX-License-Identifier: BSD-2-Clause
// PhotonMapSet: the three maps with their search radii, and the radiance that a surface reflects of
// what they hold. Jensen 2001, section 7.2.
#pragma once

#include <array>

#include "core/transport/integrator.h"
#include "core/transport/shading_point.h"
#include "integrators/photon/maps/photon_map.h"
#include "integrators/photon/photon_settings.h"
#include "integrators/photon/shooting/photon_tracer.h"

namespace exphoton {

class PhotonMapSet {
 public:
  PhotonMapSet() = default;
  // Builds the maps from the buffers, which it takes, and chooses the radii where the settings give
  // none. sceneRadius: of the sphere round the scene.
  PhotonMapSet(PhotonPassResult* result, const PhotonSettings& settings, Real sceneRadius,
               PreprocessContext& context);

  const PhotonMap& Map(PhotonKind kind) const { return maps_[std::size_t(kind)]; }
  Real MaxDistance(PhotonKind kind) const { return radii_[std::size_t(kind)]; }

  // Radiance leaving the point towards wo by `lobes`, all non-specular, of one map's photons:
  // 1/N sum K f alpha (docs/theory/exphotonmap.md, eq. 12), with the shading normal's correction, since
  // photons measure power per geometric area.
  Spectrum Radiance(PhotonKind kind, const ShadingPoint& point, Arena* arena,
                    LobeSet lobes = LobeSet::NonSpecular) const;
  // The same of all three maps.
  Spectrum Radiance(const ShadingPoint& point, Arena* arena,
                    LobeSet lobes = LobeSet::NonSpecular) const;

  // Photons of all three maps per unit of area that an estimate at the point would use.
  double PhotonDensity(const ShadingPoint& point, Arena* arena) const;

  // Irradiance on the side of n, of all three maps; the radius is the mean of the maps' radii,
  // weighted by what each contributed.
  PhotonMap::Irradiance EstimateIrradiance(const Point3& p, const Normal3& n, Arena* arena,
                                           bool isCoated = false) const;

 private:
  std::array<PhotonMap, kPhotonKindCount> maps_;
  std::array<Real, kPhotonKindCount> radii_{};
  int nUsed_ = 50;
  DensityKernel kernel_ = DensityKernel::Constant;
};

}  // namespace exphoton
