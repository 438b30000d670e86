// SPDX-License-Identifier: BSD-2-Clause
// ExactRadiance estimates the error of what gather rays read from the photon maps. At a hit, it
// compares the radiance that was read with a sample of the true radiance: direct light by next
// event estimation, caustic light along rays of its own (CausticRays) or from its map, and light
// along a few rays in directions sampled from the BSDF and from the guiding distribution of nearby
// photons. These rays read the maps again, and Russian roulette decides which of their reads are
// corrected in the same way. The sum telescopes to an unbiased estimate
// (docs/decisions/0050-bias-certificate.md). Source: Misso et al. 2022, "Unbiased and consistent
// rendering using biased estimators".
#pragma once

#include "core/lights/selection/light_sampler.h"
#include "core/transport/integrator.h"
#include "integrators/photon/gather/cone_mixture.h"
#include "integrators/photon/gather/gather_ray.h"
#include "integrators/photon/gather/photon_guide.h"

namespace exphoton {

// The results of Preprocess that corrections read.
struct CorrectionSources {
  const PhotonMapSet& maps;
  const RadiancePhotonMap* radianceMap;  // null: no radiance photons
  const PhotonSettings& settings;
  const LightSampler& lights;
  const PhotonGuide& guide;
  // The guide of the caustic map. Null: caustic light is read from this map, and corrected for the
  // blur of its kernel.
  const PhotonGuide* causticGuide = nullptr;
};

class ExactRadiance final : private GatherRay::ReadCorrector {
 public:
  // All arguments must outlive this object. The context must not have the state of the pixel, which
  // the picture's own samples use.
  ExactRadiance(const CorrectionSources& sources, LiContext& context, RandomStream* random);

  // Returns an estimate of the true radiance along a gather ray minus the radiance that GatherRay
  // reads along it. light: a luminance that is typical of the rays of the gather.
  Spectrum Correction(const GatherRay::Segment& segment, Real light);

 private:
  // The rays of one hit: how many sample the BSDF, and how many the guide.
  struct Rays {
    ConeMixture guide;
    int bsdfCount = 0, guideCount = 0;

    // For MIS against light samples. Pdf returns the expected number of rays per solid angle.
    static constexpr int light = 1, bsdf = 1;
    Real Pdf(const Vector3& wi, Real bsdfPdf) const {
      const Real all = Real(bsdfCount) * bsdfPdf;
      return guideCount > 0 ? all + Real(guideCount) * guide.Pdf(wi) : all;
    }
  };

  // The corrected read that the rays of a hit belong to.
  struct Parent {
    Real count;       // expected number of corrected reads, of rays that read as much as it
    Real importance;  // of its own read
    Real share;       // of the current ray in the throughput of all rays
  };

  Spectrum Correct(const GatherRay::Segment& segment, const Spectrum& read,
                   Real throughput) override;
  // Returns the probability that a read is corrected.
  Real Survival(Real importance, Real throughput) const;
  // Returns a sample of the radiance that the mapped lobes send towards wo.
  Spectrum Sample(const ShadingPoint& point);
  Rays RaysAt(const ShadingPoint& point);
  Spectrum Direct(const ShadingPoint& point, const Rays& rays);
  Spectrum Caustic(const ShadingPoint& point);
  // The light along the rays: emission, with MIS against Direct, and what the hits reflect.
  Spectrum AlongRays(const ShadingPoint& point, const Rays& rays);
  // Draws direction number `index` of the rays; u shifts all directions of the hit.
  std::optional<BsdfSample> Draw(const ShadingPoint& point, const Rays& rays, int index,
                                 const Point2& u);

  const CorrectionSources& sources_;
  LiContext& context_;
  RandomStream* random_;
  Cone cone_;
  GatherRay gather_;
  Real light_ = 0;
  std::optional<Parent> parent_;
  int depth_ = 0;  // of the nested reads
};

}  // namespace exphoton
