// SPDX-License-Identifier: BSD-2-Clause
// These tests check fragments of gathers, the regression over them, and the choice of its window.
#include "core/render/sharing/local_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "core/base/error.h"
#include "core/math/sampling/random.h"
#include "core/render/sharing/windows/sharing_windows.h"

namespace exphoton {
namespace {

struct Place {
  Real x, y;  // on the film, in pixels
  Normal3 n;
};
using LightAt = std::function<Spectrum(const Place&, RandomStream*)>;

// Returns the gathers of a picture of the plane z = 0 with four samples a pixel, one of each group.
// One pixel is .01 units wide, and shading normals tilt at random.
GatherFragments PlaneGathers(int size, const LightAt& light, std::uint64_t seed = 1) {
  GatherFragments gathers({0, 0, size, size}, 4);
  RandomStream random(seed);
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      for (int group = 0; group < kGatherGroups; ++group) {
        Place place{Real(x) + random.Uniform(), Real(y) + random.Uniform(), {}};
        place.n = Normalize(Normal3(random.Uniform() - Real(.5), random.Uniform() - Real(.5), 3));
        const GatherRecord record{{place.x / 100, place.y / 100, 0},
                                  place.n,
                                  {0, 0, 1},
                                  light(place, &random),
                                  Spectrum(1)};
        gathers.At({x, y}).Add({record}, {place.x, place.y}, 1, {group});
      }
      gathers.At({x, y}).Finish();
    }
  }
  return gathers;
}

Spectrum Linear(const Place& place, RandomStream*) {
  return {2 + place.x / 20, 4 - place.y / 20, 2 + place.n.x + place.n.y / 2};
}

TEST(LieOnOneSurface, AsksForLikeNormalsAndCommonTangentPlanes) {
  const Normal3 z{0, 0, 1};
  EXPECT_TRUE(LieOnOneSurface({0, 0, 0}, z, {5, 7, 0}, z));
  EXPECT_TRUE(LieOnOneSurface({0, 0, 0}, z, {0, 0, 0}, z));
  EXPECT_TRUE(LieOnOneSurface({0, 0, 0}, z, {1, 0, Real(.09)}, z));
  EXPECT_FALSE(LieOnOneSurface({0, 0, 0}, z, {1, 0, Real(.11)}, z)) << "a step";
  EXPECT_FALSE(LieOnOneSurface({0, 0, 0}, z, {1, 0, 0}, -z)) << "the back";
  EXPECT_FALSE(LieOnOneSurface({0, 0, 0}, z, {1, 0, 0}, {0, Real(.5), Real(.866)})) << "a fold";
  const Normal3 tilted = Normalize(Normal3(Real(.2), 0, 1));
  EXPECT_FALSE(LieOnOneSurface({0, 0, 0}, z, {1, 0, 0}, tilted)) << "beside its tangent plane";
}

TEST(GatherFragments, DivideAPixelByItsSurfacesAndDepths) {
  GatherFragments gathers({4, 4, 5, 5}, 2);
  auto& pixel = gathers.At({4, 4});
  const Normal3 z{0, 0, 1};
  const GatherRecord floor{{0, 0, 0}, z, z, Spectrum(1), Spectrum(1)};
  GatherRecord more = floor, table = floor, reflected = floor;
  more.p = {2, 0, 0};
  more.light = Spectrum(3);
  table.p = {0, 1, 1};
  reflected.depth = 1;
  pixel.Add({floor, reflected}, {4, 4}, 1, {0});
  pixel.Add({table}, {5, 4}, 1, {1});
  pixel.Add({more}, {5, 5}, 1, {0});
  pixel.Finish();
  ASSERT_EQ(pixel.fragments.size(), 3u);
  EXPECT_EQ(pixel.fragments[0].count[0], 2);
  EXPECT_EQ(pixel.fragments[0].count[1], 0);
  EXPECT_EQ(pixel.fragments[0].Mean(0).r, 2);
  EXPECT_EQ(pixel.fragments[0].p.x, 1);
  EXPECT_EQ(pixel.fragments[0].film, Point2(Real(4.5), Real(4.5)));
  EXPECT_EQ(pixel.fragments[2].count[1], 1);
  ASSERT_EQ(pixel.samples.size(), 4u);
  EXPECT_EQ(pixel.samples[1].fragment, 1u);
  EXPECT_EQ(pixel.samples[3].fragment, 0u);
}

TEST(GatherFragments, KeepRowsThatStayWithinTheBounds) {
  GatherFragments gathers = PlaneGathers(8, Linear);
  const Spectrum kept = gathers.At({2, 5}).fragments.at(0).lights[0];
  gathers.MoveDown(4, 10);
  EXPECT_EQ(gathers.Bounds(), (PixelBounds{0, 4, 8, 10}));
  EXPECT_EQ(gathers.At({2, 5}).fragments.at(0).lights[0].g, kept.g);
  for (int y = 8; y < 10; ++y)
    for (int x = 0; x < 8; ++x) EXPECT_TRUE(gathers.At({x, y}).fragments.empty()) << x << ' ' << y;
}

TEST(GatherFragments, DivideDepthsInAnyOrder) {
  GatherFragments gathers({0, 0, 1, 1}, 2);
  auto& pixel = gathers.At({0, 0});
  const Normal3 z{0, 0, 1};
  const GatherRecord floor{{0, 0, 0}, z, z, Spectrum(1), Spectrum(1)};
  GatherRecord reflected = floor;
  reflected.depth = 1;
  pixel.Add({reflected}, {0, 0}, 1, {0});
  pixel.Add({floor, reflected}, {0, 0}, 1, {1});
  pixel.Finish();
  ASSERT_EQ(pixel.fragments.size(), 2u);
  EXPECT_EQ(pixel.fragments[0].depth, 1);
  EXPECT_EQ(pixel.fragments[0].count[0] + pixel.fragments[0].count[1], 2);
  EXPECT_EQ(pixel.fragments[1].depth, 0);
}

TEST(GatherFragments, SayIfMemoryDoesNotSuffice) {
  try {
    GatherFragments({0, 0, 1 << 20, 1 << 20}, 4);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.Status(), ExitStatus::Resource);
    EXPECT_NE(std::string(error.what()).find("set \"sharedgather\" to false"), std::string::npos);
  }
}

TEST(LocalFit, ReproducesLightThatIsLinearInPositionAndTilt) {
  const GatherFragments gathers = PlaneGathers(64, Linear);
  const FragmentRows rows(gathers);
  FitNeighbours neighbours;
  for (const Point2i pixel : {Point2i{32, 32}, Point2i{0, 63}}) {
    const FitTarget target(gathers.At(pixel).fragments[0]);
    for (const FragmentRows::Column set : {FragmentRows::OfGroup(0), FragmentRows::OfGroup(1),
                                           FragmentRows::OfGroup(3), FragmentRows::All}) {
      LocalFit::Collect(rows, {target, pixel, 24}, &neighbours);
      const LocalFit fit(neighbours, 24, set);
      const Place place{target.film.x + Real(.4), target.film.y - Real(.3),
                        Normalize(Normal3(Real(.1), Real(-.1), 1))};
      const Spectrum got = fit.At(target.FeaturesOf({place.x, place.y}, place.n));
      const Spectrum wanted = Linear(place, nullptr);
      // The ridge shrinks slopes by about a hundredth. A fragment has the mean position and normal
      // of all groups, which is like noise for each group alone: its standard deviation is about
      // .02 in the corner.
      const double tolerance = set == FragmentRows::All ? .01 : .05;
      EXPECT_NEAR(got.r, wanted.r, tolerance) << set;
      EXPECT_NEAR(got.g, wanted.g, tolerance) << set;
      EXPECT_NEAR(got.b, wanted.b, tolerance) << set;
    }
  }
}

TEST(LocalFit, ReadsOneGroupOnly) {
  int sample = 0;  // group 2 gets 1, group 3 gets 3, the others get 3
  const GatherFragments gathers = PlaneGathers(
      16, [&](const Place&, RandomStream*) { return Spectrum(sample++ % 4 == 2 ? 1 : 3); });
  const FragmentRows rows(gathers);
  FitNeighbours neighbours;
  const FitTarget target(gathers.At({8, 8}).fragments[0]);
  LocalFit::Collect(rows, {target, {8, 8}, 4}, &neighbours);
  EXPECT_NEAR(LocalFit(neighbours, 4, FragmentRows::OfGroup(2)).AtTarget().g, 1, 1e-4);
  EXPECT_NEAR(LocalFit(neighbours, 4, FragmentRows::OfGroup(3)).AtTarget().g, 3, 1e-4);
  EXPECT_NEAR(LocalFit(neighbours, 4, FragmentRows::All).AtTarget().g, 2.5, 1e-4);
}

TEST(LocalFit, LeavesOtherSurfacesOut) {
  GatherFragments gathers =
      PlaneGathers(16, [](const Place&, RandomStream*) { return Spectrum(1); });
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 16; ++x) {
      if ((x + y) % 2 == 0) continue;
      GatherFragments::Pixel& pixel = gathers.At({x, y});
      for (GatherFragment& fragment : pixel.fragments) {
        fragment.p.z = 1;
        fragment.lights.fill(Spectrum(100));
      }
    }
  }
  const FragmentRows rows(gathers);
  FitNeighbours neighbours;
  const FitTarget target(gathers.At({8, 8}).fragments[0]);
  LocalFit::Collect(rows, {target, {8, 8}, 6}, &neighbours);
  EXPECT_NEAR(LocalFit(neighbours, 6, FragmentRows::All).AtTarget().g, 1, 1e-4);
}

// The plane z = 0 has light 1. Every second pixel has light 100 and is moved and tilted.
Spectrum FitBeside(Real height, const Normal3& ng) {
  GatherFragments gathers =
      PlaneGathers(16, [](const Place&, RandomStream*) { return Spectrum(1); });
  const Point2i center{8, 8};
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 16; ++x) {
      if ((x + y) % 2 == 0) continue;
      GatherFragment& fragment = gathers.At({x, y}).fragments[0];
      const Vector3 away = fragment.p - gathers.At(center).fragments[0].p;
      const Real distance = std::sqrt(away.x * away.x + away.y * away.y);
      fragment.p.z = height * distance;
      fragment.ng = Normalize(Normal3(away.x / distance * ng.x, away.y / distance * ng.x, ng.z));
      fragment.lights.fill(Spectrum(100));
    }
  }
  const FragmentRows rows(gathers);
  FitNeighbours neighbours;
  const FitTarget target(gathers.At(center).fragments[0]);
  LocalFit::Collect(rows, {target, center, 6}, &neighbours);
  return LocalFit(neighbours, 6, FragmentRows::All).AtTarget();
}

TEST(LocalFit, AsksThatEachPointLiesInTheOthersTangentPlane) {
  const Normal3 z{0, 0, 1};
  EXPECT_GT(FitBeside(0, z).g, 10) << "one surface";
  // A cone whose lines pass through the target: the target lies in all its tangent planes.
  EXPECT_NEAR(FitBeside(Real(.2), {Real(-.2), 0, 1}).g, 1, 1e-3) << "beside the target's plane";
  // Tiles of a fan in the plane of the target.
  EXPECT_NEAR(FitBeside(0, {Real(-.2), 0, 1}).g, 1, 1e-3) << "the target beside their planes";
}

// Every third row of the plane is flat: all its shading normals are equal.
GatherFragments PartlyFlatGathers(int size) {
  GatherFragments gathers = PlaneGathers(size, Linear);
  for (int y = 0; y < size; y += 3)
    for (int x = 0; x < size; ++x) gathers.At({x, y}).fragments[0].n = {0, 0, 1};
  return gathers;
}

// Returns the moments of two sets of records in rows 4 to 19, by one SIMD target.
std::array<FitMoments, 2> MomentsBy(const LocalFitLoops& loops, const FragmentRows& rows,
                                    const FitTarget& target, Real radius) {
  FitNeighbours neighbours;
  neighbours.rows = &rows;
  neighbours.radius = 6;
  rows.ForRowsAround({11, 12}, 8,
                     [&](const FragmentRows::Range& range) { neighbours.ranges.push_back(range); });
  neighbours.Reserve(100);
  loops.describe(target, &neighbours);
  std::array<FitMoments, 2> moments;
  loops.accumulate(neighbours, radius, FragmentRows::OfGroup(1), &moments[0]);
  loops.accumulate(neighbours, radius, FragmentRows::All, &moments[1]);
  return moments;
}

TEST(LocalFit, HasTheSameBitsOnAllTargets) {
  const GatherFragments gathers = PartlyFlatGathers(24);
  const FragmentRows rows(gathers);
  for (const Point2i pixel : {Point2i{11, 9}, {12, 10}}) {
    const FitTarget target(gathers.At(pixel).fragments[0]);
    for (const Real radius : {Real(4.5), Real(6)}) {
      const auto wanted = MomentsBy(*LocalFit::Loops().front(), rows, target, radius);
      for (const LocalFitLoops* loops : LocalFit::Loops()) {
        const auto moments = MomentsBy(*loops, rows, target, radius);
        for (std::size_t set = 0; set < moments.size(); ++set) {
          EXPECT_EQ(moments[set].matrix, wanted[set].matrix);
          EXPECT_EQ(moments[set].right, wanted[set].right);
        }
      }
    }
  }
}

TEST(LocalFit, HasTheMomentsOfFlatAndOfTiltedFragments) {
  const GatherFragments gathers = PartlyFlatGathers(24);
  const FragmentRows rows(gathers);
  constexpr double kRadius = 4.5;
  for (const Point2i pixel : {Point2i{11, 9}, {12, 10}}) {  // flat and tilted
    const FitTarget target(gathers.At(pixel).fragments[0]);
    double matrix[kFitFeatures][kFitFeatures] = {}, right[kFitFeatures] = {};
    for (int y = 0; y < 24; ++y) {
      for (int x = 0; x < 24; ++x) {
        const GatherFragment& fragment = gathers.At({x, y}).fragments[0];
        const Point2 d = fragment.film - target.film;
        const double kernel = 1 - double(d.x * d.x + d.y * d.y) / (kRadius * kRadius);
        const FitFeatures u = target.FeaturesOf(fragment.film, fragment.n);
        if (kernel <= 0) continue;
        for (std::size_t i = 0; i < kFitFeatures; ++i) {
          right[i] += kernel * double(u[i] * fragment.Light().g);
          for (std::size_t j = i; j < kFitFeatures; ++j)
            matrix[i][j] += kernel * double(fragment.Count() * u[i] * u[j]);
        }
      }
    }
    const auto moments = MomentsBy(*LocalFit::Loops().back(), rows, target, Real(kRadius))[1];
    std::size_t k = 0;
    for (std::size_t i = 0; i < kFitFeatures; ++i) {
      EXPECT_NEAR(moments.right[i][1], right[i], 1e-4 * moments.right[0][1]) << i;
      for (std::size_t j = i; j < kFitFeatures; ++j)
        EXPECT_NEAR(moments.matrix[k++], matrix[i][j], 1e-4 * moments.matrix[0]) << i << j;
    }
  }
}

// A change of one record at the target changes the fit there by its influence.
TEST(LocalFit, KnowsTheInfluenceOfARecord) {
  for (const Real radius : {Real(2), Real(6)}) {
    GatherFragments gathers = PlaneGathers(32, Linear);
    const auto fit = [&] {
      const FragmentRows rows(gathers);
      FitNeighbours neighbours;
      const GatherFragment& middle = gathers.At({16, 16}).fragments[0];
      LocalFit::Collect(rows, {FitTarget(middle), {16, 16}, radius}, &neighbours);
      return LocalFit(neighbours, radius, FragmentRows::All);
    };
    const LocalFit before = fit();
    gathers.At({16, 16}).fragments[0].lights[0] += Spectrum(8);
    const double change = double(fit().AtTarget()[1] - before.AtTarget()[1]);
    EXPECT_NEAR(change, 8 * before.InfluenceOfRecord(), 1e-4) << radius;
    EXPECT_GT(before.InfluenceOfRecord(), .001) << radius;
  }
}

Spectrum Noisy(Real light, RandomStream* random) { return Spectrum(light * 2 * random->Uniform()); }

SharingWindows::Window WindowAt(const SharingWindows& windows, const GatherFragments& gathers,
                                Point2i pixel) {
  FitNeighbours scratch;
  return windows.At(pixel, FitTarget(gathers.At(pixel).fragments[0]), &scratch);
}

Real RadiusAt(const GatherFragments& gathers, Point2i pixel) {
  ThreadPool threads(1);
  return WindowAt({gathers, FragmentRows(gathers), &threads}, gathers, pixel).radius;
}

TEST(SharingWindows, AreLargeWhereLightIsConstantAndNoisy) {
  const GatherFragments gathers =
      PlaneGathers(48, [](const Place&, RandomStream* random) { return Noisy(1, random); });
  EXPECT_GE(RadiusAt(gathers, {24, 24}), 6);
}

// One gather in ten is bright. The noise of a group's own light hides which window is better there.
TEST(SharingWindows, AreLargeAmongFireflies) {
  const GatherFragments gathers = PlaneGathers(96, [](const Place&, RandomStream* random) {
    return Spectrum(random->Uniform() < Real(.1) ? 10 : 0);
  });
  ThreadPool threads(1);
  const SharingWindows windows(gathers, FragmentRows(gathers), &threads);
  double sum = 0;
  int count = 0;
  for (int y = 24; y < 72; y += 4)
    for (int x = 24; x < 72; x += 4, ++count)
      sum += double(WindowAt(windows, gathers, {x, y}).radius);
  EXPECT_GT(sum / count, 7);
}

TEST(SharingWindows, AreZeroWhereLightChangesQuickly) {
  // Stripes of four pixels, whose edges lie beside each place where windows are judged
  const GatherFragments gathers = PlaneGathers(48, [](const Place& place, RandomStream* random) {
    return Spectrum((int(place.x) / 4 % 2 == 0 ? 1 : 3) + Real(.1) * random->Uniform());
  });
  ThreadPool threads(1);
  const SharingWindows windows(gathers, FragmentRows(gathers), &threads);
  EXPECT_EQ(WindowAt(windows, gathers, {24, 24}).share, 0);
}

TEST(SharingWindows, DoNotReachBeyondTheirMargin) {
  const auto light = [](const Place& place, RandomStream* random) {
    return Noisy(1 + place.x / 50, random);
  };
  GatherFragments gathers = PlaneGathers(96, light);
  const auto radius = [&] { return RadiusAt(gathers, {48, 48}); };
  const Real before = radius();
  for (int y = 0; y < 96; ++y)
    for (int x = 0; x < 96; ++x)
      if (std::max(std::abs(x - 48), std::abs(y - 48)) > SharingWindows::kReach)
        for (GatherFragment& fragment : gathers.At({x, y}).fragments)
          for (int group = 0; group < kGatherGroups; ++group)
            fragment.lights[std::size_t(group)] = Spectrum(Real(x * y % (5 + group)));
  EXPECT_EQ(radius(), before);
}

// The largest reach goes over samples at the edges of their pixels: the window of pixel 50 is
// blended with the one at pixel 56, which is chosen by errors at pixel 68, whose fit holds
// pixel 76.
TEST(SharingWindows, DependOnGathersAtADistanceOf26Pixels) {
  GatherFragments gathers = PlaneGathers(
      96, [](const Place&, RandomStream* random) { return Noisy(1, random); }, 3);
  const auto fragment = [&](int x) -> GatherFragment& { return gathers.At({x, 48}).fragments[0]; };
  for (const auto& [x, film] : {std::pair{50, 50.95}, {56, 56.5}, {68, 68.05}, {76, 76.05}})
    fragment(x).film.x = Real(film);
  const auto radius = [&] { return RadiusAt(gathers, {50, 48}); };
  const Real before = radius();
  for (Spectrum& light : fragment(76).lights) light = Spectrum(100000);
  EXPECT_NE(radius(), before);
  EXPECT_GE(SharingWindows::kReach, 26);
}

}  // namespace
}  // namespace exphoton
