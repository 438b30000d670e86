// SPDX-License-Identifier: BSD-2-Clause
// These tests check pixel filters: values computed by hand, the mean of their weights, and
// parameter ranges. The chi-square tests of their distribution are in tests/stat.
#include "core/sampling/filter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "core/base/error.h"
#include "tests/support/test_plugin.h"

namespace exphoton {
namespace {

const char* const kFilters[] = {
    R"("box")",
    R"("box" "float xwidth" 2 "float ywidth" .25)",
    R"("triangle")",
    R"("gaussian")",
    R"("gaussian" "float alpha" .01)",
    R"("gaussian" "float alpha" 5000)",
    R"("mitchell")",
    R"("mitchell" "float B" 0 "float C" 1 "float xwidth" 3)",
    R"("sinc")",
    R"("sinc" "float tau" 1.5)",
};

TEST(Filter, ValuesAreThoseOfTheFormulas) {
  TestPlugins plugins;
  EXPECT_EQ(plugins.MakeFilter(R"("box")")->Evaluate({Real(.4), Real(-.5)}), 1);
  EXPECT_EQ(plugins.MakeFilter(R"("triangle")")->Evaluate({Real(.5), -1}), Real(1.5));
  EXPECT_NEAR(plugins.MakeFilter(R"("gaussian")")->Evaluate({1, Real(.5)}),
              (std::exp(-2.) - std::exp(-8.)) * (std::exp(-.5) - std::exp(-8.)), 1e-6);
  const auto mitchell = plugins.MakeFilter(R"("mitchell")");
  EXPECT_NEAR(mitchell->Evaluate({0, 0}), 64. / 81, 1e-6);     // (8/9)^2
  EXPECT_NEAR(mitchell->Evaluate({0, 1}), 8. / 9 / 18, 1e-6);  // 8/9 * 1/18
  EXPECT_NEAR(mitchell->Evaluate({0, Real(1.5)}), 8. / 9 * -5. / 144, 1e-6);
  const auto sinc = plugins.MakeFilter(R"("sinc")");
  EXPECT_NEAR(sinc->Evaluate({2, 0}), std::sin(1.5 * M_PI) / (1.5 * M_PI) / (M_PI / 2), 1e-6);
  EXPECT_NEAR(sinc->Evaluate({0, 0}), 1, 1e-6);
}

TEST(Filter, IsZeroBeyondItsWidth) {
  TestPlugins plugins;
  for (const char* text : kFilters) {
    const auto filter = plugins.MakeFilter(text);
    EXPECT_EQ(filter->Evaluate({filter->XWidth() * Real(1.001), 0}), 0) << text;
    EXPECT_EQ(filter->Evaluate({0, -filter->YWidth() * Real(1.001)}), 0) << text;
  }
}

TEST(Filter, TheMeanOfTheWeightsIsOne) {
  TestPlugins plugins;
  for (const char* text : kFilters) {
    const auto filter = plugins.MakeFilter(text);
    // Filters are separable. The mean over the square is the mean of a row times the mean of a
    // column, divided by the value at their crossing.
    constexpr int kSteps = 100000;
    const Real v = Real(.51);
    double row = 0, column = 0;
    for (int i = 0; i < kSteps; ++i) {
      const Real u = Real((i + .5) / kSteps);
      row += double(filter->Sample({u, v}).weight) / kSteps;
      column += double(filter->Sample({v, u}).weight) / kSteps;
    }
    EXPECT_NEAR(row * column / double(filter->Sample({v, v}).weight), 1, 1e-4) << text;
  }
}

TEST(Filter, WeightsHaveTheSignOfTheFilterAndOneMagnitude) {
  TestPlugins plugins;
  for (const char* text : kFilters) {
    const auto filter = plugins.MakeFilter(text);
    const Real magnitude = std::abs(filter->Sample({Real(.51), Real(.51)}).weight);
    int odd = 0;
    for (int y = 0; y < 100; ++y) {
      for (int x = 0; x < 100; ++x) {
        const FilterSample s = filter->Sample({Real(x) / 100, Real(y) / 100});
        EXPECT_GE(s.weight * filter->Evaluate(s.offset), 0) << text;
        odd += std::abs(std::abs(s.weight) - magnitude) > Real(.01) * magnitude;
      }
    }
    EXPECT_LE(odd, 300) << text;  // at the edge and at sign changes
  }
}

TEST(Filter, TheEndsOfTheUnitSquareAreFinite) {
  TestPlugins plugins;
  for (const char* text : kFilters) {
    const auto filter = plugins.MakeFilter(text);
    for (Real u : {Real(0), Real(1e-30), Real(.5), Real(.49999997), kOneMinusEpsilon}) {
      for (Point2 p : {Point2(u, Real(.3)), Point2(Real(.3), u), Point2(u, u)}) {
        const FilterSample s = filter->Sample(p);
        EXPECT_LE(std::abs(s.offset.x), filter->XWidth()) << text;
        EXPECT_LE(std::abs(s.offset.y), filter->YWidth()) << text;
        EXPECT_LE(std::abs(s.weight), 10) << text;
      }
    }
  }
}

TEST(Filter, WidthsOutOfRangeAreErrors) {
  TestPlugins plugins;
  for (const char* name : {"box", "triangle", "gaussian", "mitchell", "sinc"}) {
    for (const char* width : {"0", "1e-6", "-1", "2147483300"}) {
      const std::string text = std::string("\"") + name + "\" \"float xwidth\" " + width;
      EXPECT_THROW(plugins.MakeFilter(text), Error) << text;
    }
  }
  EXPECT_THROW(plugins.MakeFilter(R"("gaussian" "float alpha" 0)"), Error);
}

double Mitchell(double x, double b, double c) {
  x = std::abs(x);
  if (x >= 2) return 0;
  if (x >= 1)
    return ((-b - 6 * c) * x * x * x + (6 * b + 30 * c) * x * x + (-12 * b - 48 * c) * x + 8 * b +
            24 * c) /
           6;
  return ((12 - 9 * b - 6 * c) * x * x * x + (-18 + 12 * b + 6 * c) * x * x + 6 - 2 * b) / 6;
}
double Sinc(double x) { return x == 0 ? 1 : std::sin(M_PI * x) / (M_PI * x); }

// Samples come as far as the width on all four sides.
void ExpectReach(const Filter& filter, const char* text) {
  Real left = 0, right = 0, low = 0, high = 0;
  for (int i = 0; i <= 50; ++i) {
    const Real u = Real(i) / 50 * kOneMinusEpsilon;
    const Point2 a = filter.Sample({u, Real(.4)}).offset, b = filter.Sample({Real(.4), u}).offset;
    left = std::min(left, a.x), right = std::max(right, a.x);
    low = std::min(low, b.y), high = std::max(high, b.y);
  }
  EXPECT_NEAR(double(right / filter.XWidth()), 1, .1) << text;
  EXPECT_NEAR(double(left / filter.XWidth()), -1, .1) << text;
  EXPECT_NEAR(double(high / filter.YWidth()), 1, .1) << text;
  EXPECT_NEAR(double(low / filter.YWidth()), -1, .1) << text;
}

// The defaults, and each parameter with a value of its own, over the whole support.
TEST(Filter, FollowsItsFormulaWithEachParameter) {
  TestPlugins plugins;
  const auto gauss = [](double alpha, double w) {
    return [=](double x) { return std::exp(-alpha * x * x) - std::exp(-alpha * w * w); };
  };
  const auto mitchell = [](double w, double b, double c) {
    return [=](double x) { return Mitchell(2 * x / w, b, c); };
  };
  const auto sinc = [](double w, double tau) {
    return [=](double x) { return Sinc(tau * x / w) * Sinc(x / w); };
  };
  const auto triangle = [](double w) { return [=](double x) { return w - std::abs(x); }; };
  const auto box = [](double) { return 1.; };
  const struct {
    const char* text;
    double xWidth, yWidth;
    std::function<double(double)> x, y;
  } cases[] = {
      {R"("box")", .5, .5, box, box},
      {R"("box" "float xwidth" 1.5 "float ywidth" 2.5)", 1.5, 2.5, box, box},
      {R"("triangle")", 2, 2, triangle(2), triangle(2)},
      {R"("triangle" "float xwidth" 1.5 "float ywidth" 2.5)", 1.5, 2.5, triangle(1.5),
       triangle(2.5)},
      {R"("gaussian")", 2, 2, gauss(2, 2), gauss(2, 2)},
      {R"("gaussian" "float xwidth" 1.5 "float ywidth" 2.5 "float alpha" .7)", 1.5, 2.5,
       gauss(.7, 1.5), gauss(.7, 2.5)},
      {R"("mitchell")", 2, 2, mitchell(2, 1. / 3, 1. / 3), mitchell(2, 1. / 3, 1. / 3)},
      {R"("mitchell" "float xwidth" 1.5 "float ywidth" 2.5 "float B" .2 "float C" .6)", 1.5, 2.5,
       mitchell(1.5, .2, .6), mitchell(2.5, .2, .6)},
      {R"("sinc")", 4, 4, sinc(4, 3), sinc(4, 3)},
      {R"("sinc" "float xwidth" 1.5 "float ywidth" 2.5 "float tau" 2)", 1.5, 2.5, sinc(1.5, 2),
       sinc(2.5, 2)},
  };
  for (const auto& each : cases) {
    const auto filter = plugins.MakeFilter(each.text);
    EXPECT_EQ(filter->XWidth(), Real(each.xWidth)) << each.text;
    EXPECT_EQ(filter->YWidth(), Real(each.yWidth)) << each.text;
    for (int i = -19; i <= 19; ++i) {
      const double x = each.xWidth * i / 20, y = each.yWidth * (i * 7 % 20) / 20;
      EXPECT_NEAR(double(filter->Evaluate({Real(x), Real(y)})), each.x(x) * each.y(y), 2e-6)
          << each.text << ' ' << x << ' ' << y;
    }
    ExpectReach(*filter, each.text);
  }
}

}  // namespace
}  // namespace exphoton
