// SPDX-License-Identifier: BSD-2-Clause
// These tests check colours from CIE XYZ, spectra and black bodies. The tolerances are the errors
// of the analytic fit to the observer (about 1 % of the luminance).
#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>

#include "core/base/log.h"
#include "core/math/cie.h"
#include "core/params/param_table.h"

namespace exphoton {
namespace {

struct ColorSettings {
  Spectrum color;
};

const ParamTable<ColorSettings>& ColorTable() {
  static const ParamTable<ColorSettings> table{
      Param("L", &ColorSettings::color, "a color").AtLeast(0)};
  return table;
}

class ColorParams : public ::testing::Test {
 protected:
  static ParsedParam Numbers(const std::string& type, std::vector<double> numbers) {
    ParsedParam param;
    param.type = type;
    param.name = "L";
    param.numbers = std::move(numbers);
    return param;
  }
  static ParsedParam File(const std::string& path) {
    ParsedParam param;
    param.type = "spectrum";
    param.name = "L";
    param.strings = {path};
    return param;
  }
  Spectrum Bind(ParsedParam param) {
    ParamSet params;
    params.Add(std::move(param));
    BindContext context;
    context.what = "light \"x\"";
    context.log = &log_;
    return ColorTable().Bind(params, context).color;
  }
  std::string Fails(ParsedParam param) {
    try {
      Bind(std::move(param));
    } catch (const Error& error) {
      return error.what();
    }
    return "no error";
  }
  Log log_{Log::Level::Normal, Log::Sink::Memory};
};

TEST_F(ColorParams, XyzOfTheWhitePointIsWhite) {
  const Spectrum white = Bind(Numbers("xyz", {.950456, 1, 1.088754}));
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(double(white[i]), 1, 1e-4);
}

TEST_F(ColorParams, ASpectrumOfOneEverywhereHasLuminanceOne) {
  EXPECT_NEAR(double(Bind(Numbers("spectrum", {400, 1, 700, 1})).Y()), 1, 1e-3);
  EXPECT_NEAR(double(Bind(Numbers("spectrum", {550, 2})).Y()), 2, 2e-3);
}

TEST_F(ColorParams, TheOrderOfSpectralSamplesDoesNotMatter) {
  EXPECT_EQ(Bind(Numbers("spectrum", {400, 1, 500, .5, 700, .2})),
            Bind(Numbers("spectrum", {700, .2, 400, 1, 500, .5})));
}

TEST_F(ColorParams, EqualEnergyHasTheChromaticityOfTheIlluminantE) {
  const Spectrum e = RgbFromSamples({{400, 1}});
  EXPECT_NEAR(double(e.r), 1.2048, .02);  // XYZ 1 1 1 in Rec. 709
  EXPECT_NEAR(double(e.g), .9483, .02);
  EXPECT_NEAR(double(e.b), .9089, .02);
}

TEST_F(ColorParams, ABlackBodyAt6500KelvinIsNearlyWhiteAndAColdOneIsRed) {
  const Spectrum day = Bind(Numbers("blackbody", {6500, 1}));
  EXPECT_NEAR(double(day.r / day.g), 1.05, .06);
  EXPECT_NEAR(double(day.b / day.g), 1.0, .06);
  const Spectrum candle = Bind(Numbers("blackbody", {1900, 1}));
  EXPECT_GT(candle.r, 2 * candle.g);
  EXPECT_GT(candle.g, 2 * candle.b);
}

TEST_F(ColorParams, ABlackBodyScalesWithItsSecondNumber) {
  const Spectrum one = Bind(Numbers("blackbody", {5000, 1}));
  EXPECT_EQ(Bind(Numbers("blackbody", {5000, 4})), one * Real(4));
}

TEST_F(ColorParams, ExtremeTemperaturesAreFinite) {
  for (const double kelvin : {1e-300, 1e-3, 1., 100., 1e5, 1e9}) {
    EXPECT_TRUE(Bind(Numbers("blackbody", {kelvin, 1})).IsFinite()) << kelvin;
  }
}

TEST_F(ColorParams, AColorOutsideOfRgbIsCutWithANotice) {
  const Spectrum red = Bind(Numbers("blackbody", {1000, 1}));
  EXPECT_EQ(red.b, 0);
  ASSERT_EQ(log_.Messages().size(), 1u);
  EXPECT_EQ(log_.Messages()[0],
            "exphoton: note: parameter \"L\" of light \"x\" is a color outside of RGB: its "
            "negative part counts as 0\n");
}

TEST_F(ColorParams, MeaninglessSpectraAreErrors) {
  const std::string subject = "parameter \"L\" of light \"x\" ";
  EXPECT_EQ(Fails(Numbers("spectrum", {400, 1, 500})),
            subject + "needs pairs of a wavelength and a value, not 3 numbers");
  EXPECT_EQ(Fails(Numbers("spectrum", {-400, 1})), subject + "must have wavelengths above 0 nm");
  EXPECT_EQ(Fails(Numbers("spectrum", {400, NAN})), subject + "must have finite numbers only");
  EXPECT_EQ(Fails(Numbers("blackbody", {0, 1})),
            subject + "must have a temperature above 0 K and at most 1000000000 K, not 0");
  EXPECT_EQ(Fails(Numbers("blackbody", {5000, -1})),
            subject + "must have a finite scale of at least 0, not -1");
  EXPECT_EQ(Fails(Numbers("blackbody", {5000})), subject + "needs 2 values, not 1");
  EXPECT_EQ(Fails(Numbers("spectrum", {400, -1})).find(subject + "must be at least 0, not -1"), 0u);
}

TEST_F(ColorParams, AFileOfPairsIsASpectrum) {
  const std::string path = ::testing::TempDir() + "exphoton_color_params.spd";
  std::ofstream(path) << "# a comment\n400 1\n500 .5 # another\n700 .2\n";
  EXPECT_EQ(Bind(File(path)), Bind(Numbers("spectrum", {400, 1, 500, .5, 700, .2})));
  std::ofstream(path) << "400 1\nred\n";
  EXPECT_EQ(Fails(File(path)), "parameter \"L\" of light \"x\" cannot use the spectrum file \"" +
                                   path + "\": line 2 contains a word that is not a number");
  std::ofstream(path) << "";
  EXPECT_EQ(Fails(File(path)), "parameter \"L\" of light \"x\" cannot use the spectrum file \"" +
                                   path +
                                   "\": needs pairs of a wavelength and a value, not 0 numbers");
  std::remove(path.c_str());
  EXPECT_EQ(Fails(File(path)), "parameter \"L\" of light \"x\" cannot use the spectrum file \"" +
                                   path + "\": there is no such file");
  EXPECT_EQ(Fails(File("/dev/zero")),
            "parameter \"L\" of light \"x\" cannot use the spectrum file \"/dev/zero\": it is not "
            "a regular file");
}

}  // namespace
}  // namespace exphoton
