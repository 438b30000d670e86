// SPDX-License-Identifier: BSD-2-Clause
// Both pictures of a law have the same seeds, so most of the noise cancels in their difference.
// Light that goes over several surfaces to a lamp is rare, and few seeds would need a large
// difference to be certain. So there are more seeds than in other comparisons, with fewer samples.
#include "tests/random/variations/layers.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/math/sampling/random.h"
#include "tests/random/variations/mirror_furnace.h"
#include "tests/random/variations/parts.h"

namespace exphoton::random_scenes {
namespace {

struct LayersMethod {
  const char* integrator;
  double margin;  // density estimates depend a little on the number of photons
};
constexpr std::array<LayersMethod, 8> kLayersMethods{{
    {R"("path" "integer maxdepth" 6)", 0},
    {R"("path" "integer maxdepth" 2)", 0},
    {R"("guidedpath" "integer maxdepth" 4)", 0},
    {R"("bidirectional" "integer maxdepth" 4)", 0},
    {R"("exphotonmap")", .05},
    {R"("exphotonmap" "bool radiancephotons" "false")", .05},
    {R"("photonmap")", .05},
    {R"("photonmap" "bool finalgather" "false")", .05},
}};
constexpr int kLayersSeeds = 16, kLayersSamples = 2;
constexpr const char* kDirectOnly = R"("directlighting" "string strategy" "all")";

const LayersMethod& LayersMethodOf(std::uint64_t seed) {
  return kLayersMethods[std::size_t(HashKey({seed, 23}) % kLayersMethods.size())];
}

// Returns a material with even colours whose diffuse and glossy lobes have coefficients as factors.
MaterialModel WithFactors(const MaterialModel& material) {
  MaterialModel even = material;
  even.isPhysical = 0;
  for (TextureModel* texture : {&even.diffuse, &even.glossy}) {
    texture->kind = TextureKind::Constant;
    for (int Colour::*channel : {&Colour::red, &Colour::green, &Colour::blue})
      texture->first.*channel = std::max(texture->first.*channel / 2 * 2, 2);
  }
  switch (material.kind) {
    case MaterialKind::Metal:
    case MaterialKind::Substrate:
    case MaterialKind::ShinyMetal:
      even.kind = MaterialKind::Plastic;
      break;
    case MaterialKind::Fitted:
    case MaterialKind::Measured:
      even.kind = MaterialKind::Matte;
      break;
    case MaterialKind::Glass:
      even.diffuse.first = even.glossy.first = {10, 10, 10};
      break;
    default:
      break;
  }
  return even;
}

void Darken(MaterialModel* material) {
  if (material->kind == MaterialKind::Glass) return;
  for (TextureModel* texture : {&material->diffuse, &material->glossy})
    for (int Colour::*channel : {&Colour::red, &Colour::green, &Colour::blue})
      texture->first.*channel /= 2;
}

// Half of the scenes get a lamp beside a mirror or glass, which make caustics.
SceneModel LayersScene(const SceneModel& drawn, std::uint64_t seed) {
  RandomStream random(HashKey({seed, 24}));
  const auto choose = [&](int count) { return int(random.Bits() % std::uint64_t(count)); };
  SceneModel scene = drawn;
  if (choose(2)) {
    BodyModel lamp, focus;
    lamp.kind = BodyKind::Sphere, lamp.size = 1;
    lamp.place = {choose(5) - 2, 2 + choose(3), choose(5) - 2};
    lamp.emission = 1, lamp.light = {9, 8, 7};
    focus.kind = choose(2) ? BodyKind::Sphere : BodyKind::Box, focus.size = choose(3);
    focus.place = {choose(7) - 3, choose(4) - 4, choose(5) - 2};
    focus.material.kind = choose(2) ? MaterialKind::Mirror : MaterialKind::Glass;
    scene.bodies = {lamp, focus};
  }
  for (MediumModel& medium : scene.media) medium.parts = 0;
  scene.walls = WithFactors(scene.walls);
  for (BodyModel& body : scene.bodies) body.material = WithFactors(body.material);
  return scene;
}

enum class Law { Equal, AtMost };

// Compares factor * a with b, whose seeds are the same.
Comparison CompareScaled(const std::vector<double>& a, double factor, Law law,
                         const std::vector<double>& b, double margin) {
  std::vector<double> differences;
  for (std::size_t k = 0; k < a.size(); ++k) differences.push_back(factor * a[k] - b[k]);
  const Sample sample = SampleOf(differences), left = SampleOf(a), right = SampleOf(b);
  const double allowed = std::max(margin, 1e-5) * std::max(factor * left.mean, right.mean);
  return {"",
          law == Law::Equal ? PValueBeyond(sample, {0, 0, kLayersSeeds}, allowed)
                            : PValueAbove(sample, allowed),
          sample.mean, TextOf(left, right)};
}

std::vector<double> SumOfLayers(const PartMeans& means) {
  std::vector<double> sum(kLayersSeeds, 0);
  for (std::size_t i = kEmission; i < kParts.size(); ++i)
    for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += means[i][k];
  return sum;
}

}  // namespace

std::vector<Comparison> CompareLayers(const SceneModel& drawn, const Effort& effort) {
  const LayersMethod& method = LayersMethodOf(effort.sceneSeed);
  const SceneModel bright = LayersScene(drawn, effort.sceneSeed);
  SceneModel dark = bright;
  Darken(&dark.walls);
  for (BodyModel& body : dark.bodies) Darken(&body.material);
  const auto means = [&](const SceneModel& scene, const char* integrator, std::uint64_t seed) {
    TextOptions options = SmallPicture(integrator, effort.factor, effort.factor);
    options.samples = kLayersSamples * effort.factor;
    return MeansOf(SceneText(scene, options), seed, kLayersSeeds);
  };
  const PartMeans a = means(dark, method.integrator, effort.firstSeed);
  const PartMeans b = means(bright, method.integrator, effort.firstSeed);
  const PartMeans direct = means(bright, kDirectOnly, effort.firstSeed + 7);
  std::vector<Comparison> comparisons;
  const auto add = [&](const char* what, Comparison comparison) {
    comparison.what = std::string("layers of ") + method.integrator + ", " + what;
    comparisons.push_back(comparison);
  };
  const double margin = method.margin;
  add("emission", CompareScaled(a[kEmission], 1, Law::Equal, b[kEmission], 0));
  add("direct", CompareScaled(a[kDirect], 2, Law::Equal, b[kDirect], 0));
  add("caustic", CompareScaled(a[kCaustic], 2, Law::Equal, b[kCaustic], margin));
  add("indirect", CompareScaled(a[kIndirect], 4, Law::AtMost, b[kIndirect], margin));
  add("specular", CompareScaled(a[kSpecular], 1, Law::AtMost, b[kSpecular], margin));
  add("sum", CompareScaled(SumOfLayers(b), 1, Law::Equal, b[kPicture], 1e-4));
  const Sample left = SampleOf(b[kDirect]), right = SampleOf(direct[kDirect]);
  add("direct without a bounce",
      {"", PValueBeyond(left, right, 0), left.mean - right.mean, TextOf(left, right)});
  for (const Comparison& each : CompareInMirrorFurnace(effort)) comparisons.push_back(each);
  return comparisons;
}

std::string LayersText(const SceneModel& scene, std::uint64_t seed) {
  return SmallSceneText(LayersScene(scene, seed), LayersMethodOf(seed).integrator, 1, 1);
}

}  // namespace exphoton::random_scenes
