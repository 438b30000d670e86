// SPDX-License-Identifier: BSD-2-Clause
// The noise test of pictures: its rate of false alarms on synthetic noise, and its power. Seeds are
// fixed. A rate of 5 % gives more than 12 false alarms in 100 trials with probability 0.15 %.
#include "core/imaging/metrics/noise_test.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace exphoton {
namespace {

constexpr int kTrials = 100, kMostAlarms = 12;
constexpr double kSignificance = .05;

// A grey wall with a darker half, rendered with noise of relative deviation .2 in each pixel.
class Renderer {
 public:
  explicit Renderer(unsigned seed) : engine_(seed) {}

  bool hasHalves = false, hasVariance = false;
  double sharedNoise = 0;  // relative deviation of a factor of all pixels of a half
  bool blurs = false;      // a filter of 3 x 3 pixels shares samples between neighbours
  double recoloured = 1;   // factor of the green of a part

  Image Render() {
    std::vector<std::string> names{"R", "G", "B"};
    for (const char* layer : {"half1", "half2", "variance"})
      for (const char* channel : {".R", ".G", ".B"})
        if (layer[0] == 'h' ? hasHalves : hasVariance)
          names.push_back(layer + std::string(channel));
    Image image(64, 48, names);
    image.attributes["integrator"] = std::string("path");
    const Image halves[2] = {Half(), Half()};
    for (int y = 0; y < image.Height(); ++y)
      for (int x = 0; x < image.Width(); ++x)
        for (int c = 0; c < 3; ++c) {
          const float a = halves[0].At(x, y, c), b = halves[1].At(x, y, c);
          image.At(x, y, c) = (a + b) / 2;
          if (hasHalves) image.At(x, y, 3 + c) = a, image.At(x, y, 6 + c) = b;
          if (hasVariance)
            image.At(x, y, 3 + (hasHalves ? 6 : 0) + c) =
                float(std::pow(Truth(x, y, c) * kDeviation, 2) / 2 * (blurs ? 1. / 9 : 1));
        }
    return image;
  }

 private:
  static constexpr double kDeviation = .2;  // of a pixel of a half

  double Truth(int x, int y, int channel) const {
    const double wall = x < 32 ? .5 : .2;
    return channel == 1 && x >= 8 && x < 24 && y >= 8 && y < 24 ? wall * recoloured : wall;
  }
  Image Half() {
    std::normal_distribution<double> normal;
    Image samples(66, 50, {"R", "G", "B"});
    for (float& value : samples.pixels) value = float(normal(engine_));
    Image half(64, 48, {"R", "G", "B"});
    const double factor = 1 + sharedNoise * normal(engine_);
    for (int y = 0; y < 48; ++y)
      for (int x = 0; x < 64; ++x)
        for (int c = 0; c < 3; ++c) {
          double noise = double(samples.At(x, y, c));
          if (blurs) {
            noise = 0;
            for (int i = 0; i < 9; ++i) noise += double(samples.At(x + i % 3, y + i / 3, c)) / 9;
          }
          half.At(x, y, c) = float(Truth(x, y, c) * (factor + kDeviation * noise));
        }
    return half;
  }

  std::mt19937 engine_;
};

// Returns the number of trials in which the test finds a difference.
int CountAlarms(Renderer renderer, NoiseSource expected, int references, double recoloured,
                bool sharesNoise) {
  int alarms = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    renderer.recoloured = 1;
    std::vector<Image> all;
    for (int i = 0; i < references; ++i) all.push_back(renderer.Render());
    renderer.recoloured = recoloured;
    const NoiseTest test = TestAgainstNoise(all, renderer.Render(), {kSignificance, sharesNoise});
    EXPECT_EQ(test.source, expected);
    EXPECT_EQ(test.count, 3 + 3 * 4);
    alarms += int(test.Differs());
  }
  return alarms;
}

TEST(NoiseTest, StudentsTailHasItsTabulatedValues) {
  EXPECT_NEAR(StudentTail(12.7062, 1), .05, 1e-6);
  EXPECT_NEAR(StudentTail(-2.77645, 4), .05, 1e-6);
  EXPECT_NEAR(StudentTail(1.959964, 1e7), .05, 1e-6);
  EXPECT_NEAR(StudentTail(31.5991, 3), 7e-5, 2e-6);
  EXPECT_EQ(StudentTail(0, 5), 1);
}

TEST(NoiseTest, HalvesRaiseNoMoreFalseAlarmsThanStated) {
  Renderer renderer(1);
  renderer.hasHalves = true;
  EXPECT_LE(CountAlarms(renderer, NoiseSource::Halves, 1, 1, false), kMostAlarms);
  EXPECT_EQ(CountAlarms(renderer, NoiseSource::Halves, 1, 1.3, false), kTrials);
}

TEST(NoiseTest, HalvesKnowTheNoiseOfWideFilters) {
  Renderer renderer(2);
  renderer.hasHalves = true;
  renderer.blurs = true;
  EXPECT_LE(CountAlarms(renderer, NoiseSource::Halves, 1, 1, false), kMostAlarms);
}

TEST(NoiseTest, VariancesRaiseNoMoreFalseAlarmsThanStated) {
  Renderer renderer(3);
  renderer.hasVariance = true;
  EXPECT_LE(CountAlarms(renderer, NoiseSource::Variance, 1, 1, false), kMostAlarms);
  EXPECT_EQ(CountAlarms(renderer, NoiseSource::Variance, 1, 1.3, false), kTrials);
}

// The variances of the pixels alone would predict a third of the deviation of a cell.
TEST(NoiseTest, VariancesAllowForWideFilters) {
  Renderer renderer(4);
  renderer.hasVariance = true;
  renderer.blurs = true;
  EXPECT_LE(CountAlarms(renderer, NoiseSource::Variance, 1, 1, false), kMostAlarms);
}

// A test that takes two references for one with twice the values finds too much noise.
TEST(NoiseTest, ComparesWithTheMeanOfSeveralReferences) {
  Renderer renderer(9);
  renderer.hasVariance = true;
  EXPECT_LE(CountAlarms(renderer, NoiseSource::Variance, 2, 1, false), kMostAlarms);
  EXPECT_GE(CountAlarms(renderer, NoiseSource::Variance, 2, 1.15, false), kTrials * 95 / 100);
}

TEST(NoiseTest, IndependentPicturesMeasureNoiseThatPixelsShare) {
  Renderer renderer(5);
  renderer.hasHalves = true;
  renderer.sharedNoise = .01;
  EXPECT_LE(CountAlarms(renderer, NoiseSource::Replicates, 4, 1, true), kMostAlarms);
  EXPECT_GE(CountAlarms(renderer, NoiseSource::Replicates, 4, 1.3, true), kTrials * 95 / 100);
  renderer.sharedNoise = .02;
  // Cells of one picture do not see the shared noise: this is why the option exists.
  EXPECT_GE(CountAlarms(renderer, NoiseSource::Halves, 1, 1, false), kTrials / 2);
}

TEST(NoiseTest, ThreeReferencesNeedNoLayers) {
  Renderer renderer(6);
  renderer.sharedNoise = .01;
  EXPECT_LE(CountAlarms(renderer, NoiseSource::Replicates, 6, 1, true), kMostAlarms);
  EXPECT_GE(CountAlarms(renderer, NoiseSource::Replicates, 6, 1.5, true), kTrials * 95 / 100);
}

TEST(NoiseTest, SaysWhatIsMissing) {
  Renderer renderer(7);
  const Image plain = renderer.Render();
  const NoiseTest none = TestAgainstNoise({&plain, 1}, plain, {});
  EXPECT_EQ(none.source, NoiseSource::None);
  EXPECT_NE(none.reason.find("--two-halves"), std::string::npos);
  EXPECT_FALSE(none.Differs());
  renderer.hasVariance = true;
  const Image variance = renderer.Render();
  EXPECT_NE(TestAgainstNoise({&variance, 1}, variance, {}).reason.find("photons"),
            std::string::npos);
}

TEST(NoiseTest, NamesTheChannelAndTheBlock) {
  Renderer renderer(8);
  renderer.hasHalves = true;
  const Image reference = renderer.Render();
  renderer.recoloured = 1.5;
  const NoiseTest test = TestAgainstNoise({&reference, 1}, renderer.Render(), {.01, false});
  EXPECT_EQ(test.mean.channel, "G");
  EXPECT_EQ(test.block.channel, "G");
  EXPECT_TRUE((test.block.part == PixelBounds{0, 0, 32, 32}));
  EXPECT_NEAR(test.block.relativeDifference, .5 * 16 * 16 / (32. * 32), .02);
}

}  // namespace
}  // namespace exphoton
