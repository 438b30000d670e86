// SPDX-License-Identifier: BSD-2-Clause
// IntegratorComparison compares the integrators, and CompareWithEnergy tests the bound on energy.
//
// The comparison of integrators changes the scene to leave out:
// - delta lights with specular surfaces: path tracing cannot find their caustics;
// - moving shapes: a photon map has only the mean of the light over the shutter interval;
// - bumps and interpolated normals: radiance photons see the surface as smooth;
// - open rooms, distant and infinite lights, and open shapes: density estimates near the edge of a
//   sheet find photons of its other side, and too few beyond its edge;
// - rough matte surfaces: radiance photons assume Lambert's law;
// - emitters that shine into their closed body, and pictures far darker than the emitters: hardly
//   any light should leave a closed body, but photons leak through its edges.
// These are the biases of docs/theory/exphotonmap.md, section 6, that have no bound. The remaining
// bias is the blur of photon maps. The margins below allow for it. Larger blur is recognised
// because it falls with more photons (run.h).
//
// Density estimates through a lobe of roughness .02 are not compared: rare photons near the mirror
// direction weigh hundreds of times the mean, so most means of six seeds are far too small, and
// t-tests take that for a difference.
//
// The bound on energy holds in a furnace (TextOptions::isFurnace). Each surface emits at most
// 1 - a, where a is a bound on its albedo, and the sky emits 1. If no radiance exceeds M, no
// radiance that leaves a surface exceeds (1 - a) + a M, so M <= 1. Media absorb, and scatter no
// more than they absorb. Inside glass, radiance may be larger by the squared index, so the camera
// must be outside.
#include "tests/random/scenes/agreement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>

#include "tests/random/scenes/scene_text.h"
#include "tests/random/scenes/statistics.h"
#include "tests/support/test_scene.h"

namespace exphoton::random_scenes {
namespace {

constexpr int kSeeds = 6;
constexpr double kPictureMargin = .02, kBlockMargin = .05, kEnergyMargin = .01;
// These margins are for exphotonmap against itself without radiance photons, with the same photons.
constexpr double kPairPictureMargin = .01, kPairBlockMargin = .03;
constexpr int kBlocks = 2;  // along each axis
// Pictures with a lower mean radiance are not compared; emitters have .2 to 3.6.
constexpr double kDark = .005;

constexpr int kBrushedMetal = 1;  // MaterialModel::Fit

struct Method {
  const char* integrator;
  int samples;
  int gatherRays;
  std::uint64_t seed;  // added to the comparison's seed
};
constexpr Method kPath{"\"path\" \"integer maxdepth\" 60", 32, 1, 0};
constexpr Method kGuidedPath{"\"guidedpath\" \"integer maxdepth\" 60", 16, 1, 3};
constexpr Method kBidirectional{"\"bidirectional\" \"integer maxdepth\" 60", 12, 1, 4};
constexpr Method kPhotonMap{
    "\"photonmap\" \"integer maxdepth\" 24 \"string lightselection\" \"power\"", 4, 4, 2};
constexpr Method kDensityEstimates{
    "\"exphotonmap\" \"integer maxdepth\" 24 \"bool radiancephotons\" \"false\"", 4, 8, 1};
constexpr Method kExPhotonMap{"\"exphotonmap\" \"integer maxdepth\" 24", 4, 8, 1};

bool IsSpecular(const MaterialModel& m) {
  return m.kind == MaterialKind::Mirror || m.kind == MaterialKind::Glass ||
         m.kind == MaterialKind::ShinyMetal || m.kind == MaterialKind::Uber ||
         m.kind == MaterialKind::Mix;
}

bool HasMaterial(const SceneModel& scene, bool (*is)(const MaterialModel&)) {
  return (scene.room != RoomKind::None && is(scene.walls)) ||
         std::any_of(scene.bodies.begin(), scene.bodies.end(),
                     [&](const BodyModel& body) { return is(body.material); });
}

// Whether a glossy lobe has the roughness .02, or is nearly as narrow as those of fitted materials.
bool HasNarrowLobe(const SceneModel& scene) {
  return HasMaterial(scene, [](const MaterialModel& m) {
    if (m.kind == MaterialKind::Fitted || m.kind == MaterialKind::Measured) return true;
    return m.kind != MaterialKind::Matte && m.kind != MaterialKind::Mix && m.roughness == 2;
  });
}

TextOptions OptionsOf(const Method& method, const Effort& effort) {
  const int photonFactor = effort.factor * effort.photonFactor;
  TextOptions options;
  options.integrator = method.integrator;
  options.samples = method.samples * effort.factor;
  options.gatherRays = method.gatherRays;
  options.photons = 4000 * photonFactor;
  options.maxPhotonPaths = 100000 * photonFactor;
  return options;
}

// Means holds means over the channels; luminance is not needed. [0] is the picture, the blocks
// follow, and then the light AOVs if they are compared.
using Means = std::vector<std::vector<double>>;
constexpr std::size_t kFirstAov = 1 + kBlocks * kBlocks;
const std::array<std::pair<Aov, const char*>, 4> kComparedAovs{{{Aov::Direct, "direct"},
                                                                {Aov::Caustic, "caustic"},
                                                                {Aov::Indirect, "indirect"},
                                                                {Aov::Specular, "specular"}}};

double MeanOfAov(const Image& image, const std::string& name) {
  double sum = 0;
  for (const char* channel : {".R", ".G", ".B"}) sum += MeanChannel(image, name + channel);
  return sum / 3;
}

void SubtractEmission(Image* image) {
  for (const char* name : {"R", "G", "B"}) {
    const int color = image->FindChannel(name);
    const int emission = image->FindChannel(std::string("emission.") + name);
    for (int y = 0; y < image->Height(); ++y)
      for (int x = 0; x < image->Width(); ++x) image->At(x, y, color) -= image->At(x, y, emission);
  }
}

// Emission that the camera sees directly would hide errors of other light; hidesLamps subtracts it.
Means MeansOfSeeds(const std::string& text, std::uint64_t firstSeed, bool hidesLamps,
                   bool withAovs = false) {
  Means means(kFirstAov + (withAovs ? kComparedAovs.size() : 0));
  const int width = kFilmWidth / kBlocks, height = kFilmHeight / kBlocks;
  for (int k = 0; k < kSeeds; ++k) {
    TestRenderOptions options;
    options.seed = firstSeed + std::uint64_t(k) * 1000;
    // The integrators take different numbers of samples. A texture that is filtered over different
    // footprints would be another texture: light that passes two walls of filtered opacity is the
    // product of two means.
    options.footprintSamples = 1 << 20;
    if (hidesLamps) options.aovs.Add(Aov::Emission);
    for (std::size_t i = kFirstAov; i < means.size(); ++i)
      options.aovs.Add(kComparedAovs[i - kFirstAov].first);
    Image image = RenderSceneText(text, options).image;
    for (std::size_t i = kFirstAov; i < means.size(); ++i)
      means[i].push_back(MeanOfAov(image, kComparedAovs[i - kFirstAov].second));
    if (hidesLamps) SubtractEmission(&image);
    means[0].push_back(MeanRadiance(image));
    for (int b = 0; b < kBlocks * kBlocks; ++b) {
      const int x = b % kBlocks * width, y = b / kBlocks * height;
      means[std::size_t(b + 1)].push_back(MeanRadiance(image, {x, y, x + width, y + height}));
    }
  }
  return means;
}

std::string PartName(std::size_t i) {
  if (i == 0) return ", picture";
  if (i < kFirstAov) return ", block " + std::to_string(i);
  return std::string(", AOV ") + kComparedAovs[i - kFirstAov].second;
}

std::string Describe(const Sample& a, const Sample& b) {
  char text[120];
  std::snprintf(text, sizeof text, "%.5g +- %.2g against %.5g +- %.2g (%+.1f %%)", a.mean,
                std::sqrt(a.variance), b.mean, std::sqrt(b.variance), 100 * (a.mean / b.mean - 1));
  return text;
}

void CompareMeans(const std::string& what, const Means& a, const Means& b,
                  std::vector<Comparison>* comparisons) {
  const double whole = SampleOf(b[0]).mean;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    const Sample left = SampleOf(a[i]), right = SampleOf(b[i]);
    // The scale of a dark block is a part of the picture's mean, as its errors are hardly visible.
    const double scale = std::max({left.mean, right.mean, i == 0 ? 0 : .5 * whole});
    const double margin = (i == 0 ? kPictureMargin : kBlockMargin) * scale;
    comparisons->push_back({what + PartName(i), PValueBeyond(left, right, margin),
                            left.mean - right.mean, Describe(left, right)});
  }
}

// Neither method is biased, so there is no margin. A block need not be compared with the picture.
void CompareUnbiased(const std::string& what, const Means& a, const Means& b,
                     std::vector<Comparison>* comparisons) {
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    const Sample left = SampleOf(a[i]), right = SampleOf(b[i]);
    comparisons->push_back({what + PartName(i), PValueBeyond(left, right, 0),
                            left.mean - right.mean, Describe(left, right)});
  }
}

// The same seeds give the same photons and gather rays, so differences of pairs have less noise
// than differences of means.
void ComparePairs(const std::string& what, const Means& a, const Means& b,
                  std::vector<Comparison>* comparisons) {
  const double whole = SampleOf(b[0]).mean;
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::vector<double> differences;
    for (std::size_t k = 0; k < a[i].size(); ++k) differences.push_back(a[i][k] - b[i][k]);
    const Sample left = SampleOf(a[i]), right = SampleOf(b[i]), pairs = SampleOf(differences);
    const double scale = std::max({left.mean, right.mean, i == 0 ? 0 : .5 * whole});
    const double margin = (i == 0 ? kPairPictureMargin : kPairBlockMargin) * scale;
    comparisons->push_back({what + PartName(i), PValueBeyond(pairs, {0, 0, pairs.count}, margin),
                            pairs.mean, Describe(left, right)});
  }
}

double Length(const Place& place, double x, double y, double z) {
  return std::hypot(.3 * place.x - x, .3 * place.y - y, .3 * place.z - z);
}

// Returns whether the camera may be inside a body.
bool IsCameraInside(const SceneModel& scene) {
  constexpr std::array<std::array<double, 3>, 3> kCameras{
      {{.1, .2, -1.9}, {.1, .2, -.1}, {-1.5, -.1, -1.2}}};
  const auto& c = kCameras[std::size_t(scene.camera.place)];
  return std::any_of(scene.bodies.begin(), scene.bodies.end(), [&](const BodyModel& body) {
    return body.isInstance == 2 || body.motion != 0 ||
           Length(body.place, c[0], c[1], c[2]) < 1.8;  // the largest half-diagonal
  });
}

}  // namespace

SceneModel WithoutKnownDifferences(const SceneModel& scene) {
  SceneModel same = scene;
  const bool isRound = same.room == RoomKind::Sphere || same.room == RoomKind::None;
  same.room = isRound ? RoomKind::Sphere : RoomKind::Box;
  same.camera.shutter = 0;
  std::erase_if(same.lights,
                [](const LightModel& light) { return light.kind >= LightKind::Distant; });
  // A scene with both delta lights and specular materials keeps only one of them, by turns.
  const bool keepsLights = !same.lights.empty() && same.integrator % 2 == 0;
  const auto simplify = [&](MaterialModel* material) {
    material->bump = 0;
    if (keepsLights && IsSpecular(*material)) material->kind = MaterialKind::Plastic;
    if (material->kind == MaterialKind::Matte) material->roughness = 0;
  };
  simplify(&same.walls);
  for (BodyModel& body : same.bodies) {
    if (body.kind != BodyKind::Sphere) body.kind = BodyKind::Box;
    body.motion = 0;
    if (body.emission != 0) body.reverse = 0;
    simplify(&body.material);
  }
  if (HasMaterial(same, IsSpecular)) same.lights.clear();
  return same;
}

struct IntegratorComparison::Rendered {
  SceneModel scene;
  Effort effort;
  std::map<const Method*, Means> means;

  const Means& Of(const Method& method) {
    const auto [at, isNew] = means.try_emplace(&method);
    if (isNew)
      at->second = MeansOfSeeds(SceneText(scene, OptionsOf(method, effort)),
                                effort.firstSeed + method.seed, true, effort.comparesMore);
    return at->second;
  }
};

IntegratorComparison::IntegratorComparison(const SceneModel& scene, const Effort& effort)
    : rendered_(new Rendered{WithoutKnownDifferences(scene), effort, {}}) {}
IntegratorComparison::IntegratorComparison(IntegratorComparison&&) noexcept = default;
IntegratorComparison::~IntegratorComparison() = default;

std::vector<Comparison> IntegratorComparison::Compare(const std::string& only) {
  std::vector<Comparison> comparisons;
  const auto compare = [&](const char* what, const Method& a, const Method& b, auto add) {
    if (only.empty() || only.starts_with(what))
      add(what, rendered_->Of(a), rendered_->Of(b), &comparisons);
  };
  if (only.empty() && !(SampleOf(rendered_->Of(kPath)[0]).mean > kDark)) return comparisons;
  compare("guidedpath against path", kGuidedPath, kPath, CompareUnbiased);
  if (rendered_->effort.comparesMore)
    compare("bidirectional against path", kBidirectional, kPath, CompareUnbiased);
  compare("exphotonmap against path", kExPhotonMap, kPath, CompareMeans);
  if (HasNarrowLobe(rendered_->scene)) return comparisons;
  compare("exphotonmap against its density estimates", kExPhotonMap, kDensityEstimates,
          ComparePairs);
  compare("photonmap against path", kPhotonMap, kPath, CompareMeans);
  compare("exphotonmap against photonmap", kExPhotonMap, kPhotonMap, CompareMeans);
  return comparisons;
}

std::vector<Comparison> CompareWithEnergy(const SceneModel& scene, const Effort& effort) {
  std::vector<Comparison> comparisons;
  // Both lobes of shinymetal approach 1 at grazing angles, and brushedmetal reflects 1.6 there.
  const auto gains = [](const MaterialModel& m) {
    return m.kind == MaterialKind::ShinyMetal ||
           (m.kind == MaterialKind::Fitted && m.Fit() == kBrushedMetal);
  };
  const auto refracts = [](const MaterialModel& m) { return m.kind == MaterialKind::Glass; };
  if (HasMaterial(scene, gains)) return comparisons;
  if (HasMaterial(scene, refracts) &&
      (IsCameraInside(scene) || scene.walls.kind == MaterialKind::Glass))
    return comparisons;
  TextOptions options = OptionsOf(kPath, effort);
  options.isFurnace = true;
  options.samples = 4 * effort.factor;
  const Means path = MeansOfSeeds(SceneText(scene, options), effort.firstSeed + 3, false);
  for (std::size_t i = 0; i < path.size(); ++i) {
    const Sample sample = SampleOf(path[i]);
    comparisons.push_back({i == 0 ? "energy, picture" : "energy, block " + std::to_string(i),
                           PValueAbove(sample, 1 + kEnergyMargin), sample.mean - 1,
                           Describe(sample, {1, 0, kSeeds})});
  }
  return comparisons;
}

std::string AgreementText(const SceneModel& scene) {
  return SceneText(WithoutKnownDifferences(scene), OptionsOf(kExPhotonMap, {}));
}

std::string EnergyText(const SceneModel& scene) {
  TextOptions options = OptionsOf(kPath, {});
  options.isFurnace = true;
  return SceneText(scene, options);
}

}  // namespace exphoton::random_scenes
