// SPDX-License-Identifier: BSD-2-Clause
// These tests check surfaces that emit while they move, turn and stretch. Their stated densities
// must match counted samples, and the two ways to compute a density must agree.
#include <gtest/gtest.h>

#include "core/geometry/moving_emitter.h"
#include "core/math/sampling/random.h"
#include "core/math/sampling/sampling.h"
#include "tests/support/test_plugin.h"

namespace exphoton {
namespace {

class MovingEmitterTest : public testing::TestWithParam<const char*> {
 protected:
  MovingEmitterTest() : local_(plugins_.MakeEmitter(GetParam())), emitter_(local_, Movement()) {}

  static Motion Movement() {
    const char* problem = "";
    const Transform start = Transform::Translate({1, 0, 2});
    const Transform end = Transform::Translate({0, 1, 3}) * *Transform::Rotate(70, {1, 2, 3}) *
                          *Transform::Scale(2, Real(.5), Real(1.5));
    return Motion(*AnimatedTransform::Between(start, end, {0, 1}, &problem));
  }

  TestPlugins plugins_;
  std::shared_ptr<const EmitterSurface> local_;
  MovingEmitter emitter_;
};

constexpr int kSamples = 200000;
constexpr double kTolerance = .01;  // at least 4 standard errors

// The mean of 1 / pdf is the measure of the sampled set, which is the surface's area at that time.
TEST_P(MovingEmitterTest, PointsCoverTheAreaOfTheirTime) {
  RandomStream random(1);
  for (const Real time : {Real(0), Real(.4), Real(1)}) {
    double area = 0, truth = 0;
    const Transform at = Movement().At(time);
    for (int i = 0; i < kSamples; ++i) {
      const Real x = random.Uniform(), y = random.Uniform(), part = random.Uniform();
      const EmitterSample sample = emitter_.SamplePoint({x, y}, part, time);
      area += 1 / double(sample.pdf) / kSamples;
      // The expected area comes from the local surface, with two transformed tangents.
      const EmitterSample local = local_->SamplePoint({x, y}, part, time);
      const Frame frame = Frame::FromZ(local.point.ng);
      truth += double(Length(Cross(at.ApplyVector(frame.x), at.ApplyVector(frame.y)))) /
               double(local.pdf) / kSamples;
      EXPECT_LT(Distance(sample.point.p, at.ApplyPoint(local.point.p)), 1e-5);
    }
    EXPECT_NEAR(area, truth, 1e-4 * truth);
  }
}

// The area of the emitter is the mean over the exposure, also where its axes are stretched unevenly
// and where it has faces of several directions.
TEST_P(MovingEmitterTest, ItsAreaIsTheMeanOverTime) {
  RandomStream random(4);
  double mean = 0;
  for (int i = 0; i < kSamples; ++i) {
    const Real x = random.Uniform(), y = random.Uniform(), part = random.Uniform();
    const EmitterSample sample = emitter_.SamplePoint({x, y}, part, random.Uniform());
    mean += 1 / double(sample.pdf) / kSamples;
  }
  EXPECT_NEAR(double(emitter_.Area()), mean, .01 * mean);
}

// The irradiance from directions sampled towards the surface must equal the irradiance from points
// sampled on it.
TEST_P(MovingEmitterTest, DirectionsBringWhatPointsBring) {
  RandomStream random(2);
  SurfacePoint ref;
  ref.p = {Real(.2), Real(-.3), Real(6)};
  ref.ng = {0, 0, 1};
  for (const Real time : {Real(0), Real(.4), Real(1)}) {
    ref.time = time;
    double toward = 0, byArea = 0;
    for (int i = 0; i < kSamples; ++i) {
      const Point2 u(random.Uniform(), random.Uniform());
      const Real part = random.Uniform();
      if (const auto sample = emitter_.SampleToward(ref, u, part)) {
        const Vector3 wi = Normalize(sample->point.p - ref.p);
        if (Dot(sample->point.ng, wi) < 0) toward += double(AbsDot(wi, ref.ng) / sample->pdf);
      }
      const EmitterSample point = emitter_.SamplePoint(u, part, time);
      const Vector3 between = point.point.p - ref.p;
      const Vector3 wi = Normalize(between);
      const Real cosine = -Dot(point.point.ng, wi);
      if (cosine > 0)
        byArea += double(cosine * AbsDot(wi, ref.ng) / (LengthSquared(between) * point.pdf));
    }
    EXPECT_GT(byArea, 0);
    EXPECT_NEAR(toward, byArea, kTolerance * byArea);
  }
}

TEST_P(MovingEmitterTest, TheDensityOfADirectionIsThatWithWhichItIsMade) {
  RandomStream random(3);
  SurfacePoint ref;
  ref.p = {Real(.2), Real(-.3), Real(6)};
  for (int i = 0; i < 1000; ++i) {
    ref.time = random.Uniform();
    const Real x = random.Uniform(), y = random.Uniform();
    const auto sample = emitter_.SampleToward(ref, {x, y}, random.Uniform());
    if (!sample) continue;
    const Vector3 wi = Normalize(sample->point.p - ref.p);
    const double pdf = double(emitter_.PdfToward(ref, wi, sample->point));
    EXPECT_NEAR(pdf, double(sample->pdf), 1e-3 * double(sample->pdf));
    EXPECT_EQ(sample->point.time, ref.time);
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, MovingEmitterTest,
                         testing::Values(R"("sphere" "float radius" .5)",
                                         R"("disk" "float radius" .7)",
                                         R"("cylinder" "float radius" .4)",
                                         R"("sphere" "float radius" .5 "float phimax" 200)",
                                         R"("trianglemesh" "integer indices" [0 1 2 0 3 1 0 2 3]
                                            "point P" [0 0 0 1 0 0 0 1 0 0 0 2])"));

}  // namespace
}  // namespace exphoton
