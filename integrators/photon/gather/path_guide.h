// SPDX-License-Identifier: BSD-2-Clause
// PathGuide is the scattering policy of guided path tracing. At a vertex, one direction is sampled
// from the BSDF and one from the guiding distribution of nearby photons. The photons also decide
// how likely each of the two continues the path (docs/theory/other-integrators.md). No photon
// adds radiance: every direction that the BSDF samples keeps a positive density, so the estimate is
// unbiased for any photons.
#pragma once

#include "core/transport/path/path_tracer.h"
#include "integrators/photon/gather/cone_mixture.h"
#include "integrators/photon/gather/photon_guide.h"

namespace exphoton {

// GuidedVertex samples the directions at one vertex of a path.
class GuidedVertex {
 public:
  // Plain path tracing: always one direction of the BSDF.
  explicit GuidedVertex(const ShadingPoint& point) : point_(point) {}
  // Samples the BSDF with probability bsdfCount > 0, and the guide with probability guideCount.
  GuidedVertex(const ShadingPoint& point, Real bsdfCount, const ConeMixture& guide, Real guideCount)
      : point_(point),
        guide_(guide),
        bsdfCount_(bsdfCount),
        guideCount_(guideCount),
        isRouletted_(true) {}

  std::optional<PathDirection> Sample(const PathVertexVariates& u, LobeSet lobes) const;
  std::optional<PathDirection> SampleBranch(const PathVertexVariates& u, LobeSet lobes) const;
  // Returns the expected number of sampled directions per solid angle, given the density of the
  // BSDF. Both techniques divide by it (Veach 1997, section 9.2: the balance heuristic).
  Real Pdf(const Vector3& wi, Real bsdfPdf) const {
    const Real bsdf = bsdfCount_ * bsdfPdf;
    return guideCount_ > 0 ? bsdf + guideCount_ * guide_.Pdf(wi) : bsdf;
  }

 private:
  const ShadingPoint& point_;
  ConeMixture guide_;
  Real bsdfCount_ = 1, guideCount_ = 0;  // expected numbers of directions
  bool isRouletted_ = false;
};

class PathGuide {
 public:
  using Vertex = GuidedVertex;
  static constexpr std::size_t kMaxBranches = 16;

  PathGuide(int count, const Cone& cone) : cone_(cone), photons_(count, cone) {}

  // Guides by these photons from now on. The map must outlive the pass.
  void Prepare(const PhotonMap& map) { photons_.Prepare(map); }
  // Switches guiding off.
  void Clear() { photons_.Clear(); }

  GuidedVertex At(const ShadingPoint& point, bool maySplit, PathWeight* weight,
                  LiContext& context) const;

 private:
  Cone cone_;
  PhotonGuide photons_;
};

}  // namespace exphoton
