// SPDX-License-Identifier: BSD-2-Clause
// ProbeSampling checks the sampler of a scene, and filters with random widths. Points of different
// purposes must not be correlated, and samples of a filter must have the moments of its values.
#include <algorithm>
#include <array>
#include <cmath>

#include "tests/random/probes/sampling_probe.h"

namespace exphoton::random_scenes {
namespace {

constexpr int kPixels = 24;  // along each axis

// Column is a list of numbers of one purpose, in the order of samples.
struct Column {
  const char* name;
  std::vector<double> values;
};

double MeanOf(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / double(values.size());
}

double CorrelationOf(const std::vector<double>& a, const std::vector<double>& b) {
  const double ma = MeanOf(a), mb = MeanOf(b);
  double ab = 0, aa = 0, bb = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    ab += (a[i] - ma) * (b[i] - mb);
    aa += (a[i] - ma) * (a[i] - ma);
    bb += (b[i] - mb) * (b[i] - mb);
  }
  return aa > 0 && bb > 0 ? ab / std::sqrt(aa * bb) : 0;
}

std::vector<Column> ColumnsOf(const Sampler& sampler, std::uint64_t seed) {
  SampleLayout layout;
  const int one = layout.Request1D(1), two = layout.Request2D(1), three = layout.Request2D(1);
  CameraSamples samples(layout);
  std::vector<Column> columns{{"film x", {}}, {"film y", {}}, {"lens x", {}}, {"lens y", {}},
                              {"time", {}},   {"1D", {}},     {"2D x", {}},   {"2D y", {}},
                              {"next x", {}}, {"next y", {}}};
  for (int y = 0; y < kPixels; ++y)
    for (int x = 0; x < kPixels; ++x)
      for (std::int64_t i = 0; i < sampler.SamplesPerPixel(); ++i) {
        sampler.Generate({seed, {x, y}, i}, &samples);
        const Point2 a = samples.Array2D(two)[0], b = samples.Array2D(three)[0];
        const std::array<Real, 10> row{samples.film.x,
                                       samples.film.y,
                                       samples.lens.x,
                                       samples.lens.y,
                                       samples.time,
                                       samples.Array1D(one)[0],
                                       a.x,
                                       a.y,
                                       b.x,
                                       b.y};
        for (std::size_t c = 0; c < row.size(); ++c) columns[c].values.push_back(double(row[c]));
      }
  return columns;
}

// Moments are the means of a constant, x, y, x^2, y^2 and |x y|.
using Moments = std::array<double, 6>;
constexpr std::array<const char*, 6> kMomentNames{
    "mean weight of a filter",   "mean x of a filter",        "mean y of a filter",
    "variance in x of a filter", "variance in y of a filter", "mean |x y| of a filter"};

void AddTo(Moments* moments, Point2 at, double weight) {
  const double x = double(at.x), y = double(at.y);
  const Moments terms{1, x, y, x * x, y * y, std::abs(x * y)};
  for (std::size_t i = 0; i < terms.size(); ++i) (*moments)[i] += weight * terms[i];
}

// Returns the moments by the filter's values on a grid.
Moments MomentsOfValues(const Filter& filter) {
  constexpr int kSide = 96;
  Moments moments{};
  for (int i = 0; i < kSide; ++i)
    for (int j = 0; j < kSide; ++j) {
      const Real x = filter.XWidth() * (2 * (Real(i) + Real(.5)) / kSide - 1);
      const Real y = filter.YWidth() * (2 * (Real(j) + Real(.5)) / kSide - 1);
      AddTo(&moments, {x, y}, double(filter.Evaluate({x, y})));
    }
  const double weights = moments[0];
  for (double& moment : moments) moment /= weights;
  return moments;
}

Moments MomentsOfSamples(const Filter& filter) {
  constexpr int kSide = 96;
  RandomStream random(1);
  Moments moments{};
  for (int i = 0; i < kSide; ++i)
    for (int j = 0; j < kSide; ++j) {
      const Real u = (Real(i) + random.Uniform()) / kSide, v = (Real(j) + random.Uniform()) / kSide;
      const FilterSample sample = filter.Sample({u, v});
      AddTo(&moments, sample.offset, double(sample.weight) / (kSide * kSide));
    }
  return moments;
}

std::string FilterScene(const char* name, double width, double height) {
  char text[160];
  std::snprintf(text, sizeof text,
                "PixelFilter \"%s\" \"float xwidth\" %g \"float ywidth\" %g\n"
                "WorldBegin\nWorldEnd\n",
                name, width, height);
  return text;
}

void CheckMoments(const Filter& filter, Findings* findings) {
  const Moments values = MomentsOfValues(filter), samples = MomentsOfSamples(filter);
  const double size = double(filter.XWidth() + filter.YWidth());
  for (std::size_t i = 0; i < values.size(); ++i)
    findings->Expect(std::abs(values[i] - samples[i]) < .01 * size * size, kMomentNames[i],
                     samples[i], values[i]);
}

// The values of these filters at all pixels sum to a constant.
void CheckSumOverPixels(const Filter& filter, Findings* findings) {
  double least = 1e9, largest = 0;
  for (int i = 0; i < 16; ++i) {
    double sum = 0;
    const Real x = (Real(i) + Real(.5)) / 16;
    for (int k = -3; k <= 3; ++k) sum += double(filter.Evaluate({x + Real(k), Real(.01)}));
    least = std::min(least, sum), largest = std::max(largest, sum);
  }
  findings->Expect(largest - least < .01 * largest, "sum of a filter over pixels", least, largest);
}

}  // namespace

void ProbeSampling(const ProbedScene& scene, std::uint64_t seed, Findings* findings) {
  const auto columns = ColumnsOf(*scene.Setup().sampler, seed);
  for (std::size_t a = 0; a < columns.size(); ++a) {
    const double mean = MeanOf(columns[a].values);
    const std::string check = std::string("mean of ") + columns[a].name;
    findings->Expect(std::abs(mean - .5) < .06, check.c_str(), mean, .5);
    for (std::size_t b = 0; b < a; ++b) {
      const double correlation = CorrelationOf(columns[a].values, columns[b].values);
      const std::string pair = std::string(columns[a].name) + " with " + columns[b].name;
      findings->Expect(std::abs(correlation) < .25, pair.c_str(), correlation, 0);
    }
  }
  constexpr std::array<const char*, 5> kNames{"box", "triangle", "gaussian", "mitchell", "sinc"};
  RandomStream random = scene.Stream(10);
  const std::size_t kind = std::size_t(random.Bits() % kNames.size());
  const double width = .5 + 2 * double(random.Uniform()),
               height = .5 + 2 * double(random.Uniform());
  const LoadedScene loaded = LoadSceneText(FilterScene(kNames[kind], width, height));
  CheckMoments(*loaded.setup->filter, findings);
  constexpr std::array<double, 5> kSummingWidths{.5, 1, 0, 2, 0};
  if (kSummingWidths[kind] > 0) {
    const LoadedScene summing =
        LoadSceneText(FilterScene(kNames[kind], kSummingWidths[kind], kSummingWidths[kind]));
    CheckSumOverPixels(*summing.setup->filter, findings);
  }
}

}  // namespace exphoton::random_scenes
