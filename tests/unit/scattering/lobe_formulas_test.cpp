// SPDX-License-Identifier: BSD-2-Clause
// These tests compare lobes, Fresnel terms and phase functions with their formulas, computed in
// double from angles instead of vectors, at random directions on both sides.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "core/math/sampling/random.h"
#include "core/math/sampling/sampling.h"
#include "core/scattering/lobes/fresnel_blend.h"
#include "core/scattering/lobes/lambert.h"
#include "core/scattering/lobes/microfacet.h"
#include "core/scattering/lobes/oren_nayar.h"
#include "core/scattering/lobes/specular.h"
#include "core/scattering/lobes/transmitted.h"
#include "core/scattering/medium.h"

namespace exphoton {
namespace {

const Spectrum kColor(Real(.9), Real(.5), Real(.1));

// Geometry has the angles of a pair of directions on one side of the surface, and of their half
// vector.
struct Geometry {
  double cosO, cosI, cosH, toHalf;  // to the normal; toHalf: wo to the half vector
  double azimuth, halfAzimuth;      // azimuth: between both directions
};

struct Pair {
  Vector3 wo, wi;
  Geometry g;
};

std::array<double, 3> FromAngles(double theta, double phi) {
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

// The cosines are at least .05, where float has enough digits.
Pair RandomPair(RandomStream& random) {
  const auto theta = [&] { return std::acos(.05 + .95 * double(random.Uniform())); };
  const auto phi = [&] { return 2 * M_PI * double(random.Uniform()); };
  const double thetaO = theta(), thetaI = theta(), phiO = phi(), phiI = phi();
  const auto o = FromAngles(thetaO, phiO), i = FromAngles(thetaI, phiI);
  const double h[3] = {o[0] + i[0], o[1] + i[1], o[2] + i[2]};
  const double length = std::sqrt(h[0] * h[0] + h[1] * h[1] + h[2] * h[2]);
  Geometry g;
  g.cosO = o[2], g.cosI = i[2], g.cosH = h[2] / length;
  g.toHalf = (o[0] * h[0] + o[1] * h[1] + o[2] * h[2]) / length;
  g.azimuth = phiO - phiI;
  g.halfAzimuth = std::atan2(h[1], h[0]);
  return {{Real(o[0]), Real(o[1]), Real(o[2])}, {Real(i[0]), Real(i[1]), Real(i[2])}, g};
}

// Calls expected(geometry, channel) for the value and pdf(geometry) for the density of wi.
template <class Value, class Density>
void ExpectFormulas(const Bxdf& lobe, const Value& expected, const Density& pdf) {
  RandomStream random(11);
  for (int k = 0; k < 300; ++k) {
    const Pair pair = RandomPair(random);
    // Lobes are symmetric about the surface, except for Fresnel's terms.
    for (const Real side : {Real(1), Real(-1)}) {
      const Vector3 wo = pair.wo * side, wi = pair.wi * side;
      const Spectrum f = lobe.f(wo, wi);
      for (int c = 0; c < 3; ++c) {
        const double truth = expected(pair.g, c);
        ASSERT_NEAR(double(f[c]), truth, 1e-3 * truth + 1e-12) << k << " channel " << c;
      }
      const double density = pdf(pair.g);
      ASSERT_NEAR(double(lobe.Pdf(wo, wi)), density, 1e-3 * density + 1e-12) << k;
    }
  }
}

double CosinePdf(const Geometry& g) { return g.cosI / M_PI; }

// Snell's law by angles and Fresnel's equations as sines and tangents of sums.
double Dielectric(double cosI, double etaI, double etaT) {
  const double i = std::acos(cosI), sinT = std::sin(i) * etaI / etaT;
  if (sinT >= 1) return 1;
  if (i < 1e-4) return std::pow((etaI - etaT) / (etaI + etaT), 2);
  const double t = std::asin(sinT);
  const double s = std::sin(i - t) / std::sin(i + t), p = std::tan(i - t) / std::tan(i + t);
  return (s * s + p * p) / 2;
}

// Cook and Torrance's conductor, as |r|^2 of both polarisations with complex index eta - i k:
// perpendicular ((eta - c)^2 + k^2) / ((eta + c)^2 + k^2), parallel with 1 / c for c.
double Conductor(double c, double eta, double k) {
  const auto r = [&](double x) {
    return ((eta - x) * (eta - x) + k * k) / ((eta + x) * (eta + x) + k * k);
  };
  return (r(c) + r(1 / c)) / 2;
}

TEST(LobeFormulas, OfLambert) {
  ExpectFormulas(
      Lambert(kColor), [](const Geometry&, int c) { return double(kColor[c]) / M_PI; }, CosinePdf);
}

// Oren and Nayar 1994, eq. 30.
TEST(LobeFormulas, OfOrenNayar) {
  for (const double sigma : {.1, .4, 1.2}) {
    const double s2 = sigma * sigma;
    const double a = 1 - .5 * s2 / (s2 + .33), b = .45 * s2 / (s2 + .09);
    ExpectFormulas(
        OrenNayar(kColor, Real(sigma)),
        [&](const Geometry& g, int c) {
          const double o = std::acos(g.cosO), i = std::acos(g.cosI);
          const double rough = std::max(0., std::cos(g.azimuth)) * std::sin(std::max(o, i)) *
                               std::tan(std::min(o, i));
          return double(kColor[c]) / M_PI * (a + b * rough);
        },
        CosinePdf);
  }
}

double BlinnD(double cosH, double e) { return (e + 2) / (2 * M_PI) * std::pow(cosH, e); }

template <class F>
double TorranceSparrow(const Geometry& g, double exponent, const F& fresnel) {
  const double masking =
      std::min({1., 2 * g.cosH * g.cosO / g.toHalf, 2 * g.cosH * g.cosI / g.toHalf});
  return fresnel(g.toHalf) * BlinnD(g.cosH, exponent) * masking / (4 * g.cosO * g.cosI);
}

TEST(LobeFormulas, OfMicrofacets) {
  const Spectrum eta(Real(.2), Real(.9), Real(1.1)), k(Real(3.9), Real(2.5), Real(2.1));
  for (const double e : {.5, 10., 100.}) {
    const auto pdf = [&](const Geometry& g) { return BlinnD(g.cosH, e) * g.cosH / (4 * g.toHalf); };
    const auto check = [&](const Fresnel& fresnel, const auto& formula) {
      ExpectFormulas(
          Microfacet(kColor, fresnel, Real(e)),
          [&](const Geometry& g, int c) {
            return double(kColor[c]) *
                   TorranceSparrow(g, e, [&](double cosine) { return formula(cosine, c); });
          },
          pdf);
    };
    check(Fresnel::None(), [](double, int) { return 1.; });
    check(Fresnel::Dielectric(1, Real(1.5)),
          [](double cosine, int) { return Dielectric(cosine, 1, 1.5); });
    check(Fresnel::Dielectric(Real(1.5), Real(1.25)),
          [](double cosine, int) { return Dielectric(cosine, 1.5, 1.25); });
    check(Fresnel::Conductor(eta, k),
          [&](double cosine, int c) { return Conductor(cosine, double(eta[c]), double(k[c])); });
  }
}

// Ashikhmin and Shirley 2000, eq. 5.
TEST(LobeFormulas, OfTheBaseUnderACoat) {
  const Spectrum ks(Real(.2), Real(.4), Real(.7));
  ExpectFormulas(
      BlendedDiffuse(kColor, ks),
      [&](const Geometry& g, int c) {
        return 28 / (23 * M_PI) * double(kColor[c]) * (1 - double(ks[c])) *
               (1 - std::pow(1 - g.cosI / 2, 5)) * (1 - std::pow(1 - g.cosO / 2, 5));
      },
      CosinePdf);
  const Spectrum rho = BlendedDiffuse(kColor, ks).Rho();
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(double(rho[c]), 23. / 28 * double(kColor[c]) * (1 - double(ks[c])), 1e-6);
}

// The albedo is read from a table. Here it is the mean of the samples' throughput over directions
// of view that are distributed by their cosine.
TEST(LobeFormulas, OfTheAlbedoOfACoat) {
  const Spectrum gloss(Real(.04), Real(.5), Real(.96));
  for (const Real exponent : {Real(3), Real(40), Real(700)}) {
    const BlendedGloss coat(gloss, exponent, exponent);
    RandomStream random(5);
    constexpr int kSamples = 100000;
    Spectrum sum;
    for (int i = 0; i < kSamples; ++i) {
      const Real x = random.Uniform(), y = random.Uniform(), u = random.Uniform();
      if (const auto sample = coat.Sample(SampleCosineHemisphere({x, y}), {u, random.Uniform()}))
        sum += sample->throughput;
    }
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(double(coat.Rho()[c]), double(sum[c]) / kSamples, .01) << exponent << ' ' << c;
  }
}

TEST(LobeFormulas, OfTheCoat) {
  for (const auto& [ex, ey] : {std::pair{20., 20.}, std::pair{4., 90.}, std::pair{120., 1.}}) {
    const auto power = [ex = ex, ey = ey](const Geometry& g) {
      const double c = std::cos(g.halfAzimuth), s = std::sin(g.halfAzimuth);
      return std::pow(g.cosH, ex * c * c + ey * s * s);
    };
    ExpectFormulas(
        BlendedGloss(kColor, Real(ex), Real(ey)),
        [&, ex = ex, ey = ey](const Geometry& g, int c) {
          const double ks = double(kColor[c]);
          const double schlick = ks + (1 - ks) * std::pow(1 - g.toHalf, 5);
          return std::sqrt((ex + 2) * (ey + 2)) / (2 * M_PI) * power(g) * schlick /
                 (4 * g.toHalf * std::max(g.cosI, g.cosO));
        },
        [&, ex = ex, ey = ey](const Geometry& g) {
          return std::sqrt((ex + 1) * (ey + 1)) / (2 * M_PI) * power(g) / (4 * g.toHalf);
        });
  }
}

TEST(LobeFormulas, OfTransmissionAreThoseOfReflectionMirrored) {
  const Microfacet reflection(kColor, Fresnel::Dielectric(1, Real(1.5)), 30);
  const Transmitted<Microfacet> transmission(reflection);
  EXPECT_EQ(transmission.Lobe(), LobeSet::GlossyTransmission);
  EXPECT_EQ(Transmitted<Lambert>(Lambert(kColor)).Lobe(), LobeSet::DiffuseTransmission);
  EXPECT_EQ(transmission.Rho(), reflection.Rho());
  RandomStream random(4);
  for (int k = 0; k < 200; ++k) {
    const Pair pair = RandomPair(random);
    const Vector3 below(pair.wi.x, pair.wi.y, -pair.wi.z);
    EXPECT_EQ(transmission.f(pair.wo, below), reflection.f(pair.wo, pair.wi));
    EXPECT_EQ(transmission.Pdf(pair.wo, below), reflection.Pdf(pair.wo, pair.wi));
    const Point2 u{random.Uniform(), random.Uniform()};
    const auto one = transmission.Sample(pair.wo, u), other = reflection.Sample(pair.wo, u);
    ASSERT_EQ(one.has_value(), other.has_value());
    if (!one) continue;
    EXPECT_EQ(one->wi, Vector3(other->wi.x, other->wi.y, -other->wi.z));
    EXPECT_EQ(one->throughput, other->throughput);
    EXPECT_EQ(one->pdf, other->pdf);
  }
}

// The half vector of a sample has cos^(e + 2) = 1 - u.x and the azimuth 2 pi u.y.
TEST(LobeFormulas, OfTheHalfVectorOfAMicrofacetSample) {
  constexpr double kExponent = 12;
  const Microfacet lobe(kColor, Fresnel::None(), Real(kExponent));
  const Vector3 wo = Normalize(Vector3(Real(.2), Real(.1), Real(.9)));
  RandomStream random(6);
  int found = 0;
  for (int k = 0; k < 300; ++k) {
    const Point2 u{random.Uniform(), random.Uniform()};
    const auto sample = lobe.Sample(wo, u);
    if (!sample) continue;
    ++found;
    const Vector3 h = Normalize(wo + sample->wi);
    EXPECT_NEAR(std::pow(double(h.z), kExponent + 2), 1 - double(u.x), 1e-4);
    double azimuth = std::atan2(double(h.y), double(h.x));
    if (azimuth < 0) azimuth += 2 * M_PI;
    if (u.x > Real(.01)) {
      EXPECT_NEAR(azimuth, 2 * M_PI * double(u.y), 2e-3);
    }
  }
  EXPECT_GT(found, 250);
}

TEST(FresnelFormulas, OfDielectricsFromEitherSide) {
  RandomStream random(8);
  for (int k = 0; k < 500; ++k) {
    const double cosine = .01 + .99 * double(random.Uniform());
    const double outside = 1 + double(random.Uniform()), inside = 1 + double(random.Uniform());
    if (std::abs(outside - inside) < .05) continue;
    EXPECT_NEAR(double(FresnelDielectric(Real(cosine), Real(outside), Real(inside))),
                Dielectric(cosine, outside, inside), 3e-4);
    EXPECT_NEAR(double(FresnelDielectric(Real(-cosine), Real(outside), Real(inside))),
                Dielectric(cosine, inside, outside), 3e-4);
  }
}

TEST(FresnelFormulas, OfConductorsDoNotDependOnTheSide) {
  RandomStream random(9);
  for (int k = 0; k < 500; ++k) {
    const double cosine = .01 + .99 * double(random.Uniform());
    const double eta = 3 * double(random.Uniform()), absorption = 5 * double(random.Uniform());
    const double truth = Conductor(cosine, eta, absorption);
    EXPECT_NEAR(double(FresnelConductor(Real(cosine), Real(eta), Real(absorption))), truth, 1e-4);
    EXPECT_NEAR(double(FresnelConductor(Real(-cosine), Real(eta), Real(absorption))), truth, 1e-4);
  }
}

// At normal incidence R = ((n - 1) / (n + 1))^2; R counts as .999 at most.
TEST(FresnelFormulas, OfAnIndexFromItsReflectanceAreLimited) {
  for (const double r : {0., .04, .5, .99, .998}) {
    const double n = double(EtaFromReflectance(Real(r)));
    EXPECT_NEAR(std::pow((n - 1) / (n + 1), 2), r, 1e-5);
  }
  EXPECT_EQ(EtaFromReflectance(1), EtaFromReflectance(Real(.999)));
  EXPECT_EQ(EtaFromReflectance(-1), 1);
  EXPECT_GT(EtaFromReflectance(Real(.999)), EtaFromReflectance(Real(.998)));
}

// The mean of 1 - F over a hemisphere, weighted by 2 cos d(cos), in many steps.
TEST(LobeFormulas, OfTheReflectanceOfGlass) {
  constexpr int kSteps = 20000;
  for (const double index : {1.3, 1.5, 2.4}) {
    double mean = 0;
    for (int i = 0; i < kSteps; ++i) {
      const double cosine = (i + .5) / kSteps;
      mean += Dielectric(cosine, 1, index) * 2 * cosine / kSteps;
    }
    const SpecularReflection reflection(kColor, Fresnel::Dielectric(1, Real(index)));
    const SpecularTransmission refraction(kColor, 1, Real(index), TransportMode::Radiance);
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(double(reflection.Rho()[c]), double(kColor[c]) * mean, 1e-3);
      EXPECT_NEAR(double(refraction.Rho()[c]), double(kColor[c]) * (1 - mean), 1e-3);
    }
  }
}

TEST(LobeFormulas, OfBlackMirrorsAndPanesGiveNoSample) {
  const Vector3 up(0, 0, 1);
  EXPECT_FALSE(SpecularReflection(Spectrum(), Fresnel::None()).Sample(up, {}));
  const SpecularTransmission pane(Spectrum(), 1, Real(1.5), TransportMode::Radiance);
  EXPECT_FALSE(pane.Sample(up, {}));
}

// Snell's law for rays from either side; radiance is scaled by (eta of wo / eta of wi)^2.
TEST(LobeFormulas, OfRefraction) {
  RandomStream random(10);
  constexpr double kOutside = 1.2, kInside = 1.7;
  for (int k = 0; k < 300; ++k) {
    const Pair pair = RandomPair(random);
    for (const bool isEntering : {true, false}) {
      const Vector3 wo = pair.wo * (isEntering ? Real(1) : Real(-1));
      const double etaO = isEntering ? kOutside : kInside, etaI = isEntering ? kInside : kOutside;
      const SpecularTransmission photons(kColor, Real(kOutside), Real(kInside),
                                         TransportMode::Importance);
      const SpecularTransmission radiance(kColor, Real(kOutside), Real(kInside),
                                          TransportMode::Radiance);
      const auto a = photons.Sample(wo, {}), b = radiance.Sample(wo, {});
      const double reflected = Dielectric(pair.g.cosO, etaO, etaI);
      if (reflected == 1) {
        EXPECT_FALSE(a || b);
        continue;
      }
      if (reflected > .9) continue;  // nearly critical: float has too few digits
      ASSERT_TRUE(a && b);
      const double eta = etaO / etaI, sinO2 = 1 - pair.g.cosO * pair.g.cosO;
      EXPECT_NEAR(double(a->wi.x), -eta * double(wo.x), 1e-5);
      EXPECT_NEAR(double(a->wi.y), -eta * double(wo.y), 1e-5);
      const double cosT = std::sqrt(1 - eta * eta * sinO2);
      EXPECT_NEAR(double(a->wi.z), isEntering ? -cosT : cosT, 1e-4);
      EXPECT_EQ(a->wi, b->wi);
      EXPECT_NEAR(double(a->eta), eta, 1e-6);
      EXPECT_EQ(a->pdf, 1);
      for (int c = 0; c < 3; ++c) {
        const double passed = double(kColor[c]) * (1 - reflected);
        EXPECT_NEAR(double(a->throughput[c]), passed, 1e-3);
        EXPECT_NEAR(double(b->throughput[c]), passed * eta * eta, 1e-3);
      }
    }
  }
}

// At the peak, wo and -wi are the same direction.
TEST(PhaseFormula, KeepsItsDigitsAtANarrowPeak) {
  RandomStream random(13);
  for (const double size : {.99, .999, .9999}) {
    for (int k = 0; k < 200; ++k) {
      const Vector3 w = RandomPair(random).wo;
      const double peak = (1 + size) / (4 * M_PI * (1 - size) * (1 - size));
      EXPECT_NEAR(double(HenyeyGreenstein(Real(size), w, -w)) / peak, 1, 1e-3) << size;
      EXPECT_NEAR(double(HenyeyGreenstein(Real(-size), w, w)) / peak, 1, 1e-3) << size;
    }
  }
}

// Henyey and Greenstein 1941, by the angle between the ways of the light before and after.
TEST(PhaseFormula, OfHenyeyAndGreenstein) {
  RandomStream random(12);
  for (const double g : {-.8, 0., .3, .9}) {
    for (int k = 0; k < 100; ++k) {
      const Pair pair = RandomPair(random);
      // Light travels along -wi and leaves along wo.
      const double cosine = -(2 * pair.g.toHalf * pair.g.toHalf - 1);
      const double truth = (1 - g * g) / (4 * M_PI * std::pow(1 + g * g - 2 * g * cosine, 1.5));
      EXPECT_NEAR(double(HenyeyGreenstein(Real(g), pair.wo, pair.wi)), truth, 1e-3 * truth);
    }
  }
}

}  // namespace
}  // namespace exphoton
