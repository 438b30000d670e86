// SPDX-License-Identifier: BSD-2-Clause
// PhotonMapSet holds the three photon maps with their search radii, and estimates the radiance that
// a surface reflects from the stored photons (Jensen 2001, section 7.2).
#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/transport/integrator.h"
#include "core/transport/shading_point.h"
#include "integrators/photon/maps/own_photon_weight.h"
#include "integrators/photon/maps/photon_map.h"
#include "integrators/photon/photon_settings.h"
#include "integrators/photon/shooting/photon_tracer.h"

namespace exphoton {

// Sorts the photons of several maps together, which takes less time. Photons that are sorted
// already keep their order. Consumes the photons.
std::vector<PointTree<PhotonBlock>> MakePhotonTrees(std::span<PhotonBuffer> buffers,
                                                    ThreadPool& threads);

// What becomes of photons that a wall hides from the point of an estimate (hidden_photons.h).
enum class HiddenPhotons {
  LeftOut,           // as far as they outnumber the seen ones
  LeftOutInTheMean,  // over many points, with fewer rays
};

class PhotonMapSet {
 public:
  PhotonMapSet() = default;
  // Builds the maps from the buffers, which it consumes, and chooses the radii if the settings give
  // none. sceneRadius: radius of the bounding sphere of the scene. `walls` hide photons
  // (hidden_photons.h).
  PhotonMapSet(PhotonPassResult* result, const PhotonSettings& settings, Real sceneRadius,
               PreprocessContext& context, const Walls& walls = Walls());

  const PhotonMap& Map(PhotonKind kind) const { return maps_[std::size_t(kind)]; }
  const Walls& HidingWalls() const { return walls_; }
  Real MaxDistance(PhotonKind kind) const { return radii_[std::size_t(kind)]; }

  // Returns the radiance leaving the point towards wo by `lobes` (all non-specular), estimated from
  // the photons of one map: 1/N sum K f alpha (docs/theory/exphotonmap.md, eq. 12). Photons count
  // with their interpolated normals, and the estimate corrects for bumps.
  // signedRadiance receives the same with the sign of each photon (signed_power.h); null: it is not
  // wanted.
  Spectrum Radiance(PhotonKind kind, const ShadingPoint& point, Arena* arena,
                    LobeSet lobes = LobeSet::NonSpecular, Spectrum* signedRadiance = nullptr) const;
  // Sums the radiance over all three maps.
  Spectrum Radiance(const ShadingPoint& point, Arena* arena, LobeSet lobes = LobeSet::NonSpecular,
                    Spectrum* signedRadiance = nullptr,
                    HiddenPhotons hidden = HiddenPhotons::LeftOut) const;

  // Returns Radiance(kind, ...), and an estimate of the true radiance minus it, as far as the
  // kernel's blur causes the difference. The bias of a smooth illumination grows with the square of
  // the radius. The same photons within r / sqrt(2) have half the bias, so twice the difference of
  // the two estimates is minus the bias (Richardson 1911).
  struct CorrectedRadiance {
    Spectrum radiance, correction;
  };
  CorrectedRadiance Corrected(PhotonKind kind, const ShadingPoint& point, Arena* arena,
                              LobeSet lobes = LobeSet::NonSpecular,
                              Spectrum* signedRadiance = nullptr) const;

  // Returns the photons per unit area, of all three maps, that an estimate at the point would use.
  double PhotonDensity(const ShadingPoint& point, Arena* arena) const;

  // Estimates the irradiance on the side of n, summed over all three maps. A photon at p itself
  // counts with OwnPhotonWeight. isCoated and normals: as in PhotonQuery.
  struct Irradiance {
    Spectrum e;
    Spectrum signedE;           // each photon has its sign
    Real radius = 0;            // mean of the maps' radii, weighted by the luminance of each map
    bool isBesideWall = false;  // as in PhotonMap::Irradiance, of any map
  };
  Irradiance EstimateIrradiance(const Point3& p, const Normal3& n, Arena* arena,
                                bool isCoated = false, const ShadingNormals& normals = {}) const;

 private:
  // Part is the light that an estimate contains.
  struct Part {
    PhotonKind kind;
    LobeSet lobes;
    HiddenPhotons hidden = HiddenPhotons::LeftOut;
  };
  Spectrum Radiance(const Part& part, const ShadingPoint& point, Arena* arena,
                    Spectrum* signedRadiance) const;
  // Returns the photons around a point that may contribute to a part.
  PhotonNeighbourhood Around(const Part& part, const ShadingPoint& point, Arena* arena) const;
  // Returns the estimate from the photons within radius2. signedRadiance may be null.
  Spectrum Estimate(const Part& part, const ShadingPoint& point, const PhotonNeighbourhood& around,
                    Real radius2, Spectrum* signedRadiance) const;

  std::array<PhotonMap, kPhotonKindCount> maps_;
  std::array<Real, kPhotonKindCount> radii_{};
  int nUsed_ = 50;
  OwnPhotonWeight ownWeight_;
  Walls walls_;
  double diskArea_ = 1;  // as in PreprocessContext
  Real widest_ = 1;      // as in FindAt: a given radius is never exceeded
  DensityKernel kernel_ = DensityKernel::Constant;
};

}  // namespace exphoton
