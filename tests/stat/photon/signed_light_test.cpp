// SPDX-License-Identifier: BSD-2-Clause
// These tests compare the squares of signed estimates with the variance of the estimates between
// independent sets of photons: for single points, for the sum of many points, where the photons of
// a path must have the same sign, and for pictures.
#include <gtest/gtest.h>

#include <vector>

#include "core/imaging/metrics/metrics.h"
#include "core/render/photon_noise.h"
#include "core/render/render.h"
#include "integrators/photon/maps/photon_map_set.h"
#include "tests/support/photon_shots.h"
#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

// The box [-1,1]^3 with bright walls and a lamp below its ceiling. `other` is in the box as well.
std::string Box(const std::string& other = "") {
  std::string text = "Material \"matte\" \"color Kd\" [.7 .7 .7]\n";
  for (const char* turn :
       {"0 1 0 0", "90 1 0 0", "180 1 0 0", "270 1 0 0", "90 0 1 0", "270 0 1 0"})
    text += std::string("AttributeBegin\nRotate ") + turn +
            "\nTranslate 0 0 -1\nShape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point "
            "P\" [-1 -1 0 1 -1 0 1 1 0 -1 1 0]\nAttributeEnd\n";
  return "WorldBegin\nAttributeBegin\nTranslate 0 .8 0\nRotate 90 1 0 0\nAreaLightSource \"area\" "
         "\"color L\" [9 9 9]\nShape \"disk\" \"float radius\" .3\nAttributeEnd\n" +
         text + other + "WorldEnd\n";
}

// Running moments of estimates and of their signed counterparts.
struct Moments {
  double sum = 0, squares = 0, signedSquares = 0;
  int count = 0;

  void Add(double estimate, double signedEstimate) {
    sum += estimate;
    squares += estimate * estimate;
    signedSquares += signedEstimate * signedEstimate;
    ++count;
  }
  double Variance() const { return (squares - sum * sum / count) / (count - 1); }
  double SignedVariance() const { return signedSquares / count; }
};

TEST(SignedLight, HasTheVarianceBetweenSetsOfPhotons) {
  const LoadedScene loaded = LoadSceneText(Box());
  const Scene& scene = *loaded.setup->scene;
  PhotonSettings settings;
  settings.nUsed = 40;
  PhotonTargets targets;
  targets[PhotonKind::Indirect] = 3000;
  constexpr int kSeeds = 300, kAcross = 5;
  std::vector<Moments> points(kAcross * kAcross);
  Moments all;
  ThreadPool threads(1);
  Log log(Log::Level::Normal, Log::Sink::Memory);
  ProgressReporter progress(ProgressReporter::Mode::Quiet);
  Statistics statistics;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    PhotonPassResult photons = ShootPhotons(scene, seed, targets, settings);
    PreprocessContext context{threads, seed, log, progress, statistics, false, nullptr, {}};
    const PhotonMapSet maps(&photons, settings, Real(1.8), context);
    Arena arena;
    double sum = 0, signedSum = 0;
    for (int i = 0; i < kAcross * kAcross; ++i) {
      const Real x = Real(-.8) + Real(.4) * Real(i % kAcross);
      const Real z = Real(-.8) + Real(.4) * Real(i / kAcross);
      const auto found = maps.EstimateIrradiance({x, -1, z}, {0, 1, 0}, &arena);
      points[std::size_t(i)].Add(double(found.e.g), double(found.signedE.g));
      sum += double(found.e.g);
      signedSum += double(found.signedE.g);
    }
    all.Add(sum, signedSum);
  }
  double variance = 0, signedVariance = 0;
  for (const Moments& point : points) {
    variance += point.Variance();
    signedVariance += point.SignedVariance();
  }
  // 25 points are about as many independent variances, each known to 8 %.
  EXPECT_NEAR(signedVariance / variance, 1, .1);
  // The sum has one variance. Disks of one map overlap little.
  EXPECT_NEAR(all.SignedVariance() / all.Variance(), 1, .35);
  EXPECT_GT(all.Variance(), variance);  // paths make the points vary together
}

// Pictures with the same camera samples and different photons.
struct PhotonPictures {
  std::vector<Image> images;
  std::vector<PhotonNoise> noises;
};

PhotonPictures RenderPictures(const std::string& text, int count) {
  constexpr std::int64_t kSamples = 16;  // of each of two passes
  const LoadedScene loaded = LoadSceneText(text);
  const RenderSetup& setup = *loaded.setup;
  ThreadPool threads(2);
  ProgressReporter progress(ProgressReporter::Mode::Quiet);
  PhotonPictures pictures;
  for (int set = 0; set < count; ++set) {
    Film film(setup.film.Full(), setup.crop);
    Statistics statistics;
    const RenderJob job{
        *setup.scene, *setup.integrator, *setup.sampler, *setup.filter, *setup.camera,
        film,         threads,           *loaded.log,    progress,      statistics};
    const RenderOptions options;
    PassRenderer renderer(job, options);
    PhotonNoise& noise = pictures.noises.emplace_back(setup.crop);
    for (std::int64_t first = 0; first < 2 * kSamples; first += kSamples) {
      RenderPass pass{std::uint64_t(100 + set), 1, first, kSamples};
      pass.photonNoise = &noise;
      renderer.Run(pass, *setup.sampler, &film);
      noise.EndPass(kSamples);
    }
    pictures.images.push_back(film.ToImage(true));
  }
  return pictures;
}

// Returns the mean over the pictures of the noise that their signed light shows, divided by the
// variance between the pictures.
double RatioOfNoise(const PhotonPictures& pictures) {
  const auto count = double(pictures.images.size());
  std::vector<double> levels;
  double variance = 0;
  const Image& first = pictures.images.front();
  for (int y = 0; y < first.Height(); ++y) {
    for (int x = 0; x < first.Width(); ++x) {
      for (int c = 0; c < 3; ++c) {
        double sum = 0, squares = 0;
        for (const Image& image : pictures.images) {
          const auto value = double(image.At(x, y, c));
          sum += value;
          squares += value * value;
        }
        levels.push_back(sum * sum / (count * count));
        variance += (squares - sum * sum / count) / (count - 1) / (levels.back() + kRelMseOffset);
      }
    }
  }
  double estimated = 0;
  for (const PhotonNoise& noise : pictures.noises)
    estimated += noise.RelativeVariance(levels) / count;
  return estimated * double(levels.size()) / variance;
}

struct NoisyPicture {
  const char* name;
  const char* integrator;
  const char* other = "";  // in the box
};

class SignedPictures : public testing::TestWithParam<NoisyPicture> {};

// The signs assume that paths are independent. But the emission of paths is well distributed, so
// pictures of gathers and caustics have less noise than their signs show, up to a third. The finite
// number of gather rays adds some variance between the pictures.
TEST_P(SignedPictures, ShowTheNoiseOfTheirPhotons) {
  const std::string text = TestHeader(GetParam().integrator, 8, 8, 32) + Box(GetParam().other);
  const double ratio = RatioOfNoise(RenderPictures(text, 40));
  EXPECT_GT(ratio, .85);
  EXPECT_LT(ratio, 1.6);
}

constexpr const char* kGathered =
    "\"exphotonmap\" \"integer indirectphotons\" 4000 \"integer directphotons\" 4000 \"integer "
    "causticphotons\" 0 \"integer finalgathersamples\" 64 \"string gathersampling\" \"bsdf\" "
    "\"bool sharedgather\" \"false\" \"integer edgesamples\" 1";
constexpr const char* kSeen =
    "\"photonmap\" \"integer indirectphotons\" 4000 \"integer causticphotons\" 0 \"integer "
    "directphotons\" 4000 \"bool finalgather\" \"false\"";
constexpr const char* kDensities =
    "\"photonmap\" \"integer indirectphotons\" 1000 \"integer directphotons\" 1000 \"integer "
    "causticphotons\" 0 \"bool finalgather\" \"true\" \"integer finalgathersamples\" 12 \"string "
    "gathersampling\" \"bsdf\" \"bool sharedgather\" \"false\"";
constexpr const char* kCaustics =
    "\"photonmap\" \"integer indirectphotons\" 0 \"integer directphotons\" 0 \"integer "
    "causticphotons\" 3000 \"bool finalgather\" \"false\"";
constexpr const char* kGlassBall =
    "AttributeBegin\nMaterial \"glass\"\nTranslate 0 -.3 .4\nShape \"sphere\" \"float radius\" "
    ".3\nAttributeEnd\n";

INSTANTIATE_TEST_SUITE_P(Of, SignedPictures,
                         testing::Values(NoisyPicture{"RadiancePhotons", kGathered},
                                         NoisyPicture{"MapsThatAreSeen", kSeen},
                                         NoisyPicture{"GatheredDensities", kDensities},
                                         NoisyPicture{"Caustics", kCaustics, kGlassBall}),
                         [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace exphoton
