// SPDX-License-Identifier: BSD-2-Clause
// These tests check pixels with more camera samples, because they show more than one surface: the
// mean stays the same, the noise falls, and the number of gather rays hardly changes.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

// White bars, about a pixel and a half wide, before a dark wall, in a room with a lamp above.
std::string Bars(int edgeSamples, const std::string& filter, const std::string& sampler,
                 int photons = 3000) {
  std::string text =
      "SurfaceIntegrator \"exphotonmap\" \"integer indirectphotons\" " + std::to_string(photons) +
      " \"integer finalgathersamples\" 8 \"float rrthreshold\" 0 \"integer edgesamples\" " +
      std::to_string(edgeSamples) +
      "\nFilm \"image\" \"integer xresolution\" 20 \"integer yresolution\" 12\nPixelFilter " +
      filter + "\nSampler " + sampler +
      "\nCamera \"perspective\" \"float fov\" 60\nWorldBegin\n"
      "LightSource \"point\" \"color I\" [9 9 9] \"point from\" [0 1.5 -.5]\n"
      "Material \"matte\" \"color Kd\" [.1 .1 .1]\nShape \"trianglemesh\" \"integer indices\" "
      "[0 1 2 0 2 3] \"point P\" [-9 -9 3  9 -9 3  9 9 3  -9 9 3]\nMaterial \"matte\" \"color "
      "Kd\" [.9 .9 .9]\nShape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point P\" "
      "[-9 -2 -9  9 -2 -9  9 -2 9  -9 -2 9]\n";
  for (int i = 0; i < 7; ++i) {
    const std::string x0 = std::to_string(-1.2 + .37 * i), x1 = std::to_string(-1.02 + .37 * i);
    text += "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point P\" [" + x0 +
            " -2 2  " + x1 + " -2 2  " + x1 + " 2 2  " + x0 + " 2 2]\n";
  }
  return text + "WorldEnd\n";
}

constexpr int kSeeds = 12;

// The mean of all pixels over several seeds, its squared standard error, and the noise of a pixel.
struct Measured {
  double mean = 0, error2 = 0, noise = 0;
};

Measured Measure(const std::string& scene) {
  LoadedScene loaded = LoadSceneText(scene);
  std::vector<Image> images;
  for (int seed = 0; seed < kSeeds; ++seed) {
    TestRenderOptions options;
    options.seed = std::uint64_t(seed);
    images.push_back(RenderLoaded(loaded, options).image);
  }
  Measured found;
  const std::size_t size = images[0].pixels.size();
  std::vector<double> means;
  for (const Image& image : images) {
    double sum = 0;
    for (const float value : image.pixels) sum += value;
    means.push_back(sum / double(size));
    found.mean += means.back() / kSeeds;
  }
  for (const double mean : means)
    found.error2 += (mean - found.mean) * (mean - found.mean) / (kSeeds * (kSeeds - 1));
  for (std::size_t i = 0; i < size; ++i) {
    double sum = 0, squares = 0;
    for (const Image& image : images)
      sum += image.pixels[i], squares += image.pixels[i] * image.pixels[i];
    found.noise += (squares - sum * sum / kSeeds) / (kSeeds - 1) / double(size);
  }
  return found;
}

void ExpectSameMean(const std::string& filter, const std::string& sampler) {
  const Measured one = Measure(Bars(1, filter, sampler)), four = Measure(Bars(4, filter, sampler));
  EXPECT_LT(std::abs(one.mean - four.mean), 4 * std::sqrt(one.error2 + four.error2))
      << one.mean << " " << four.mean;
  EXPECT_LT(std::sqrt(one.error2 + four.error2), .01 * one.mean);  // the check is sharp
}

// Returns the noise with four times the samples, relative to the noise with one. Without photons,
// nothing but edges makes noise.
double Noise(const std::string& filter, const std::string& sampler) {
  return Measure(Bars(4, filter, sampler, 0)).noise / Measure(Bars(1, filter, sampler, 0)).noise;
}

const char* const kStratified = "\"stratified\" \"integer xsamples\" 2 \"integer ysamples\" 2";
const char* const kSequence = "\"lowdiscrepancy\" \"integer pixelsamples\" 4";

TEST(EdgeSamples, HaveTheSameMean) {
  ExpectSameMean("\"box\"", kSequence);
  ExpectSameMean("\"box\"", kStratified);
}

TEST(EdgeSamples, HaveTheSameMeanWhereSamplesAreSplatted) {
  ExpectSameMean("\"mitchell\"", kSequence);
}

// Returns the root of the mean squared difference between pixels of the mean pictures of all seeds,
// without photons.
double Difference(const std::string& sceneA, const std::string& sceneB) {
  const auto meanPicture = [](const std::string& scene) {
    LoadedScene loaded = LoadSceneText(scene);
    std::vector<double> mean;
    for (int seed = 0; seed < kSeeds; ++seed) {
      TestRenderOptions options;
      options.seed = std::uint64_t(seed);
      const Image image = RenderLoaded(loaded, options).image;
      mean.resize(image.pixels.size());
      for (std::size_t i = 0; i < mean.size(); ++i) mean[i] += double(image.pixels[i]) / kSeeds;
    }
    return mean;
  };
  const std::vector<double> a = meanPicture(sceneA), b = meanPicture(sceneB);
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum / double(a.size()));
}

// The filter must not become narrower where pixels show edges.
TEST(EdgeSamples, HaveTheSamePictureWhereSamplesAreSplatted) {
  const std::string many = "\"lowdiscrepancy\" \"integer pixelsamples\" 64";
  const std::string four = Bars(4, "\"mitchell\"", many, 0);
  const double same = Difference(four, Bars(1, "\"mitchell\"", many, 0));
  const double other = Difference(four, Bars(1, "\"box\"", many, 0));
  EXPECT_LT(same, .1 * other) << same << ' ' << other;
}

// The estimate of the variance must fit the variance between seeds.
TEST(EdgeSamples, KnowTheirVariance) {
  for (const char* filter : {"\"box\"", "\"mitchell\""}) {
    const std::string scene =
        Bars(4, filter, "\"random\" \"integer xsamples\" 4 \"integer ysamples\" 2", 0);
    TestRenderOptions options;
    options.aovs = {Aov::Variance};
    const Image image = RenderSceneText(scene, options).image;
    double sum = 0;
    for (int y = 0; y < image.Height(); ++y)
      for (int x = 0; x < image.Width(); ++x)
        sum += double(image.At(x, y, image.FindChannel("variance.G")));
    const double estimate = sum / (image.Width() * image.Height());
    // Of four channels, alpha has no noise.
    EXPECT_NEAR(estimate / (Measure(scene).noise * 4 / 3), 1, .25) << filter;
  }
}

TEST(EdgeSamples, AreLessNoisy) {
  EXPECT_LT(Noise("\"box\"", kSequence), .2);
  EXPECT_LT(Noise("\"gaussian\"", kSequence), .2);
  EXPECT_LT(Noise("\"mitchell\"", kSequence), .2);
}

// Four times four strata would have a quarter of the noise.
TEST(EdgeSamples, AreStratifiedTogether) { EXPECT_LT(Noise("\"box\"", kStratified), .2); }

TEST(EdgeSamples, DivideTheGatherRays) {
  const std::string sampler = "\"lowdiscrepancy\" \"integer pixelsamples\" 2";
  const auto rays = [&](int edgeSamples, RayKind kind) {
    const TestRender render = RenderSceneText(Bars(edgeSamples, "\"box\"", sampler));
    return double(render.rays.counts[std::size_t(kind)]);
  };
  EXPECT_NEAR(rays(4, RayKind::Gather) / rays(1, RayKind::Gather), 1, .03);
  EXPECT_GT(rays(4, RayKind::Camera), 1.5 * rays(1, RayKind::Camera));
  EXPECT_LT(rays(4, RayKind::Camera), 4 * rays(1, RayKind::Camera));
}

}  // namespace
}  // namespace exphoton
