// SPDX-License-Identifier: BSD-2-Clause
// These tests check the guiding distributions of other authors, Jensen's histogram and the
// footprints of Hey and Purgathofer: samples against densities, by a chi-square test, and
// degenerate photons. Each test of a density has a false-alarm rate of 1 % over four tests.
#include "integrators/photon/gather/densities/guide_density.h"

#include <gtest/gtest.h>

#include "core/math/sampling/random.h"
#include "tests/support/chi_square.h"

namespace exphoton {
namespace {

const Normal3 kNormal = Normalize(Normal3(1, 2, 2));

// Half of the photons come from a small patch, the others from the whole hemisphere about the
// normal, or from both sides of the surface.
ConeDirections Photons(std::size_t count, bool isTwoSided, Arena* arena) {
  RandomStream random(7);
  ConeDirections axes(count, arena);
  const Frame frame = Frame::FromZ(Vector3(kNormal));
  const Frame patch = Frame::FromZ(Normalize(Vector3(0, 1, 2)));
  for (std::size_t i = 0; i < count; ++i) {
    const Point2 u{random.Uniform(), random.Uniform()};
    const bool isBelow = isTwoSided && i % 3 == 0;
    const Vector3 w = i % 2 == 0 ? patch.ToWorld(SampleUniformCone(u, Real(.02)))
                                 : frame.ToWorld(SampleCosineHemisphere(u));
    axes.Add(isBelow ? -w : w);
  }
  axes.Finish();
  return axes;
}

template <class Distribution>
void ExpectThatSamplesFit(const Distribution& distribution) {
  const auto sample = [&](RandomStream& random) -> std::optional<Vector3> {
    const Real pick = random.Uniform(), x = random.Uniform();
    const auto drawn = distribution.Draw(pick, {x, random.Uniform()});
    EXPECT_GT(drawn.pdf, 0);
    EXPECT_NEAR(double(drawn.pdf), double(distribution.Pdf(drawn.w)), .02 * double(drawn.pdf))
        << "the density of a draw";
    return drawn.w;
  };
  const auto pdf = [&](const Vector3& w) { return double(distribution.Pdf(w)); };
  ChiSquareOptions options;
  options.quadratureDepth = 6;
  const ChiSquareResult result = TestDirections({Vector3(kNormal), 2}, sample, pdf, options);
  EXPECT_TRUE(FitsDensity(result, 4));
  EXPECT_NEAR(result.mass, 1, .005);
}

DirectionHistogram Histogram(const ConeDirections& axes) {
  DirectionHistogram histogram(kNormal);
  for (std::size_t i = 0; i < axes.size(); ++i) histogram.Add(axes[i]);
  return histogram;
}

TEST(DirectionHistogram, HasTheDensityOfItsSamples) {
  Arena arena;
  ExpectThatSamplesFit(Histogram(Photons(50, false, &arena)));
  ExpectThatSamplesFit(Histogram(Photons(50, true, &arena)));
}

TEST(PhotonFootprints, HaveTheDensityOfTheirSamples) {
  Arena arena;
  ExpectThatSamplesFit(PhotonFootprints(Photons(50, false, &arena), &arena));
  ExpectThatSamplesFit(PhotonFootprints(Photons(12, true, &arena), &arena));
}

TEST(PhotonFootprints, AreNarrowWherePhotonsAreDense) {
  Arena arena;
  const PhotonFootprints prints(Photons(200, false, &arena), &arena);
  // Half of the photons lie in .02 of 2, so the density there is about 50 times the mean.
  EXPECT_GT(prints.Pdf(Normalize(Vector3(0, 1, 2))), Real(.25) / (2 * kPi * Real(.02)));
}

TEST(GuideDensity, OfOnePhotonOrOfEqualPhotonsIsFinite) {
  for (const std::size_t count : {1, 2, 40}) {
    Arena arena;
    ConeDirections axes(count, &arena);
    for (std::size_t i = 0; i < count; ++i) axes.Add(Vector3(kNormal));
    axes.Finish();
    const PhotonFootprints prints(axes, &arena);
    const DirectionHistogram histogram = Histogram(axes);
    RandomStream random(1);
    for (int i = 0; i < 100; ++i) {
      const Point2 u{random.Uniform(), random.Uniform()};
      for (const auto& drawn :
           {prints.Draw(random.Uniform(), u), histogram.Draw(random.Uniform(), u)}) {
        EXPECT_TRUE(drawn.pdf > 0 && std::isfinite(drawn.pdf));
        EXPECT_NEAR(double(Length(drawn.w)), 1, 1e-4);
      }
    }
  }
}

}  // namespace
}  // namespace exphoton
