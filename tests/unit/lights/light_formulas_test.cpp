// SPDX-License-Identifier: BSD-2-Clause
// These tests compare what every light samples with closed forms, for lights that are turned, moved
// and scaled: direction, radiance by channel, densities, shadow rays, photons, times and
// properties.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "core/geometry/ray.h"
#include "core/geometry/shape.h"
#include "core/lights/light.h"
#include "core/math/sampling/random.h"
#include "tests/support/test_plugin.h"

namespace exphoton {
namespace {

constexpr Real kTime = Real(.37);
const Sphere3 kWorld{{Real(.5), -1, 2}, 9};
const double kWorldDisk = M_PI * 81;

// Turns, doubles and moves.
Transform Placed() {
  return Transform::Translate({1, -2, 3}) * *Transform::Rotate(40, {1, 2, 3}) *
         *Transform::Scale(2, 2, 2);
}

void ExpectClose(const Vector3& a, const Vector3& b, double tolerance = 2e-5) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(double(a[i]), double(b[i]), tolerance) << "axis " << i;
}

void ExpectClose(const Spectrum& a, const Spectrum& b, double relative = 1e-4) {
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(double(a[c]), double(b[c]), relative * double(b[c]) + 1e-12) << "channel " << c;
  }
}

Point2 Random2(RandomStream& random) {
  const Real x = random.Uniform();
  return {x, random.Uniform()};
}

SurfacePoint RandomReceiver(RandomStream& random) {
  const auto between = [&] { return 8 * random.Uniform() - 4; };
  const Real x = between(), y = between();
  return {{x, y, between()}, {}, {0, 1, 0}, kTime};
}

// A direction uniform on the sphere: cos = 1 - 2 u.x about z, azimuth 2 pi u.y.
Vector3 SphereDirection(Point2 u) {
  const double z = 1 - 2 * double(u.x), r = std::sqrt(std::max(1 - z * z, 0.));
  const double phi = 2 * M_PI * double(u.y);
  return {Real(r * std::cos(phi)), Real(r * std::sin(phi)), Real(z)};
}

// The radius of a point of the concentric map of the square to the disk.
double DiskRadius(Point2 u) {
  return std::max(std::abs(2 * double(u.x) - 1), std::abs(2 * double(u.y) - 1));
}

// A shadow ray from the receiver that ends just before `end`.
void ExpectReaches(const Ray& ray, const SurfacePoint& from, const Point3& end) {
  ExpectClose(ray.o - from.p, Vector3(), 1e-4);
  ExpectClose(ray(ray.tMax) - end, Vector3(), 1e-3);
  EXPECT_EQ(ray.time, kTime);
}

void ExpectEscapes(const Ray& ray, const SurfacePoint& from, const Vector3& wi) {
  ExpectClose(ray.o - from.p, Vector3(), 1e-4);
  ExpectClose(ray.d, wi);
  EXPECT_EQ(ray.tMax, kInfinity);
  EXPECT_EQ(ray.time, kTime);
}

// A photon that starts on the disk that covers the world, just outside its sphere.
void ExpectStartsOnDisk(const LightLeSample& sample, Point2 uPosition, const Vector3& toLight) {
  ExpectClose(sample.ray.d, -toLight);
  EXPECT_EQ(sample.ray.tMax, kInfinity);
  EXPECT_EQ(sample.ray.time, kTime);
  const Vector3 offset = sample.ray.o - kWorld.center;
  EXPECT_NEAR(double(Dot(offset, toLight)), 9 * 1.001, 1e-4);
  const Vector3 across = offset - toLight * Dot(offset, toLight);
  EXPECT_NEAR(double(Length(across)), 9 * DiskRadius(uPosition), 1e-4);
  EXPECT_NEAR(double(sample.pdfPosition), 1 / kWorldDisk, 1e-6);
}

TEST(LightFormulas, OfAPoint) {
  TestPlugins plugins;
  const auto light = plugins.MakeLight(
      R"("point" "color I" [8 4 2] "color scale" [.5 3 2] "point from" [.3 .4 .5])", Placed());
  light->Prepare(kWorld);
  const Spectrum intensity(4, 12, 4);
  const Point3 position = Placed().ApplyPoint({Real(.3), Real(.4), Real(.5)});
  EXPECT_TRUE(light->IsDelta());
  EXPECT_FALSE(light->IsInfinite() || light->IsDistant() || light->IsProvablyBlack());
  EXPECT_EQ(light->SampleCount(), 1);
  ExpectClose(light->Power(), intensity * (4 * kPi));
  ASSERT_TRUE(light->Bounds());
  EXPECT_EQ(light->Bounds()->min, position);
  EXPECT_EQ(light->Bounds()->max, position);
  EXPECT_EQ(light->Le({0, 0, 1}), Spectrum());
  RandomStream random(1);
  for (int i = 0; i < 50; ++i) {
    const SurfacePoint at = RandomReceiver(random);
    const auto direct = light->SampleDirect(at, Random2(random), random.Uniform());
    ASSERT_TRUE(direct);
    const Vector3 to = position - at.p;
    ExpectClose(direct->wi, to / Length(to));
    ExpectClose(direct->Li, intensity / LengthSquared(to));
    EXPECT_EQ(direct->pdf, 1);
    ExpectReaches(direct->shadowRay, at, position);
    EXPECT_EQ(light->PdfDirect(at, direct->wi, nullptr), 0);
    const Point2 u = Random2(random);
    const auto emitted = light->SampleEmission(Random2(random), u, random.Uniform(), kTime);
    ASSERT_TRUE(emitted);
    EXPECT_EQ(emitted->ray.o, position);
    ExpectClose(emitted->ray.d, SphereDirection(u));
    EXPECT_EQ(emitted->ray.time, kTime);
    EXPECT_EQ(emitted->ray.tMax, kInfinity);
    EXPECT_EQ(emitted->power, light->Power());
    EXPECT_EQ(emitted->pdfPosition, 1);
    EXPECT_NEAR(double(emitted->pdfDirection), 1 / (4 * M_PI), 1e-7);
    const auto pdf = light->PdfEmission({}, emitted->ray.d);
    EXPECT_EQ(pdf.position, 0);
    EXPECT_EQ(pdf.direction, emitted->pdfDirection);
  }
}

// The least squared distance is (2^-20 max coordinate)^2, between 2^-50 and 2^-20 world radii.
TEST(LightFormulas, OfTheLeastDistanceOfAPoint) {
  TestPlugins plugins;
  for (const char* name : {"\"point\"", "\"spot\" \"point to\" [4 0 -1]"}) {
    const auto light = plugins.MakeLight(std::string(name) + " \"point from\" [4 0 0]");
    const auto at = [&](Real radius) {
      light->Prepare({{0, 0, 0}, radius});
      const auto sample = light->SampleDirect({{4, 0, Real(-1e-7)}, {}, {0, 0, 1}}, {}, 0);
      return sample ? double(sample->Li.g) : 0.;
    };
    EXPECT_NEAR(at(16) * std::pow(4 * std::exp2(-20), 2), 1, 1e-5) << name;
    EXPECT_NEAR(at(1) * std::pow(std::exp2(-20), 2), 1, 1e-5) << name;
    EXPECT_NEAR(at(Real(std::exp2(34))) * std::pow(std::exp2(-16), 2), 1, 1e-5) << name;
  }
}

// The falloff by the angle to the axis, in double.
double Falloff(double degrees, double total, double delta) {
  const auto cosine = [](double a) { return std::cos(a * M_PI / 180); };
  if (degrees <= total - delta) return 1;
  if (degrees >= total) return 0;
  return std::pow((cosine(degrees) - cosine(total)) / (cosine(total - delta) - cosine(total)), 4);
}

void ExpectSpotEmits(const Light& light, const Point3& position, Point2 uDirection) {
  const auto emitted = light.SampleEmission({}, uDirection, 0, kTime);
  ASSERT_TRUE(emitted);
  EXPECT_EQ(emitted->ray.o, position);
  EXPECT_EQ(emitted->ray.time, kTime);
  EXPECT_EQ(emitted->ray.tMax, kInfinity);
  EXPECT_EQ(emitted->pdfPosition, 1);
  ExpectClose(emitted->power, light.Power());
  EXPECT_NEAR(double(emitted->pdfDirection),
              double(light.PdfEmission({}, emitted->ray.d).direction), 2e-4);
}

TEST(LightFormulas, OfASpot) {
  TestPlugins plugins;
  const auto light = plugins.MakeLight(
      R"("spot" "color I" [8 4 2] "color scale" [.5 3 2] "point from" [.3 .4 .5]
         "point to" [1 2 1] "float coneangle" 70 "float conedeltaangle" 40)",
      Placed());
  light->Prepare(kWorld);
  const Spectrum intensity(4, 12, 4);
  const Point3 position = Placed().ApplyPoint({Real(.3), Real(.4), Real(.5)});
  const Vector3 axis = Normalize(Placed().ApplyPoint({1, 2, 1}) - position);
  const double inner = 1 - std::cos(30 * M_PI / 180), outer = 1 - std::cos(70 * M_PI / 180);
  const double solidAngle = 2 * M_PI * (inner + (outer - inner) / 5);
  EXPECT_TRUE(light->IsDelta());
  EXPECT_FALSE(light->IsInfinite() || light->IsDistant());
  ExpectClose(light->Power(), intensity * Real(solidAngle));
  ASSERT_TRUE(light->Bounds());
  EXPECT_EQ(light->Bounds()->min, position);
  RandomStream random(2);
  int lit = 0;
  for (int i = 0; i < 200; ++i) {
    const SurfacePoint at = RandomReceiver(random);
    const Vector3 to = position - at.p;
    const Vector3 wi = to / Length(to);
    const double angle = std::acos(std::clamp(-double(Dot(wi, axis)), -1., 1.)) * 180 / M_PI;
    const double falloff = Falloff(angle, 70, 40);
    const auto direct = light->SampleDirect(at, {}, 0);
    EXPECT_NEAR(double(light->PdfEmission({}, -wi).direction), falloff / solidAngle, 1e-4);
    EXPECT_EQ(light->PdfDirect(at, wi, nullptr), 0);
    if (falloff == 0) {
      EXPECT_FALSE(direct);
    }
    if (!direct) continue;
    ++lit;
    ExpectClose(direct->wi, wi);
    ExpectClose(direct->Li, intensity * (Real(falloff) / LengthSquared(to)), 2e-3);
    EXPECT_EQ(direct->pdf, 1);
    ExpectReaches(direct->shadowRay, at, position);
    ExpectSpotEmits(*light, position, Random2(random));
  }
  EXPECT_GT(lit, 10);
  EXPECT_EQ(light->PdfEmission({}, axis).position, 0);
}

TEST(LightFormulas, OfASpotWithoutParameters) {
  TestPlugins plugins;
  const auto light = plugins.MakeLight("\"spot\"");
  light->Prepare(kWorld);
  for (const double degrees : {0., 24.5, 26., 28., 29.5, 30.5}) {
    const double a = degrees * M_PI / 180;
    const auto direct =
        light->SampleDirect({{Real(std::sin(a)), 0, Real(std::cos(a))}, {}, {}}, {}, 0);
    EXPECT_NEAR(direct ? double(direct->Li.g) : 0, Falloff(degrees, 30, 5), 1e-4) << degrees;
  }
}

TEST(LightFormulas, OfADistantLight) {
  TestPlugins plugins;
  const auto light = plugins.MakeLight(
      R"("distant" "color L" [8 4 2] "color scale" [.5 3 2] "point from" [1 2 0]
         "point to" [0 0 -1])",
      Placed());
  light->Prepare(kWorld);
  const Spectrum irradiance(4, 12, 4);
  const Vector3 toLight = Normalize(Placed().ApplyVector({1, 2, 1}));
  EXPECT_TRUE(light->IsDelta() && light->IsDistant());
  EXPECT_FALSE(light->IsInfinite() || light->Bounds());
  ExpectClose(light->Power(), irradiance * Real(kWorldDisk));
  EXPECT_EQ(light->Le(toLight), Spectrum());
  RandomStream random(3);
  for (int i = 0; i < 50; ++i) {
    const SurfacePoint at = RandomReceiver(random);
    const auto direct = light->SampleDirect(at, Random2(random), random.Uniform());
    ASSERT_TRUE(direct);
    ExpectClose(direct->wi, toLight);
    EXPECT_EQ(direct->Li, irradiance);
    EXPECT_EQ(direct->pdf, 1);
    ExpectEscapes(direct->shadowRay, at, toLight);
    EXPECT_EQ(light->PdfDirect(at, toLight, nullptr), 0);
    const Point2 u = Random2(random);
    const auto emitted = light->SampleEmission(u, Random2(random), random.Uniform(), kTime);
    ASSERT_TRUE(emitted);
    ExpectStartsOnDisk(*emitted, u, toLight);
    ExpectClose(emitted->power, light->Power());
    EXPECT_EQ(emitted->pdfDirection, 1);
    const auto pdf = light->PdfEmission({}, -toLight);
    EXPECT_EQ(pdf.position, emitted->pdfPosition);
    EXPECT_EQ(pdf.direction, 0);
  }
  light->Prepare({});
  EXPECT_EQ(light->PdfEmission({}, -toLight).position, 0);
}

TEST(LightFormulas, OfAUniformSky) {
  TestPlugins plugins;
  const auto light = plugins.MakeLight(
      R"("infinite" "color L" [8 4 2] "color scale" [.5 3 2] "integer nsamples" 7)", Placed());
  light->Prepare(kWorld);
  const Spectrum radiance(4, 12, 4);
  EXPECT_TRUE(light->IsInfinite() && light->IsDistant());
  EXPECT_FALSE(light->IsDelta() || light->Bounds());
  EXPECT_EQ(light->SampleCount(), 7);
  EXPECT_EQ(plugins.MakeLight("\"infinite\"")->SampleCount(), 1);
  ExpectClose(light->Power(), radiance * Real(4 * M_PI * kWorldDisk));
  RandomStream random(4);
  for (int i = 0; i < 50; ++i) {
    const SurfacePoint at = RandomReceiver(random);
    const auto direct = light->SampleDirect(at, Random2(random), random.Uniform());
    ASSERT_TRUE(direct);
    EXPECT_EQ(direct->Li, radiance);
    EXPECT_EQ(light->Le(direct->wi), radiance);
    EXPECT_NEAR(double(direct->pdf), 1 / (4 * M_PI), 1e-6);
    ExpectEscapes(direct->shadowRay, at, direct->wi);
    EXPECT_EQ(light->PdfDirect(at, direct->wi, nullptr), direct->pdf);
    EXPECT_EQ(light->PdfDirect(at, direct->wi, &at), 0) << "a surface is in front of the sky";
    const Point2 u = Random2(random);
    const auto emitted = light->SampleEmission(u, Random2(random), random.Uniform(), kTime);
    ASSERT_TRUE(emitted);
    ExpectStartsOnDisk(*emitted, u, -emitted->ray.d);
    EXPECT_NEAR(double(emitted->pdfDirection), 1 / (4 * M_PI), 1e-6);
    ExpectClose(emitted->power, light->Power());
    const auto pdf = light->PdfEmission({}, emitted->ray.d);
    EXPECT_EQ(pdf.position, emitted->pdfPosition);
    EXPECT_NEAR(double(pdf.direction), double(emitted->pdfDirection), 1e-7);
  }
}

// A disk of radius 1.5 whose normal is turned and which is doubled: its area is 9 pi.
class LampFormulas : public testing::Test {
 protected:
  LampFormulas() { light->Prepare(kWorld); }

  TestPlugins plugins;
  std::shared_ptr<const EmitterSurface> surface =
      plugins.MakeEmitter(R"("disk" "float radius" 1.5)", Placed());
  std::unique_ptr<AreaLight> light = plugins.MakeAreaLight(
      R"("area" "color L" [8 4 2] "color scale" [.5 3 2] "integer nsamples" 7)", surface);
  const Spectrum radiance{4, 12, 4};
  const double area = 9 * M_PI;
  RandomStream random{5};
};

TEST_F(LampFormulas, AreThoseOfItsSurface) {
  EXPECT_FALSE(light->IsDelta() || light->IsInfinite() || light->IsDistant());
  EXPECT_EQ(light->SampleCount(), 7);
  EXPECT_EQ(plugins.MakeAreaLight("\"area\"", surface)->SampleCount(), 1);
  EXPECT_EQ(plugins.MakeAreaLight("\"area\"", surface)->L({{}, {}, {0, 0, 1}}, {}, {0, 0, 1}),
            Spectrum(1));
  ExpectClose(light->Power(), radiance * Real(M_PI * area));
  ASSERT_TRUE(light->Bounds());
  EXPECT_EQ(light->Bounds()->min, surface->Bounds().min);
  EXPECT_EQ(light->Bounds()->max, surface->Bounds().max);
}

TEST_F(LampFormulas, EmitByTheCosine) {
  for (int i = 0; i < 100; ++i) {
    const Point2 uPosition = Random2(random), uDirection = Random2(random);
    const Real part = random.Uniform();
    const auto emitted = light->SampleEmission(uPosition, uDirection, part, kTime);
    ASSERT_TRUE(emitted);
    const SurfacePoint on = surface->SamplePoint(uPosition, part, kTime).point;
    ExpectClose(emitted->ray.o - on.p, Vector3(), 1e-4);
    EXPECT_EQ(emitted->ray.time, kTime);
    EXPECT_EQ(emitted->ray.tMax, kInfinity);
    ExpectClose(emitted->power, light->Power());
    EXPECT_NEAR(double(emitted->pdfPosition), 1 / area, 1e-6);
    const double cosine = double(Dot(emitted->ray.d, Vector3(on.ng)));
    EXPECT_NEAR(cosine, std::sqrt(std::max(1 - std::pow(DiskRadius(uDirection), 2), 0.)), 2e-3);
    EXPECT_NEAR(double(emitted->pdfDirection), cosine / M_PI, 1e-4);
    const auto pdf = light->PdfEmission(on, emitted->ray.d);
    EXPECT_NEAR(double(pdf.position), 1 / area, 1e-6);
    EXPECT_NEAR(double(pdf.direction), cosine / M_PI, 1e-4);
    EXPECT_EQ(light->PdfEmission(on, -emitted->ray.d).direction, 0);
  }
}

TEST_F(LampFormulas, SampleTheLampFromAPoint) {
  int lit = 0, outside = 0;
  for (int i = 0; i < 100; ++i) {
    const Point2 u = Random2(random);
    const Real part = random.Uniform();
    SurfacePoint at = RandomReceiver(random);
    at.p = at.p * 4;  // mostly outside the lamp's box
    const auto direct = light->SampleDirect(at, u, part);
    const auto sample = surface->SampleToward(at, u, part);
    if (!direct) continue;
    ++lit;
    ASSERT_TRUE(sample);
    EXPECT_EQ(direct->Li, radiance);
    EXPECT_EQ(direct->pdf, sample->pdf);
    const Vector3 to = sample->point.p - at.p;
    ExpectClose(direct->wi, to / Length(to));
    const double facing = -double(Dot(Vector3(sample->point.ng), direct->wi));
    EXPECT_GT(facing, 0);
    EXPECT_NEAR(double(direct->pdf) * facing * area / double(LengthSquared(to)), 1, 1e-3);
    ExpectReaches(direct->shadowRay, at, sample->point.p);
    EXPECT_NEAR(double(light->PdfDirect(at, direct->wi, &sample->point) / direct->pdf), 1, 1e-3);
    EXPECT_EQ(light->PdfDirect(at, direct->wi, nullptr), 0);
    EXPECT_TRUE(light->MayMeet(SpawnRay(at, direct->wi)));
    if (light->Bounds()->Contains(at.p)) continue;
    ++outside;
    EXPECT_FALSE(light->MayMeet(SpawnRay(at, -direct->wi)));
    Ray before = SpawnRay(at, direct->wi);
    before.tMax = Real(1e-3);
    EXPECT_FALSE(light->MayMeet(before));
  }
  EXPECT_GT(lit, 20);
  EXPECT_GT(outside, 20);
}

}  // namespace
}  // namespace exphoton
