// SPDX-License-Identifier: BSD-2-Clause
// These tests check the film: means, weights, windows, precision, and refusal of impossible sizes.
#include "core/imaging/film/film.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/files/byte_archive.h"

namespace exphoton {
namespace {

constexpr PixelBounds kFilmPixel{0, 0, 1, 1};

TEST(Film, HoldsTheMeanOfEachPixel) {
  Film film({0, 0, 3, 2}, {0, 0, 3, 2});
  film.AddSample({2, 1}, Spectrum(1, 2, 3), 1, 1);
  film.AddSample({2, 1}, Spectrum(3, 2, 0), 0, 1);
  const Image image = film.ToImage(false);
  EXPECT_EQ(image.channels, (std::vector<std::string>{"R", "G", "B", "A"}));
  EXPECT_EQ(image.At(2, 1, 0), 2);
  EXPECT_EQ(image.At(2, 1, 1), 2);
  EXPECT_EQ(image.At(2, 1, 2), 1.5f);
  EXPECT_EQ(image.At(2, 1, 3), .5f);
  EXPECT_EQ(film.SampleCount({2, 1}), 2);
  EXPECT_EQ(image.At(0, 0, 0), 0);
  EXPECT_EQ(image.At(0, 0, 3), 0);
  EXPECT_EQ(film.ToImage(true).At(2, 1, 0), 1);
}

// The difference between two pictures has light, but no samples of its own.
TEST(Film, KnowsWhetherItHasSamples) {
  Film film({0, 0, 3, 2}, {0, 0, 3, 2});
  EXPECT_FALSE(film.HasSamples());
  film.AddLight({1, 1}, Spectrum(1), 1);
  EXPECT_FALSE(film.HasSamples());
  film.AddSample({2, 1}, Spectrum(), 0, 1);  // black
  EXPECT_TRUE(film.HasSamples());
  film.Clear();
  EXPECT_FALSE(film.HasSamples());
}

TEST(Film, SavesLightWithoutSamples) {
  const PixelBounds bounds{0, 0, 2, 2};
  Film saved(bounds, bounds), loaded(bounds, bounds), picture(bounds, bounds);
  saved.AddLight({1, 0}, Spectrum(0, 2, 0), 1);
  saved.AddOwnLight({0, 1}, Spectrum(0, 0, -3), 1);
  ByteArchive archive;
  saved.Transfer(&archive);
  const std::string bytes = archive.Take();
  ByteArchive reader(bytes);
  loaded.Transfer(&reader);
  reader.CheckEnd();
  ByteArchive again;
  loaded.Transfer(&again);
  EXPECT_EQ(again.Take(), bytes);
  EXPECT_EQ(loaded.SumsOf(1).g, 2);
  ByteArchive empty;
  picture.Transfer(&empty);
  EXPECT_GT(bytes.size(), empty.Take().size());
}

TEST(Film, OfACropHasItsWindow) {
  Film film({0, 0, 100, 50}, {10, 20, 12, 23});
  film.AddSample({11, 22}, Spectrum(4), 1, 1);
  const Image image = film.ToImage(true);
  EXPECT_EQ(image.data, (PixelBounds{10, 20, 12, 23}));
  EXPECT_EQ(image.display, (PixelBounds{0, 0, 100, 50}));
  EXPECT_EQ(image.At(1, 2, 0), 4);
}

TEST(Film, AFlatRegionIsFlatUnderNegativeLobes) {
  for (int samples = 1; samples < 40; ++samples) {
    Film film(kFilmPixel, kFilmPixel);
    for (int i = 0; i < samples; ++i)
      film.AddSample({0, 0}, Spectrum(Real(.75)), 1, i % 5 == 2 ? Real(-1.2) : Real(1.2));
    const Image image = film.ToImage(true);
    EXPECT_NEAR(image.At(0, 0, 0), .75, 1e-6) << samples;
    EXPECT_NEAR(image.At(0, 0, 3), 1, 1e-6) << samples;
  }
}

TEST(Film, WeightsThatCancelGiveAFinitePixel) {
  Film film(kFilmPixel, kFilmPixel);
  for (Real weight : {Real(1), Real(-1), Real(1), Real(-1)})
    film.AddSample({0, 0}, Spectrum(1 + weight), 1, weight);
  EXPECT_EQ(film.ToImage(true).At(0, 0, 0), 1);
}

TEST(Film, WeightsThatCancelGiveTheSamePixelInASumOfFilms) {
  Film film(kFilmPixel, kFilmPixel), sum(kFilmPixel, kFilmPixel);
  for (Real weight : {Real(1), Real(-1), Real(1), Real(-1)})
    film.AddSample({0, 0}, Spectrum(1 + weight, 2, 3), 1, weight);
  sum.Add(film);
  EXPECT_EQ(sum.ToImage(true).pixels, film.ToImage(true).pixels);
  EXPECT_EQ(sum.ToImage(false).pixels, film.ToImage(false).pixels);
  EXPECT_EQ(sum.ToImage(true).At(0, 0, 1), 2);
  EXPECT_EQ(sum.SampleCount({0, 0}), 4);
}

TEST(Film, ASumOfFilmsHasTheMeanOfAllSamples) {
  Film sum(kFilmPixel, kFilmPixel);
  const Real alphas[] = {1, 0, Real(.5)};
  for (int i = 0; i < 3; ++i) {
    Film film(kFilmPixel, kFilmPixel);
    film.AddSample({0, 0}, Spectrum(Real(i), Real(2 * i), Real(4 * i)), alphas[i], 1);
    sum.Add(film);
  }
  const Image image = sum.ToImage(false);
  EXPECT_EQ(image.At(0, 0, 0), 1);
  EXPECT_EQ(image.At(0, 0, 1), 2);
  EXPECT_EQ(image.At(0, 0, 2), 4);
  EXPECT_EQ(image.At(0, 0, 3), .5f);
}

// If less than half of the total weight remains, the mean uses the weights' absolute values.
TEST(Film, WeightsThatNearlyCancelDoNotScaleThePixel) {
  const auto pixel = [](int positive, int negative) {
    Film film(kFilmPixel, kFilmPixel);
    for (int i = 0; i < positive; ++i) film.AddSample({0, 0}, Spectrum(1), 1, 1);
    for (int i = 0; i < negative; ++i) film.AddSample({0, 0}, Spectrum(0), 1, -1);
    return film.ToImage(true).At(0, 0, 0);
  };
  EXPECT_FLOAT_EQ(pixel(6, 4), .6f);      // not 6 / (6 - 4)
  EXPECT_FLOAT_EQ(pixel(8, 2), 8.f / 6);  // signed weights, because enough weight remains
}

TEST(Film, APixelIsNeverNegative) {
  Film film(kFilmPixel, kFilmPixel);
  for (Real weight : {Real(1), Real(1), Real(1), Real(-1)})
    film.AddSample({0, 0}, weight < 0 ? Spectrum(10) : Spectrum(1), weight < 0 ? 1 : Real(.1),
                   weight);
  const Image image = film.ToImage(false);
  EXPECT_EQ(image.At(0, 0, 0), 0);
  EXPECT_EQ(image.At(0, 0, 3), 0);
}

TEST(Film, AHundredMillionSamplesKeepTheirMean) {
  Film film(kFilmPixel, kFilmPixel);
  for (int i = 0; i < 100'000'000; ++i)
    film.AddSample({0, 0}, Spectrum(Real(.1), Real(.7), Real(i % 2)), 1, 1);
  const Image image = film.ToImage(true);
  EXPECT_NEAR(image.At(0, 0, 0), .1, 1e-7);
  EXPECT_NEAR(image.At(0, 0, 1), .7, 7e-7);
  EXPECT_NEAR(image.At(0, 0, 2), .5, 5e-7);
}

TEST(Film, CropWindowsThatMeetShareNoPixelAndLeaveNoneOut) {
  FilmSettings settings;
  settings.xResolution = 300, settings.yResolution = 7;
  settings.cropWindow = {{Real(.2), Real(.5), 0, Real(.5)}};
  EXPECT_EQ(settings.Crop(), (PixelBounds{60, 0, 150, 4}));
  for (Real split : {Real(.1), Real(1. / 3), Real(.5), Real(.7)}) {
    settings.cropWindow = {{0, split, 0, 1}};
    const int end = settings.Crop().x1;
    settings.cropWindow = {{split, 1, 0, 1}};
    EXPECT_EQ(settings.Crop().x0, end);
    EXPECT_EQ(settings.Crop().x1, 300);
  }
}

TEST(Film, ImpossibleSizesAreErrors) {
  const auto status = [](PixelBounds full, PixelBounds crop) {
    try {
      Film film(full, crop);
    } catch (const Error& error) {
      return error.Status();
    }
    return ExitStatus::Ok;
  };
  EXPECT_EQ(status({0, 0, 100000, 100000}, {0, 0, 100000, 100000}), ExitStatus::Resource);
  EXPECT_EQ(status({0, 0, 2147483647, 2147483647}, {0, 0, 2147483647, 2147483647}),
            ExitStatus::Resource);
  EXPECT_EQ(status({0, 0, 1, 100000}, {0, 0, 1, 100000}), ExitStatus::Ok);
  EXPECT_EQ(status({0, 0, 100000, 100000}, {5, 5, 6, 6}), ExitStatus::Ok);
  EXPECT_EQ(status({0, 0, 0, 5}, {0, 0, 0, 5}), ExitStatus::Scene);
  EXPECT_EQ(status({0, 0, 5, 5}, {3, 3, 2, 5}), ExitStatus::Scene);
  EXPECT_EQ(status({0, 0, 5, 5}, {3, 3, 6, 5}), ExitStatus::Scene);
}

}  // namespace
}  // namespace exphoton
