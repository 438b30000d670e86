// SPDX-License-Identifier: BSD-2-Clause
// These tests check AOVs: their names, their sums, and the light that the five integrators
// write to them.
#include "core/imaging/film/aovs.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/imaging/film/aov_film.h"
#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

constexpr PixelBounds kOnePixel{0, 0, 1, 1};

AovSet Parsed(const std::string& text) {
  std::string unknown;
  return ParseAovs(text, &unknown).value();
}

TEST(Aovs, AreNamedWithOrWithoutTheirChannelsAndInAnyCase) {
  EXPECT_EQ(Parsed("Albedo,VARIANCE"), (AovSet{Aov::Albedo, Aov::Variance}));
  EXPECT_EQ(Parsed("albedo.RGB,n.xyz"), (AovSet{Aov::Albedo, Aov::Normal}));
  EXPECT_EQ(Parsed("light"), kLightAovs);
  EXPECT_EQ(Parsed("time.ms,P"), (AovSet{Aov::Time, Aov::Position}));
  for (const char* wrong : {"albedo.XYZ", "N.", "", "direct,,caustic", "lights"}) {
    std::string unknown = "?";
    EXPECT_FALSE(ParseAovs(wrong, &unknown)) << wrong;
    EXPECT_NE(unknown, "?");
  }
}

TEST(AovFilm, AveragesAsTheFilmDoesAndCountsSamples) {
  Film film(kOnePixel, kOnePixel);
  AovFilm aovs(kOnePixel, {Aov::Direct, Aov::Samples, Aov::RadianceDistance});
  for (const auto& [value, weight] : {std::pair<Real, Real>{2, 1}, {4, Real(-.5)}, {8, 1}}) {
    AovSample sample;
    sample.direct = Spectrum(value, 2 * value, 0);
    sample.radianceDistance = 3;
    sample.radiancePhotonsRead = 2;
    film.AddSample({0, 0}, sample.direct, 1, weight);
    aovs.AddSample({0, 0}, sample, sample.direct, weight);
  }
  Image image = film.ToImage(true);
  aovs.AppendTo(film, true, &image);
  EXPECT_EQ(image.channels,
            (std::vector<std::string>{"R", "G", "B", "A", "direct.R", "direct.G", "direct.B",
                                      "samples.count", "radianceDistance.Y"}));
  for (int c = 0; c < 3; ++c) EXPECT_EQ(image.At(0, 0, 4 + c), image.At(0, 0, c));
  EXPECT_EQ(image.At(0, 0, 7), 3);
  EXPECT_EQ(image.At(0, 0, 8), 1.5f);
}

// The AOV's channel is time.ms.
TEST(AovFilm, ShowsTheSumOfAPixelsTimesInMilliseconds) {
  Film film(kOnePixel, kOnePixel);
  AovFilm aovs(kOnePixel, {Aov::Time});
  film.AddSample({0, 0}, Spectrum(1), 1, 1);
  aovs.AddTime({0, 0}, .25);
  aovs.AddTime({0, 0}, .5);
  Image image = film.ToImage(true);
  aovs.AppendTo(film, true, &image);
  EXPECT_EQ(image.At(0, 0, image.FindChannel("time.ms")), 750);
}

// The n samples have the variance 1/12, so their mean has the variance 1/(12 n).
TEST(AovFilm, EstimatesTheVarianceOfAPixel) {
  constexpr int kPixels = 4000, kSamples = 16;
  const PixelBounds row{0, 0, kPixels, 1};
  Film film(row, row);
  AovFilm aovs(row, {Aov::Variance});
  RandomStream random(HashKey({1, 2}));
  for (int x = 0; x < kPixels; ++x) {
    for (int i = 0; i < kSamples; ++i) {
      const Spectrum L(random.Uniform(), 2 * random.Uniform(), 1);
      film.AddSample({x, 0}, L, 1, 1);
      aovs.AddSample({x, 0}, {}, L, 1);
    }
  }
  Image image = film.ToImage(true);
  aovs.AppendTo(film, true, &image);
  // Each channel is the mean of 4000 estimates, which is accurate to 0.5 %.
  EXPECT_NEAR(MeanChannel(image, "variance.R") * kSamples * 12, 1, .03);
  EXPECT_NEAR(MeanChannel(image, "variance.G") * kSamples * 3, 1, .03);
  EXPECT_NEAR(MeanChannel(image, "variance.B"), 0, 1e-12);
}

// Parts of samples (pixels with edges) have smaller weights.
TEST(AovFilm, SeesNoVarianceInEqualPartsOfSamples) {
  Film film(kOnePixel, kOnePixel);
  AovFilm aovs(kOnePixel, {Aov::Variance});
  for (int i = 0; i < 16; ++i) {
    film.AddSample({0, 0}, Spectrum(3), 1, Real(.25));
    aovs.AddSample({0, 0}, {}, Spectrum(3), Real(.25));
  }
  Image image = film.ToImage(true);
  aovs.AppendTo(film, true, &image);
  EXPECT_NEAR(MeanChannel(image, "variance.G"), 0, 1e-12);
}

TEST(AovFilm, SeesNoVarianceInEqualSamplesOfUnequalWeights) {
  Film film(kOnePixel, kOnePixel);
  AovFilm aovs(kOnePixel, {Aov::Variance});
  for (const Real weight : {Real(.625), Real(.75), Real(.875)}) {
    film.AddSample({0, 0}, Spectrum(3), 1, weight);
    aovs.AddSample({0, 0}, {}, Spectrum(3), weight);
  }
  Image image = film.ToImage(true);
  aovs.AppendTo(film, true, &image);
  EXPECT_NEAR(MeanChannel(image, "variance.G"), 0, 1e-12);
}

// Half of the samples have alpha 1 and half have alpha 0. Premultiplied, the values are scaled by
// 1/2 and their variance by 1/4.
TEST(AovFilm, ScalesTheVarianceByTheSquareOfAlpha) {
  Film film(kOnePixel, kOnePixel);
  AovFilm aovs(kOnePixel, {Aov::Variance});
  for (int i = 0; i < 8; ++i) {
    const Spectrum L{Real(i)};
    film.AddSample({0, 0}, L, Real(i % 2), 1);
    aovs.AddSample({0, 0}, {}, L, 1);
  }
  const auto variance = [&](bool premultiplyAlpha) {
    Image image = film.ToImage(premultiplyAlpha);
    aovs.AppendTo(film, premultiplyAlpha, &image);
    return MeanChannel(image, "variance.G");
  };
  EXPECT_NEAR(variance(false), 6. / 8, 1e-5);  // values 0 to 7: 42 / 7 over 8 samples
  EXPECT_NEAR(variance(true), 6. / 8 / 4, 1e-5);
}

// Batches of splatted samples replace the light that earlier passes shared.
TEST(AovFilm, ForgetsRemovedLightInTheVariance) {
  const double own[] = {4, 4, 4, 2, 2}, shared[] = {1, 1, 1, 0, 0};  // r, g, b, alpha, weight
  const double squares[] = {1, .5, .5, .5, 2, 2, 2}, none[7] = {};
  Film film(kOnePixel, kOnePixel);
  for (const Real value : {Real(1), Real(3)}) film.AddSample({0, 0}, Spectrum(value), 1, 1);
  AovFilm aovs(kOnePixel, {Aov::Variance}), light(kOnePixel, {Aov::Variance});
  const auto variance = [&] {
    Image image = film.ToImage(false);
    aovs.AppendTo(film, false, &image);
    return MeanChannel(image, "variance.R");
  };
  aovs.AddSums(0, own, nullptr, squares);
  const double before = variance();
  EXPECT_NEAR(before, 4. / 4, 1e-6);  // 2 - 2 * 2 * .5 + 2 * 2 * 1, over the squared weight
  light.AddSums(0, shared, nullptr, none);
  aovs.Add(light);
  EXPECT_GT(variance(), before + .1);
  aovs.SubtractLight(light);
  EXPECT_NEAR(variance(), before, 1e-6);
}

// The world has every kind of light path: a lamp, a sky, glass, a mirror, glossy and
// matte surfaces.
std::string World(bool isOpen = true) {
  const std::string around =
      isOpen ? "LightSource \"infinite\" \"color L\" [.2 .3 .4] \"integer nsamples\" 1\n"
             : "AttributeBegin Material \"matte\" \"color Kd\" [.5 .5 .5] Shape \"sphere\" "
               "\"float radius\" 8 AttributeEnd\n";
  return "WorldBegin\n" + around + R"(AttributeBegin
AreaLightSource "area" "color L" [9 8 7] "integer nsamples" 1
Translate 0 3 4 Shape "sphere" "float radius" .5
AttributeEnd
AttributeBegin Material "glass" Translate -1 -.3 4 Shape "sphere" "float radius" .7 AttributeEnd
AttributeBegin Material "mirror" Translate 1 .6 5 Shape "sphere" "float radius" .6 AttributeEnd
AttributeBegin Material "plastic" "color Ks" [.4 .4 .4] Translate .9 -.6 3.6
Shape "sphere" "float radius" .4 AttributeEnd
Material "matte" "color Kd" [.7 .6 .5]
Shape "trianglemesh" "point P" [-9 -1 -9 9 -1 -9 9 -1 9 -9 -1 9] "integer indices" [0 1 2 0 2 3]
WorldEnd
)";
}

class LightAovsTest : public testing::TestWithParam<const char*> {
 protected:
  static TestRender Render(AovSet aovs, const std::string& filter = "\"box\"") {
    TestRenderOptions options;
    options.aovs = aovs;
    std::string header = TestHeader(GetParam(), 24, 16, 2);
    return RenderSceneText(header + "PixelFilter " + filter + "\n" + World(), options);
  }
};

TEST_P(LightAovsTest, SumToThePicture) {
  for (const char* filter : {"\"box\"", "\"mitchell\""}) {
    const TestRender render = Render(kLightAovs, filter);
    double largest = 0;
    for (int y = 0; y < render.image.Height(); ++y) {
      for (int x = 0; x < render.image.Width(); ++x) {
        for (int c = 0; c < 3; ++c) {
          double sum = 0;
          for (int aov = 0; aov < 5; ++aov) sum += double(render.image.At(x, y, 4 + 3 * aov + c));
          const double beauty = render.image.At(x, y, c);
          EXPECT_NEAR(sum, beauty, 1e-5 * (1 + beauty)) << x << "," << y;
          largest = std::max(largest, beauty);
        }
      }
    }
    EXPECT_GT(largest, 1);
  }
}

TEST_P(LightAovsTest, LeaveThePictureAlone) {
  const TestRender plain = Render({});
  const TestRender layered = Render(kLightAovs | kRendererAovs);
  for (int y = 0; y < plain.image.Height(); ++y)
    for (int x = 0; x < plain.image.Width(); ++x)
      for (int c = 0; c < 4; ++c)
        ASSERT_EQ(plain.image.At(x, y, c), layered.image.At(x, y, c)) << x << "," << y;
  EXPECT_EQ(plain.rays.counts, layered.rays.counts);
}

TEST_P(LightAovsTest, HoldWhatTheyAreNamedAfter) {
  const TestRender render = Render(kLightAovs);
  for (const char* aov : {"emission", "direct", "specular"})
    EXPECT_GT(MeanChannel(render.image, std::string(aov) + ".R"), .001) << aov;
  const std::string name = GetParam();
  const bool isGlobal = name.find("photonmap") != std::string::npos || name == "\"path\"" ||
                        name == "\"bidirectional\"";
  for (const char* aov : {"caustic", "indirect"})
    EXPECT_EQ(MeanChannel(render.image, std::string(aov) + ".R") > .0005, isGlobal) << aov;
}

INSTANTIATE_TEST_SUITE_P(Integrators, LightAovsTest,
                         testing::Values("\"path\"", "\"directlighting\"", "\"whitted\"",
                                         "\"bidirectional\"",
                                         "\"photonmap\" \"integer causticphotons\" 2000 "
                                         "\"integer indirectphotons\" 2000",
                                         "\"exphotonmap\" \"integer causticphotons\" 2000 "
                                         "\"integer indirectphotons\" 2000"));

TEST(SurfaceAovs, HaveTheInterpolatedNormal) {
  TestRenderOptions options;
  options.aovs = {Aov::Normal};
  const Image image =
      RenderSceneText(TestHeader("\"whitted\"", 3, 3, 1) +
                          "WorldBegin LightSource \"point\"\nShape \"trianglemesh\" \"integer "
                          "indices\" [0 1 2] \"point P\" [-9 -9 2 9 -9 2 0 9 2] \"normal N\" [.6 0 "
                          "-.8 .6 0 -.8 .6 0 -.8]\nWorldEnd\n",
                      options)
          .image;
  EXPECT_NEAR(image.At(1, 1, image.FindChannel("N.X")), .6, 1e-5);
  EXPECT_NEAR(image.At(1, 1, image.FindChannel("N.Z")), -.8, 1e-5);
}

// A mirror has no photons. The AOV must not show the photon density of the reflected surface.
TEST(SurfaceAovs, HaveNoPhotonDensityOfWhatAMirrorShows) {
  TestRenderOptions options;
  options.aovs = {Aov::PhotonDensity};
  const Image image =
      RenderSceneText(
          TestHeader("\"photonmap\" \"integer indirectphotons\" 4000", 5, 5, 1) +
              "WorldBegin LightSource \"point\" \"point from\" [0 0 1]\n"
              "AttributeBegin Translate 0 0 -3 Shape \"disk\" \"float radius\" 50 "
              "AttributeEnd\nMaterial \"mirror\" Translate 0 0 4 Shape \"disk\" \"float "
              "radius\" 50\nWorldEnd\n",
          options)
          .image;
  EXPECT_GT(image.At(2, 2, image.FindChannel("G")), 0);  // the mirror shows the lit disk
  EXPECT_EQ(image.At(2, 2, image.FindChannel("photonDensity.Y")), 0);
}

TEST(SurfaceAovs, TellWhatTheCameraSees) {
  TestRenderOptions options;
  options.aovs = kSurfaceAovs | AovSet{Aov::PhotonDensity};
  const Image image =
      RenderSceneText(TestHeader("\"photonmap\" \"integer indirectphotons\" 4000", 9, 9, 4) +
                          "WorldBegin LightSource \"point\" \"point from\" [0 0 1]\nMaterial "
                          "\"matte\" \"color Kd\" [.25 .5 .75]\nTranslate 0 0 4 Shape \"disk\" "
                          "\"float radius\" 2\nWorldEnd\n",
                      options)
          .image;
  EXPECT_NEAR(image.At(4, 4, image.FindChannel("albedo.R")), .25, 1e-6);
  EXPECT_NEAR(image.At(4, 4, image.FindChannel("albedo.B")), .75, 1e-6);
  EXPECT_NEAR(image.At(4, 4, image.FindChannel("N.Z")), -1, 1e-6);
  EXPECT_NEAR(image.At(4, 4, image.FindChannel("P.Z")), 4, 1e-5);
  EXPECT_GT(image.At(4, 4, image.FindChannel("photonDensity.Y")), 0);
  EXPECT_EQ(image.At(0, 0, image.FindChannel("albedo.R")), 0);
}

// Parallel light spreads photons evenly over a disk of radius 2.
TEST(SurfaceAovs, HaveThePhotonDensityOfADiskUnderParallelLight) {
  TestRenderOptions options;
  options.aovs = {Aov::PhotonDensity};
  const TestRender render = RenderSceneText(
      TestHeader("\"photonmap\" \"bool directwithphotons\" \"true\" \"integer directphotons\" "
                 "20000 \"integer indirectphotons\" 0 \"bool finalgather\" \"false\" \"integer "
                 "nused\" 1000 \"float maxdist\" 1",
                 9, 9, 1) +
          "WorldBegin LightSource \"distant\" \"point from\" [0 0 0] \"point to\" [0 0 1]\n"
          "Material \"matte\" Translate 0 0 4 Shape \"disk\" \"float radius\" 2\nWorldEnd\n",
      options);
  const double expected = render.Counter("photons/direct stored") / (4 * 3.14159265358979);
  const int channel = render.image.FindChannel("photonDensity.Y");
  double mean = 0;
  for (int y = 3; y < 6; ++y)
    for (int x = 3; x < 6; ++x) mean += double(render.image.At(x, y, channel)) / 9;
  EXPECT_NEAR(mean / expected, 1, .08);
}

// A mirror covers what is behind it, whatever it shows.
TEST(Alpha, OfAMirrorThatShowsNothingIsOne) {
  for (const char* integrator :
       {"\"whitted\"", "\"directlighting\"", "\"path\"", "\"exphotonmap\"", "\"guidedpath\"",
        "\"bidirectional\"", "\"igi\"", "\"irradiancecache\""}) {
    const Image image =
        RenderSceneText(TestHeader(integrator, 5, 5, 4) +
                        "WorldBegin LightSource \"point\" \"point from\" [0 0 9]\nMaterial "
                        "\"mirror\" Translate 0 0 4 Shape \"disk\" \"float radius\" 2\nWorldEnd\n")
            .image;
    EXPECT_EQ(image.At(2, 2, image.FindChannel("A")), 1) << integrator;
    EXPECT_EQ(image.At(0, 0, image.FindChannel("A")), 0) << integrator;
    EXPECT_EQ(image.At(2, 2, image.FindChannel("G")), 0) << integrator;
  }
}

}  // namespace
}  // namespace exphoton
