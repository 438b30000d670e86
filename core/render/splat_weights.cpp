// SPDX-License-Identifier: BSD-2-Clause
// SplatWeights: the filter's properties are found by evaluating it on a grid.
#include "core/render/splat_weights.h"

#include <algorithm>
#include <cmath>

namespace exphoton {
namespace {

constexpr int kMaxReach = 8;  // pixels
constexpr int kGrid = 64;     // points of a grid over half the width

Point2 GridPoint(const Filter& filter, double x, double y) {
  return {Real(x / kGrid * double(filter.XWidth())), Real(y / kGrid * double(filter.YWidth()))};
}

int ReachOf(const Filter& filter) {
  return int(std::floor(double(std::max(filter.XWidth(), filter.YWidth())) + .5));
}

bool IsProduct(const Filter& filter) {
  const double top = double(filter.Evaluate({0, 0}));
  if (!(top > 0)) return false;
  for (int y = 1; y < kGrid; y += 3) {
    for (int x = 1; x < kGrid; x += 3) {
      const double f = double(filter.Evaluate(GridPoint(filter, x, y)));
      const double product = double(filter.Evaluate(GridPoint(filter, x, 0))) *
                             double(filter.Evaluate(GridPoint(filter, 0, y)));
      if (std::abs(product / top - f) > 1e-4 * top) return false;
    }
  }
  return true;
}

struct FilterIntegrals {
  double value = 0, size = 0, square = 0;  // of f, |f| and f^2
};

// The midpoint rule over the whole support of the even filter.
FilterIntegrals IntegralsOf(const Filter& filter) {
  FilterIntegrals sum;
  for (int y = -kGrid; y < kGrid; ++y) {
    for (int x = -kGrid; x < kGrid; ++x) {
      const double f = double(filter.Evaluate(GridPoint(filter, x + .5, y + .5)));
      sum.value += f;
      sum.size += std::abs(f);
      sum.square += f * f;
    }
  }
  for (double* each : {&sum.value, &sum.size, &sum.square})
    *each = *each * double(filter.XWidth()) * double(filter.YWidth()) / (kGrid * kGrid);
  return sum;
}

// Returns whether splatting has more variance than importance sampling, because few samples lie
// within the support. For n samples of variance s^2 in a pixel and an integral of f of 1, the
// variance is s^2 / n times the integral of f^2 with splatting, and s^2 / n times the square of the
// integral of |f| with importance sampling. A film cannot show a filter that is importance sampled
// and whose integral of |f| is 2 or more (Film::Pixel::Mean).
bool IsNarrow(const Filter& filter) {
  const FilterIntegrals f = IntegralsOf(filter);
  return f.size < 2 * f.value && f.square > f.size * f.size;
}

}  // namespace

bool HasNegativeValues(const Filter& filter) {
  const Real limit = Real(-1e-4) * filter.Evaluate({0, 0});
  for (int y = 0; y < kGrid; ++y)
    for (int x = 0; x < kGrid; ++x)
      if (filter.Evaluate(GridPoint(filter, x, y)) < limit) return true;
  return false;
}

std::unique_ptr<const SplatWeights> SplatWeights::Of(const Filter& filter) {
  if (ReachOf(filter) > kMaxReach || !HasNegativeValues(filter) || IsNarrow(filter)) return nullptr;
  return std::make_unique<const SplatWeights>(filter);
}

SplatWeights::SplatWeights(const Filter& filter)
    : filter_(filter),
      reach_(ReachOf(filter)),
      isSeparable_(IsProduct(filter)),
      scale_(1 / IntegralsOf(filter).value) {}

void SplatWeights::Fill(Point2 place, std::vector<double>* weights) const {
  const int width = Width();
  weights->resize(std::size_t(width) * std::size_t(width));
  // From the centre of the pixel at this offset to the sample
  const auto distance = [](Real u, int offset) { return u - Real(.5) - Real(offset); };
  double* out = weights->data();
  if (!isSeparable_) {
    for (int y = -reach_; y <= reach_; ++y)
      for (int x = -reach_; x <= reach_; ++x)
        *out++ = scale_ * double(filter_.Evaluate({distance(place.x, x), distance(place.y, y)}));
    return;
  }
  double columns[2 * kMaxReach + 1];
  const double top = double(filter_.Evaluate({0, 0}));
  for (int x = -reach_; x <= reach_; ++x)
    columns[x + reach_] = scale_ / top * double(filter_.Evaluate({distance(place.x, x), 0}));
  for (int y = -reach_; y <= reach_; ++y) {
    const double row = double(filter_.Evaluate({0, distance(place.y, y)}));
    for (int x = 0; x < width; ++x) *out++ = row * columns[x];
  }
}

}  // namespace exphoton
