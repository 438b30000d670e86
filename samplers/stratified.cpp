// SPDX-License-Identifier: BSD-2-Clause
// The sampler "stratified" takes one point in each cell of an xsamples by ysamples grid, in an
// order of cells that differs between requests. Arrays are correlated multi-jittered (Kensler
// 2013). Each stratum of an array is divided once more among the samples of the pixel.
#include <cmath>
#include <utility>

#include "core/math/sampling/random.h"
#include "core/plugin.h"

namespace exphoton {
namespace {

constexpr std::uint64_t kGolden = 0x9e3779b97f4a7c15ull;

struct Settings {
  bool jitter = true;
  int xSamples = 2, ySamples = 2;
};

const ParamTable<Settings>& Parameters() {
  static const ParamTable<Settings> table{
      Param("jitter", &Settings::jitter,
            "random points within the cells of film, lens and time; else their centres"),
      Param("xsamples", &Settings::xSamples, "columns of cells in a pixel").Range(1, 32768),
      Param("ysamples", &Settings::ySamples, "rows of cells in a pixel").Range(1, 32768)};
  return table;
}

// Grid is a grid of x by y cells. For returns the most nearly square grid of `count` cells, or of a
// few more cells if `count` has no suitable divisors.
struct Grid {
  std::uint32_t x, y;

  static Grid For(std::uint32_t count) {
    const auto root = std::uint32_t(std::sqrt(double(count)));
    std::uint32_t x = std::max(root, 1u);
    while (count % x != 0) --x;
    if (count / x <= 4 * x) return {x, count / x};
    const std::uint32_t columns = root + 1;
    return {columns, (count + columns - 1) / columns};
  }
  std::uint32_t Count() const { return x * y; }
};

// Returns (cell + offset) / count, corrected where rounding would leave the cell.
Real InCell(double cell, double offset, double count) {
  const Real v = Real((cell + offset) / count);
  if (double(v) * count >= cell + 1) return NextDown(v);
  if (double(v) * count < cell) return NextUp(v);
  return v;
}

// SamplePlace is the place of one sample among the samples of its pixel, for one request.
struct SamplePlace {
  std::uint64_t pixelKey;   // hash of (seed, pixel, round, request): the same for all samples
  std::uint64_t sampleKey;  // hash of pixelKey and the sample
  std::uint32_t cell;       // the sample's cell in this request's order
  std::uint32_t cells;

  // Returns the part of stratum `number`, 0 to cells - 1, that this sample takes. The samples of a
  // pixel take each part once.
  std::uint32_t PartOf(std::uint32_t number, std::uint64_t axis) const {
    const std::uint64_t bits = MixBits(pixelKey + axis + kGolden * (number + 1));
    const auto rotation = std::uint32_t((bits >> 32) * cells >> 32);
    return std::uint32_t((std::uint64_t(cell) + rotation) % cells);
  }
};

template <class T>
void Shuffle(std::span<T> values, RandomStream* random) {
  for (std::size_t i = values.size(); i > 1; --i)
    std::swap(values[i - 1], values[(random->Bits() >> 32) * i >> 32]);
}

void FillArray(const SamplePlace& place, std::span<Real> values) {
  RandomStream random(place.sampleKey);
  const auto n = std::uint32_t(values.size());
  for (std::uint32_t j = 0; j < n; ++j) {
    const double part = (place.PartOf(j, 0) + double(random.Uniform())) / place.cells;
    values[j] = InCell(j, part, n);
  }
  Shuffle(values, &random);
}

// Fills columns x rows cells with one point each. Within a column (row) the points lie in different
// finer columns (rows), so that each axis alone is stratified too.
void FillArray(const SamplePlace& place, std::span<Point2> values) {
  RandomStream random(place.sampleKey);
  const auto n = std::uint32_t(values.size());
  std::uint32_t rows = std::uint32_t(std::sqrt(double(n)));
  while (n % rows != 0) --rows;
  const std::uint32_t columns = n / rows;
  const auto value = [&](std::uint32_t stratum, std::uint64_t axis) {
    const double part = (place.PartOf(stratum, axis) + double(random.Uniform())) / place.cells;
    return InCell(stratum, part, n);
  };
  const auto xKey = std::uint32_t(random.Bits()), yKey = std::uint32_t(random.Bits());
  for (std::uint32_t row = 0; row < rows; ++row) {
    const std::uint32_t fine = PermuteIndex(row, rows, xKey);
    for (std::uint32_t column = 0; column < columns; ++column)
      values[row * columns + column].x = value(column * rows + fine, 0);
  }
  for (std::uint32_t column = 0; column < columns; ++column) {
    const std::uint32_t fine = PermuteIndex(column, columns, yKey);
    for (std::uint32_t row = 0; row < rows; ++row)
      values[row * columns + column].y = value(row * columns + fine, 1);
  }
  Shuffle(values, &random);
}

class StratifiedSampler final : public Sampler {
 public:
  StratifiedSampler(std::int64_t count, Grid grid, bool jitter)
      : count_(count), grid_(grid), jitter_(jitter) {}

  std::int64_t SamplesPerPixel() const override { return count_; }
  std::unique_ptr<Sampler> WithSamplesPerPixel(std::int64_t count) const override {
    count = std::clamp<std::int64_t>(count, 1, 1 << 30);
    return std::make_unique<StratifiedSampler>(count, Grid::For(std::uint32_t(count)), jitter_);
  }

  std::uint64_t FillCamera(const SampleKey& key, CameraSamples* samples) const override {
    // Samples beyond the last cell begin another round with other keys.
    const std::uint64_t round = std::uint64_t(key.index) / grid_.Count();
    const std::uint64_t pixelKey = HashKey(
        {key.seed, std::uint64_t(key.pixel.x), std::uint64_t(key.pixel.y), round, 0x73747261});
    samples->film = InGrid(PlaceOf(pixelKey, key.index, 1), jitter_);
    if (samples->NeedsLens()) samples->lens = InGrid(PlaceOf(pixelKey, key.index, 2), jitter_);
    if (samples->NeedsTime()) samples->time = InRow(PlaceOf(pixelKey, key.index, 3), jitter_);
    return pixelKey;
  }
  void Fill(std::uint64_t pixelKey, std::int64_t index, int request,
            std::span<Real> values) const override {
    const SamplePlace place = PlaceOf(pixelKey, index, kFirstArray + std::uint64_t(request));
    if (values.size() == 1)
      values[0] = InRow(place, true);
    else
      FillArray(place, values);
  }
  void Fill(std::uint64_t pixelKey, std::int64_t index, int request,
            std::span<Point2> values) const override {
    const SamplePlace place = PlaceOf(pixelKey, index, kFirstArray + std::uint64_t(request));
    if (values.size() == 1)
      values[0] = InGrid(place, true);
    else
      FillArray(place, values);
  }

 private:
  static constexpr std::uint64_t kFirstArray = 4;  // after film, lens and time

  SamplePlace PlaceOf(std::uint64_t pixelKey, std::int64_t sample, std::uint64_t number) const {
    const std::uint64_t request = pixelKey + kGolden * number;
    const auto index = std::uint32_t(std::uint64_t(sample) % grid_.Count());
    SamplePlace place{request, MixBits(request + MixBits(index + kGolden)), 0, grid_.Count()};
    place.cell = PermuteIndex(index, place.cells, std::uint32_t(MixBits(request)));
    return place;
  }
  Point2 InGrid(const SamplePlace& place, bool jitter) const {
    RandomStream random(place.sampleKey);
    const double dx = jitter ? double(random.Uniform()) : .5;
    const double dy = jitter ? double(random.Uniform()) : .5;
    return {InCell(place.cell % grid_.x, dx, grid_.x), InCell(place.cell / grid_.x, dy, grid_.y)};
  }
  Real InRow(const SamplePlace& place, bool jitter) const {
    RandomStream random(place.sampleKey);
    return InCell(place.cell, jitter ? double(random.Uniform()) : .5, place.cells);
  }
  std::int64_t count_;
  Grid grid_;
  bool jitter_;
};

std::unique_ptr<Sampler> Create(const Settings& settings, const SamplerContext&) {
  const Grid grid{std::uint32_t(settings.xSamples), std::uint32_t(settings.ySamples)};
  return std::make_unique<StratifiedSampler>(grid.Count(), grid, settings.jitter);
}

}  // namespace
}  // namespace exphoton

EXPHOTON_SAMPLER("stratified", "jittered cells of a grid")
