// SPDX-License-Identifier: BSD-2-Clause
// These tests compare the picture without shared gathers with light that was never shared.
#include "core/render/passes/unshared/unshared_picture.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/math/sampling/random.h"
#include "core/render/certificate/corrections.h"
#include "core/render/sharing/shared_gathers.h"
#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

constexpr int kOwnSide = 24, kOwnSamples = 4;
constexpr PixelBounds kOwnBounds{0, 0, kOwnSide, kOwnSide};
constexpr AovSet kOwnAovs{Aov::Indirect, Aov::SharingBias};

// The pictures of one pass, whose light is a wave with noise.
struct BothPictures {
  Film own{kOwnBounds, kOwnBounds}, shared{kOwnBounds, kOwnBounds};
  AovFilm ownAovs{kOwnBounds, kOwnAovs}, aovs{kOwnBounds, kOwnAovs};
};

void GatherPass(std::uint64_t seed, BothPictures* pass, SharingChange* change,
                Corrections* corrections) {
  GatherFragments gathers(kOwnBounds, kOwnSamples);
  RandomStream random(seed);
  for (int y = 0; y < kOwnSide; ++y) {
    for (int x = 0; x < kOwnSide; ++x) {
      for (int i = 0; i < kOwnSamples; ++i) {
        const Point2 at{Real(x) + random.Uniform(), Real(y) + random.Uniform()};
        const Spectrum light((1 + Real(.3) * std::sin(Real(y))) * 2 * random.Uniform());
        const GatherRecord record{
            {at.x / 100, at.y / 100, 0}, {0, 0, 1}, {0, 0, 1}, light, Spectrum(1)};
        gathers.At({x, y}).Add({record}, at, 1, {GatherGroup({x, y}, i), 1});
        for (Film* film : {&pass->own, &pass->shared}) film->AddSample({x, y}, Spectrum(), 1, 1);
        for (AovFilm* aovs : {&pass->ownAovs, &pass->aovs})
          aovs->AddSample({x, y}, {}, Spectrum(), 1);
        pass->own.AddLight({x, y}, light, 1);
        pass->ownAovs.AddLight({x, y}, Aov::Indirect, light, 1);
      }
      gathers.At({x, y}).Finish();
    }
  }
  ThreadPool threads(1);
  SharedGathers(gathers, {kOwnBounds}, &threads)
      .AddLight(
          {&pass->shared, &pass->aovs, nullptr, kOwnBounds, kOwnSamples, corrections, change});
}

double MostDifference(const std::vector<float>& a, const std::vector<float>& b) {
  double most = a.size() == b.size() ? 0 : INFINITY;
  for (std::size_t i = 0; i < a.size() && i < b.size(); ++i)
    most = std::max(most, std::abs(double(a[i]) - double(b[i])));
  return most;
}

std::vector<float> PixelsWithAovs(const Film& film, const AovFilm& aovs) {
  Image image = film.ToImage(false);
  aovs.AppendTo(film, false, &image);
  return image.pixels;
}

TEST(UnsharedPicture, IsTheOneThatNeverSharedItsGathers) {
  Film picture(kOwnBounds, kOwnBounds), own(kOwnBounds, kOwnBounds);
  AovFilm aovs(kOwnBounds, kOwnAovs), ownAovs(kOwnBounds, kOwnAovs);
  PassSum sum(&picture, {}), ownSum(&own, {});
  UnsharedPicture unshared(picture, &aovs);
  for (int group = 0; group < 2; ++group) {
    BothPictures pass;
    GatherPass(std::uint64_t(group), &pass, unshared.OfPass(), nullptr);
    sum.Add(pass.shared, kOwnSamples, group);
    unshared.Add(pass.shared, kOwnSamples, group);
    ownSum.Add(pass.own, kOwnSamples, group);
    aovs.Add(pass.aovs);
    ownAovs.Add(pass.ownAovs);
  }
  EXPECT_GT(MostDifference(PixelsWithAovs(picture, aovs), PixelsWithAovs(own, ownAovs)), .1);
  EXPECT_LT(*sum.Noise(), .5 * *ownSum.Noise());
  EXPECT_NEAR(*unshared.Sum().Noise(), *ownSum.Noise(), 1e-5 * *ownSum.Noise());
  unshared.Replace(&picture, &aovs, &sum);
  EXPECT_LT(MostDifference(PixelsWithAovs(picture, aovs), PixelsWithAovs(own, ownAovs)), 1e-5);
  EXPECT_EQ(*sum.Noise(), *unshared.Sum().Noise());
  EXPECT_EQ(sum.SamplesPerPixel(), 2 * kOwnSamples);
}

// The photon maps have no error here, so all corrections are those of sharing.
TEST(UnsharedPicture, HasNoCorrectionsOfSharing) {
  for (const bool isApart : {false, true}) {
    Corrections corrections(kOwnBounds, 1);
    if (isApart) corrections.KeepSharingApart();
    for (int group = 0; group < 3; ++group) {
      BothPictures pass;
      GatherPass(std::uint64_t(group), &pass, nullptr, &corrections);
      corrections.EndPass(group, kOwnSamples);
    }
    corrections.JoinGroups();
    const auto most = [&] {
      double value = 0;
      for (const double sum : corrections.SumsOf(*corrections.Groups().front()))
        value = std::max(value, std::abs(sum));
      return value;
    };
    EXPECT_GT(most(), .1);
    corrections.UseSharing(false);
    EXPECT_EQ(most() > 0, !isApart);
    corrections.UseSharing(true);
    EXPECT_GT(most(), .1);
  }
}

// Returns whether a render with these options keeps the picture without sharing.
bool IsFollowed(const std::string& options, Corrections* corrections) {
  const LoadedScene scene = LoadSceneText(TestHeader("\"path\"", kOwnSide, kOwnSide, 1) + options +
                                          FurnaceWorld(1, "\"matte\""));
  RenderSetup& setup = *scene.setup;
  Film film(kOwnBounds, kOwnBounds);
  ThreadPool pool(1);
  ProgressReporter progress(ProgressReporter::Mode::Quiet);
  Statistics statistics;
  const RenderJob job{
      *setup.scene, *setup.integrator, *setup.sampler, *setup.filter, *setup.camera, film,
      pool,         *scene.log,        progress,       statistics};
  RenderOptions ofRender;
  ofRender.corrections = corrections;
  PassParts parts(job, ofRender, {});
  PassSum sum(&film, {});
  const auto unshared = UnsharedPicture::Follow(job, &parts, &sum);
  EXPECT_EQ(parts.Options().sharingChange, unshared ? unshared->OfPass() : nullptr);
  return unshared != nullptr;
}

TEST(UnsharedPicture, IsFollowedIfSharedGathersHaveACertificate) {
  const std::string shares = R"(SurfaceIntegrator "exphotonmap" "bool sharedgather" "true" )";
  const std::string doesNot = R"(SurfaceIntegrator "exphotonmap" "bool sharedgather" "false" )";
  const std::string splats = R"(PixelFilter "mitchell" )";
  // Gathers behind a lens are not shared.
  const std::string lens = R"(Camera "perspective" "float lensradius" .1 "float focaldistance" 1 )";
  Corrections corrections(kOwnBounds, 1);
  EXPECT_FALSE(IsFollowed(shares, nullptr));
  EXPECT_FALSE(IsFollowed(doesNot, &corrections));
  EXPECT_FALSE(IsFollowed(shares + splats, &corrections));
  EXPECT_FALSE(IsFollowed(shares + lens, &corrections));
  corrections.AddSharing({1, 1}, Spectrum(1), 1);
  EXPECT_TRUE(IsFollowed(shares, &corrections));
  // From now on the corrections of sharing can be left out.
  corrections.AddSharing({1, 1}, Spectrum(2), 1);
  corrections.EndPass(0, 1);
  const auto sum = [&] {
    return corrections.SumsOf(*corrections.Groups().front())[3 * (kOwnSide + 1)];
  };
  const double all = sum();
  corrections.UseSharing(false);
  EXPECT_EQ(all - sum(), 2);
}

}  // namespace
}  // namespace exphoton
