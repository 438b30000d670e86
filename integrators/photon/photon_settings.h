// SPDX-License-Identifier: BSD-2-Clause
// PhotonSettings: the parameters that photonmap and exphotonmap share, declared once. The defaults
// are those of photonmap; exphotonmap.cpp switches its improvements on.
#pragma once

#include <cstdint>
#include <optional>

#include "core/lights/selection/light_selection.h"
#include "core/params/param_table.h"

namespace exphoton {

enum class PhotonRoulette {
  Luminance,     // survivors have the luminance from before the bounce
  MaxComponent,  // survivors have the largest channel from before the bounce
  Constant,      // rejection sampling; all photons have the same luminance
  Half,          // survival probability 1/2 after three bounces; weights vary
};
enum class GatherSampling {
  Photons,  // cones about the directions from which light is dense
  Jensen,   // a histogram of all photons (Jensen 1995)
  Hey,      // footprints of all photons (Hey and Purgathofer 2002)
  Bsdf,
};
enum class DensityKernel { Constant, Simpson };
enum class PhotonTargeting {
  Auto,  // on if photons become at least four times denser at visible points
  On,
  Off,
};
enum class ShowMap { Nothing, Radiance, Direct, Caustic, Indirect };

struct PhotonSettings {
  static constexpr std::int64_t kUsualPhotons = 100000;
  std::optional<std::int64_t> causticPhotons;  // absent: at most 20000
  std::optional<std::int64_t> directPhotons;   // absent: DirectPhotons() chooses
  std::int64_t indirectPhotons = kUsualPhotons;
  int nUsed = 50;
  std::optional<int> directLights;  // absent: see DirectLighting
  int maxDepth = 5;
  bool finalGather = true;
  int finalGatherSamples = 32;
  std::optional<Real> maxDist;  // absent: chosen from the photon density
  Real rrThreshold = 0;
  Real gatherAngle = 10;  // degrees
  int gatherPhotons = 50;

  LightSelection lightSelection = LightSelection::Uniform;
  PhotonRoulette photonRoulette = PhotonRoulette::Half;
  bool radiancePhotons = false;
  bool hidePhotons = false;
  GatherSampling gatherSampling = GatherSampling::Bsdf;
  DensityKernel kernel = DensityKernel::Constant;

  Real radianceFraction = Real(.125);
  Real radianceReach = 1;
  Real radianceNormal = Real(.7);
  Real shortRays = Real(.3);
  int maxPhotonDepth = 1024;
  std::int64_t maxPhotonPaths = std::int64_t(1) << 24;
  PhotonTargeting photonTargeting = PhotonTargeting::Off;
  ShowMap show = ShowMap::Nothing;
  bool sharedGather = false;
  int edgeSamples = 1;
  bool guideEmission = false;
  bool directWithPhotons = false;  // direct light from the direct map; a parameter of photonmap

  std::int64_t CausticPhotons() const { return causticPhotons.value_or(20000); }
  // Without indirect photons, gather rays still read direct light.
  std::int64_t DirectPhotons() const {
    return directPhotons.value_or(indirectPhotons > 0 ? indirectPhotons : kUsualPhotons);
  }
};

const ParamTable<PhotonSettings>& PhotonParameters();

}  // namespace exphoton
