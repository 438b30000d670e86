// SPDX-License-Identifier: BSD-2-Clause
// These tests share the gathers of passes whose light is a wave with noise.
#include "core/render/sharing/passes/joint_windows.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/files/state_file.h"
#include "core/math/sampling/random.h"
#include "core/render/certificate/corrections.h"
#include "core/render/passes/pass_sum.h"
#include "tests/support/process.h"

namespace exphoton {
namespace {

constexpr int kWaveSide = 32, kWaveSamples = 2;
constexpr PixelBounds kWave{0, 0, kWaveSide, kWaveSide};
constexpr AovSet kWaveAovs{Aov::Indirect};

double WaveAt(int x) { return 1 + .5 * std::sin(.45 * x); }

// The gathers of one pass: 2 samples of the wave, with noise.
GatherFragments WavePass(std::uint64_t seed) {
  GatherFragments gathers(kWave, kWaveSamples);
  RandomStream random(seed);
  for (int y = 0; y < kWaveSide; ++y) {
    for (int x = 0; x < kWaveSide; ++x) {
      for (int i = 0; i < kWaveSamples; ++i) {
        const Point2 at{Real(x) + random.Uniform(), Real(y) + random.Uniform()};
        const Spectrum light(Real(WaveAt(x)) * 2 * random.Uniform());
        const GatherRecord record{
            {at.x / 100, at.y / 100, 0}, {0, 0, 1}, {0, 0, 1}, light, Spectrum(1)};
        gathers.At({x, y}).Add({record}, at, 1, {GatherGroup({x, y}, i), 1});
      }
      gathers.At({x, y}).Finish();
    }
  }
  return gathers;
}

// A picture of passes that share with joint windows, or apart.
struct WavePicture {
  WavePicture() {
    corrections.KeepSharingApart();
    for (int y = 0; y < kWaveSide; ++y)
      for (int x = 0; x < kWaveSide; ++x)
        for (int i = 0; i < kWaveSamples; ++i) empty.AddSample({x, y}, Spectrum(), 1, 1);
  }

  // Renders the next pass as its own group.
  void Add(bool isJoint) {
    Film pass = empty;
    GatherFragments gathers = WavePass(std::uint64_t(passes));
    const SharedLightTarget target{&pass, &aovs, nullptr, kWave, kWaveSamples, &corrections};
    for (int y = 0; y < kWaveSide; ++y)
      for (int x = 0; x < kWaveSide; ++x)
        for (int i = 0; i < kWaveSamples; ++i) aovs.AddSample({x, y}, {}, Spectrum(), 1);
    if (isJoint)
      AddOwnLight(gathers, target, &threads);
    else
      SharedGathers(gathers, {kWave}, &threads).AddLight(target);
    sum.Add(pass, kWaveSamples, passes);
    corrections.EndPass(passes, kWaveSamples);
    if (isJoint) {
      *joint.OfPass() = std::move(gathers);
      joint.Add(kWaveSamples, passes);
    }
    ++passes;
  }
  void Fit() {
    joint.Fit(&threads, [&](int group, const SharingChange& difference) {
      sum.AddLight(difference.film, group);
      corrections.SubtractSharing(difference.film, group);
      aovs.Add(*difference.aovs);
    });
  }
  double Error() const {
    double squares = 0;
    for (int y = 0; y < kWaveSide; ++y)
      for (int x = 0; x < kWaveSide; ++x) {
        // The mean of the wave over the pixel is its value to 1 %.
        const double difference = film.MeanOf({x, y})[0] - WaveAt(x);
        squares += difference * difference;
      }
    return squares / (kWaveSide * kWaveSide);
  }

  Film film{kWave, kWave}, empty{kWave, kWave};
  AovFilm aovs{kWave, kWaveAovs};
  PassSum sum{&film, {}};
  Corrections corrections{kWave, 1};
  ThreadPool threads{1};
  JointWindows joint{film, &aovs, 0x1p30};
  int passes = 0;
};

TEST(JointWindows, OfOnePassAreItsOwn) {
  WavePicture alone, joint;
  alone.Add(false);
  joint.Add(true);
  joint.Fit();
  for (int i = 0; i < kWaveSide; ++i)
    EXPECT_NEAR(joint.film.MeanOf({i, i})[0], alone.film.MeanOf({i, i})[0], 1e-6);
}

TEST(JointWindows, GiveSeveralPassesLessError) {
  WavePicture apart, together;
  for (int pass = 0; pass < 8; ++pass) {
    apart.Add(false);
    together.Add(true);
    together.Fit();
  }
  EXPECT_LT(together.Error(), .8 * apart.Error());
  // The noise shows between the groups, and it is a part of the error.
  EXPECT_GT(*together.sum.Noise(), .2 * together.Error());
  EXPECT_LT(*together.sum.Noise(), 1.5 * together.Error());
}

// The light of the picture, of the AOVs, and own light minus the corrections are the same.
TEST(JointWindows, ReplaceLightWhereverItIsKnown) {
  WavePicture picture;
  for (int pass = 0; pass < 3; ++pass) {
    picture.Add(true);
    picture.Fit();  // also replaces the light of the fit before
  }
  Image aovs;
  picture.aovs.AppendTo(picture.film, false, &aovs);
  std::vector<double> own(std::size_t(kWaveSide * kWaveSide));
  for (int pass = 0; pass < 3; ++pass) {
    const GatherFragments gathers = WavePass(std::uint64_t(pass));
    for (std::size_t i = 0; i < own.size(); ++i)
      for (const GatherSample& sample :
           gathers.At({int(i) % kWaveSide, int(i) / kWaveSide}).samples)
        own[i] += double(sample.light.r);
  }
  double most = 0, difference = 0;
  for (std::size_t i = 0; i < own.size(); ++i) {
    double corrections = 0;
    for (const auto* group : picture.corrections.Groups())
      corrections += picture.corrections.SumsOf(*group)[3 * i];
    const double light = picture.film.SumsOf(i).r;
    most = std::max(most, std::abs(corrections));
    difference = std::max(difference, std::abs(light + corrections - own[i]));
    EXPECT_NEAR(double(aovs.pixels[3 * i]), light / (3 * kWaveSamples), 1e-5);
  }
  EXPECT_GT(most, 1);
  EXPECT_LT(difference, 1e-4);
}

TEST(JointWindows, ContinueFromAState) {
  WavePicture whole;
  for (int pass = 0; pass < 2; ++pass) whole.Add(true);
  whole.Fit();
  const TestFolder folder;
  const std::string path = folder.File("joint.state");
  StateWriter writer(path);
  whole.joint.Save(&writer);
  writer.Commit();

  JointWindows loaded(whole.film, &whole.aovs, 0x1p30);
  const StateFile file(path);
  EXPECT_THROW(JointWindows(whole.film, &whole.aovs, 0x1p30).Load(file, 1), Error);
  loaded.Load(file, 2);
  EXPECT_EQ(loaded.Passes(), 2u);
  EXPECT_EQ(loaded.SamplesPerPixel(), 2 * kWaveSamples);
  const auto next = [&](JointWindows* joint) {
    *joint->OfPass() = WavePass(2);
    joint->Add(kWaveSamples, 2);
    Film light(kWave, kWave);
    joint->Fit(&whole.threads,
               [&](int, const SharingChange& difference) { light.Add(difference.film); });
    std::vector<double> sums;
    for (std::size_t i = 0; i < light.PixelCount(); ++i) sums.push_back(light.SumsOf(i).g);
    return sums;
  };
  EXPECT_EQ(next(&loaded), next(&whole.joint));
}

TEST(JointWindows, EndWhereMemoryOrPassesEnd) {
  WavePicture picture;
  const double gathers = kWaveSide * kWaveSide * GatherFragments::BytesPerPixel(100 * kWaveSamples);
  EXPECT_TRUE(JointWindows(picture.film, nullptr, gathers).HasRoomFor(50 * kWaveSamples));
  EXPECT_FALSE(JointWindows(picture.film, nullptr, gathers).HasRoomFor(100 * kWaveSamples));
  // The gathers of the full picture count, so that a crop has the same windows.
  const Film crop(kWave, {3, 3, 5, 5});
  EXPECT_FALSE(JointWindows(crop, nullptr, gathers).HasRoomFor(100 * kWaveSamples));
  int passes = 0;
  while (picture.joint.HasRoomFor(kWaveSamples) && passes < 100) picture.Add(true), ++passes;
  EXPECT_EQ(passes, 8);
}

}  // namespace
}  // namespace exphoton
