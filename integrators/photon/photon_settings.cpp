// SPDX-License-Identifier: BSD-2-Clause
// This file declares the parameters that the photon integrators share.
#include "integrators/photon/photon_settings.h"

namespace exphoton {
namespace {

std::vector<RemovedParam> RemovedPhotonParameters() {
  return {{"radiancemode", "radiance photons always store exitant radiance",
           "delete it; \"bool radiancephotons\" \"false\" evaluates the surface at each hit of a "
           "gather ray instead"},
          {"shortgather", "gather rays shorter than \"shortrays\" always read density estimates",
           "delete it; \"float shortrays\" 0 lets all gather rays read radiance photons"}};
}

}  // namespace

const ParamTable<PhotonSettings>& PhotonParameters() {
  using S = PhotonSettings;
  static const ParamTable<S> table{
      RemovedPhotonParameters(),
      Param("causticphotons", &S::causticPhotons,
            "photons wanted in the caustic map; if absent, 20000, or fewer where emission is "
            "guided and caustics carry little light")
          .Basic()
          .Range(0, 1e9)
          .DividedByQuick(10),
      Param("directphotons", &S::directPhotons,
            "photons wanted in the direct map; if absent, as indirectphotons, or 100000 if those "
            "are 0")
          .Range(0, 1e9)
          .DividedByQuick(10),
      Param("indirectphotons", &S::indirectPhotons,
            "photons wanted in the indirect map; fewer where emission is guided and little of the "
            "light is indirect")
          .Basic()
          .Range(0, 1e9)
          .DividedByQuick(10),
      Param("nused", &S::nUsed, "photons used in a density estimate")
          .Basic()
          .Range(2, 100000)
          .DividedByQuick(10),
      Param(
          "directlights", &S::directLights,
          "lights of a scene that are all sampled at each point; where there are more, this number "
          "of lights is chosen by power, distance and cosine; if absent, 64, and 16 are chosen")
          .Range(1, 1 << 20),
      Param("maxdepth", &S::maxDepth, "specular bounces followed").Basic().Range(0, 1000),
      Param("maxspeculardepth", &S::maxDepth, "version 2's name of maxdepth").Range(0, 1000),
      Param("finalgather", &S::finalGather,
            "gather indirect light over the hemisphere; false shows the maps directly"),
      Param("finalgathersamples", &S::finalGatherSamples,
            "gather rays at a shading point, both techniques together")
          .Basic()
          .Range(1, 1 << 20)
          .DividedByQuick(4),
      Param("sharedgather", &S::sharedGather,
            "diffuse gathered light is shared between neighbouring pixels on one surface"),
      Param("edgesamples", &S::edgeSamples,
            "camera samples for one where a pixel shows more than one surface; each has this "
            "fraction of the gather rays, but at least 2; 1: no more than elsewhere")
          .Range(1, 64),
      Param("maxdist", &S::maxDist,
            "largest radius of a density estimate; chosen from the photons if absent")
          .Range(1e-15, 1e15)
          .Unit("scene units"),
      Param("rrthreshold", &S::rrThreshold,
            "gather rays with a contribution below this end by Russian roulette; 0: none does")
          .Range(0, 1e6),
      Param("gatherangle", &S::gatherAngle, "half-angle of the cone round a photon's direction")
          .Above(0)
          .AtMost(90)
          .Unit("degrees"),
      Param("gatherphotons", &S::gatherPhotons, "photons whose directions guide a gather")
          .Range(1, 10000),
      Param("lightselection", &S::lightSelection, "how a photon's light is chosen")
          .OneOf({{"power", LightSelection::Power}, {"uniform", LightSelection::Uniform}}),
      Param("photonroulette", &S::photonRoulette, "how photon paths end")
          .OneOf({{"luminance", PhotonRoulette::Luminance},
                  {"constant", PhotonRoulette::Constant},
                  {"half", PhotonRoulette::Half},
                  {"maxcomponent", PhotonRoulette::MaxComponent}}),
      Param("radiancephotons", &S::radiancePhotons,
            "gather rays read precomputed radiance instead of three density estimates"),
      Param(
          "hidephotons", &S::hidePhotons,
          "photons that a wall hides from a point count there no more than the seen ones; without "
          "effect where shapes move"),
      Param(
          "gathersampling", &S::gatherSampling,
          "where gather rays go: up to half of them in cones round photons' directions (photons), "
          "half by a histogram (jensen) or footprints (hey) of photons, or all by the BSDF")
          .OneOf({{"photons", GatherSampling::Photons},
                  {"bsdf", GatherSampling::Bsdf},
                  {"jensen", GatherSampling::Jensen},
                  {"hey", GatherSampling::Hey}}),
      Param("kernel", &S::kernel, "weight of a photon by its distance where maps are seen directly")
          .OneOf({{"simpson", DensityKernel::Simpson}, {"constant", DensityKernel::Constant}}),
      Param("radiancefraction", &S::radianceFraction,
            "share of the stored photons at which radiance is computed")
          .Range(0, 1),
      Param("radiancereach", &S::radianceReach,
            "a radiance photon is valid for hits within this many radii of its density estimate")
          .Range(0, 1000),
      Param("radiancenormal", &S::radianceNormal,
            "a radiance photon is valid for hits whose normals have at least this cosine with its "
            "own")
          .Range(-1, 1),
      Param("shortrays", &S::shortRays,
            "gather rays shorter than this many radii do not read a radiance photon; 0: all do")
          .Range(0, 1000),
      Param("maxphotondepth", &S::maxPhotonDepth, "bounces after which a photon path is cut")
          .Range(1, 1 << 20),
      Param("maxphotonpaths", &S::maxPhotonPaths, "paths after which a map stays as it is")
          .Range(1, 1e15),
      Param("photonaim", &S::photonTargeting,
            "photons of distant lights (sun, sky) start towards visible points; auto: where that "
            "makes them many times denser there")
          .OneOf({{"auto", PhotonTargeting::Auto},
                  {"on", PhotonTargeting::On},
                  {"off", PhotonTargeting::Off}}),
      Param("guideemission", &S::guideEmission,
            "photons start where earlier ones reached the caustic or the indirect map, if few do"),
      Param("show", &S::show, "shows one map directly, for inspection")
          .OneOf({{"", ShowMap::Nothing},
                  {"radiancephotons", ShowMap::Radiance},
                  {"directphotons", ShowMap::Direct},
                  {"causticphotons", ShowMap::Caustic},
                  {"indirectphotons", ShowMap::Indirect}})};
  return table;
}

}  // namespace exphoton
