// SPDX-License-Identifier: BSD-2-Clause
// This file has helpers for tests of samplers: the samplers to test, a layout with every kind of
// request, and checks that points are stratified, nets or uncorrelated.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/sampling/sampler.h"

namespace exphoton {

inline const char* const kSamplers[] = {
    R"("random" "integer xsamples" 4 "integer ysamples" 4)",
    R"("stratified" "integer xsamples" 4 "integer ysamples" 4)",
    R"("stratified" "integer xsamples" 16 "integer ysamples" 1 "bool jitter" "false")",
    R"("lowdiscrepancy" "integer pixelsamples" 16)",
    R"("halton" "integer pixelsamples" 18)",
    R"("bestcandidate" "integer pixelsamples" 18)",
};

struct Requests {
  SampleLayout layout;
  int one, eight, one2, sixteen2, odd, odd2;

  Requests()
      : one(layout.Request1D(1)),
        eight(layout.Request1D(8)),
        one2(layout.Request2D(1)),
        sixteen2(layout.Request2D(16)),
        odd(layout.Request1D(7)),
        odd2(layout.Request2D(13)) {
    layout.Request2D(0);
  }
};

// Returns all numbers of a sample in one list.
inline std::vector<Real> Flatten(const CameraSamples& s) {
  std::vector<Real> all = {s.film.x, s.film.y, s.lens.x, s.lens.y, s.time};
  for (int i = 0; i < s.Count1D(); ++i)
    for (Real u : s.Array1D(i)) all.push_back(u);
  for (int i = 0; i < s.Count2D(); ++i)
    for (Point2 u : s.Array2D(i)) all.insert(all.end(), {u.x, u.y});
  return all;
}

inline std::vector<Real> MakeSamples(const Sampler& sampler, const SampleKey& key) {
  CameraSamples samples{Requests().layout};
  sampler.Generate(key, &samples);
  return Flatten(samples);
}

// Returns whether all strata of [0,1) hold the same number of values.
inline testing::AssertionResult IsStratified(const std::vector<Real>& values, int strata) {
  std::vector<int> counts(std::size_t(strata), 0);
  for (Real v : values) ++counts[std::size_t(double(v) * strata)];
  for (int count : counts) {
    if (count * strata != int(values.size()))
      return testing::AssertionFailure() << count << " values in one of " << strata << " strata";
  }
  return testing::AssertionSuccess();
}

inline testing::AssertionResult IsStratified(const std::vector<Point2>& points, int columns,
                                             int rows) {
  std::vector<Real> cells;
  for (Point2 p : points) {
    const int cell = int(double(p.x) * columns) + columns * int(double(p.y) * rows);
    cells.push_back(Real((cell + .5) / (columns * rows)));
  }
  return IsStratified(cells, columns * rows);
}

// Tests every way to cut the square into 2^k equal dyadic rectangles.
inline testing::AssertionResult IsNet(const std::vector<Point2>& points) {
  const int n = int(points.size());
  for (int columns = 1; columns <= n; columns *= 2) {
    auto result = IsStratified(points, columns, n / columns);
    if (!result) return result << " (" << columns << " columns)";
  }
  return testing::AssertionSuccess();
}

// Returns one column of values over many pixels for each number of a sample. `value` maps a number
// of the sampler to a number with mean 0.
template <class F>
std::vector<std::vector<double>> Columns(const Sampler& sampler, int pixels, F&& value) {
  std::vector<std::vector<double>> columns;
  for (int i = 0; i < pixels; ++i) {
    const std::vector<Real> values = MakeSamples(sampler, {1, {i, 2 * i + 1}, i % 16});
    columns.resize(values.size());
    for (std::size_t j = 0; j < values.size(); ++j) columns[j].push_back(value(double(values[j])));
  }
  return columns;
}

// Returns whether no two of the chosen columns, each uniform on [-.5, .5), are correlated. The
// standard deviation of a correlation is 1/sqrt(n). The limit is 5 standard deviations, which 36
// tests exceed by chance with probability 2e-5.
inline testing::AssertionResult AreUncorrelated(const std::vector<std::vector<double>>& columns,
                                                const std::vector<std::size_t>& chosen) {
  for (const std::size_t a : chosen) {
    for (const std::size_t b : chosen) {
      if (a >= b) continue;
      const double n = double(columns[a].size());
      double sum = 0;
      for (std::size_t i = 0; i < columns[a].size(); ++i) sum += columns[a][i] * columns[b][i];
      if (!(std::abs(sum / n * 12) < 5 / std::sqrt(n)))
        return testing::AssertionFailure() << "columns " << a << " and " << b << " correlate";
    }
  }
  return testing::AssertionSuccess();
}

}  // namespace exphoton
