// SPDX-License-Identifier: BSD-2-Clause
// The pictures are reduced to sums over small cells once; all tests combine cells.
#include "core/imaging/metrics/noise_test.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/imaging/metrics/metrics.h"

namespace exphoton {
namespace {

constexpr int kCellPixels = 8;      // wider than the support of every pixel filter
constexpr int kBlockCells = 4;      // cells along the side of a block
constexpr double kRounding = 1e-5;  // relative error of a mean of 16-bit values
// Filters that share samples between pixels correlate neighbouring cells, too. A box of 3 x 3
// pixels makes the variance of a mean 1.27 times the sum over cells: (8 / (6 + 2 (4/9 + 1/9)))^2.
constexpr double kNeighbours = 1.3;
constexpr double kMedianChiSquare1 = .4549364;
constexpr int kMinReplicates = 3;

using Color = std::array<double, 3>;

// The channels R, G and B of a layer; nullopt if one is missing. "" is the picture itself.
struct ColorLayer {
  const Image* image;
  std::array<int, 3> channels;
};

constexpr const char* kVariance = "variance";

std::optional<ColorLayer> FindLayer(const Image& image, const std::string& name) {
  // pbrt and older pictures write the layer with a capital.
  if (name == kVariance && image.FindChannel("Variance.R") >= 0)
    return FindLayer(image, "Variance");
  const std::string prefix = name.empty() ? "" : name + ".";
  ColorLayer layer{&image, {}};
  for (std::size_t c = 0; c < 3; ++c) {
    layer.channels[c] = image.FindChannel(prefix + "RGB"[c]);
    if (layer.channels[c] < 0) return {};
  }
  return layer;
}

// Cells of about 8 x 8 pixels, and blocks of 4 x 4 cells.
struct CellGrid {
  int width, height, cell;  // pixels
  int columns, rows;        // cells

  CellGrid(int aWidth, int aHeight)
      : width(aWidth),
        height(aHeight),
        cell(std::clamp(std::min(aWidth, aHeight) / kBlockCells, 1, kCellPixels)),
        columns((aWidth + cell - 1) / cell),
        rows((aHeight + cell - 1) / cell) {}

  int Count() const { return columns * rows; }
  std::size_t At(int x, int y) const { return std::size_t(y / cell * columns + x / cell); }
  // A part of the grid, in cells. The upper bounds are exclusive.
  std::vector<PixelBounds> Blocks() const {
    std::vector<PixelBounds> blocks;
    for (int y = 0; y < rows; y += kBlockCells)
      for (int x = 0; x < columns; x += kBlockCells)
        blocks.push_back(
            {x, y, std::min(x + kBlockCells, columns), std::min(y + kBlockCells, rows)});
    return blocks;
  }
  PixelBounds Pixels(const PixelBounds& cells) const {
    return {cells.x0 * cell, cells.y0 * cell, std::min(cells.x1 * cell, width),
            std::min(cells.y1 * cell, height)};
  }
};

using CellSums = std::vector<Color>;  // by cell

// The noise of a picture by cells, from an estimated variance of each pixel.
struct CellNoise {
  CellSums variances, squares;  // sums of the pixels' variances, and of their squares
  CellSums differences;         // of (half1 - half2) / 2; empty if the layer variance is used
};

// One side of the comparison. Its pictures are independent estimates of the same picture.
struct Side {
  std::vector<CellSums> pictures;
  std::vector<CellNoise> noise;  // of each picture; empty for NoiseSource::Replicates
};

class CellPictures {
 public:
  CellPictures(std::span<const Image> references, const Image& picture)
      : grid_(picture.Width(), picture.Height()), counts_(std::size_t(grid_.Count())) {
    MarkFinite(references, picture);
  }

  const CellGrid& Cells() const { return grid_; }
  double Count(std::size_t cell) const { return counts_[cell]; }

  // Returns the sums over the finite pixels of a power of factor * (first - second), where second
  // may be null.
  CellSums Sum(const ColorLayer& first, const ColorLayer* second, double factor,
               int power = 1) const {
    CellSums sums(std::size_t(grid_.Count()), Color{});
    for (int y = 0; y < grid_.height; ++y) {
      for (int x = 0; x < grid_.width; ++x) {
        if (!isFinite_[std::size_t(y) * std::size_t(grid_.width) + std::size_t(x)]) continue;
        Color& sum = sums[grid_.At(x, y)];
        for (std::size_t c = 0; c < 3; ++c) {
          double value = double(first.image->At(x, y, first.channels[c]));
          if (second) value -= double(second->image->At(x, y, second->channels[c]));
          value *= factor;
          sum[c] += power == 1 ? value : power == 2 ? value * value : std::pow(value, power);
        }
      }
    }
    return sums;
  }

 private:
  void MarkFinite(std::span<const Image> references, const Image& picture) {
    isFinite_.assign(std::size_t(grid_.width) * std::size_t(grid_.height), true);
    std::vector<const Image*> all{&picture};
    for (const Image& reference : references) all.push_back(&reference);
    for (const Image* image : all) {
      for (const char* name : {"", "half1", "half2", kVariance}) {
        const std::optional<ColorLayer> layer = FindLayer(*image, name);
        if (!layer) continue;
        for (int y = 0; y < grid_.height; ++y)
          for (int x = 0; x < grid_.width; ++x)
            for (const int channel : layer->channels)
              if (!std::isfinite(image->At(x, y, channel)))
                isFinite_[std::size_t(y) * std::size_t(grid_.width) + std::size_t(x)] = false;
      }
    }
    for (int y = 0; y < grid_.height; ++y)
      for (int x = 0; x < grid_.width; ++x)
        counts_[grid_.At(x, y)] +=
            isFinite_[std::size_t(y) * std::size_t(grid_.width) + std::size_t(x)];
  }

  CellGrid grid_;
  std::vector<double> counts_;  // finite pixels by cell
  std::vector<bool> isFinite_;
};

// Adds estimated variances that have one degree of freedom each: squares of normal values, whose
// squares have the mean 3 sigma^4. The effective degrees of freedom follow Satterthwaite 1946.
// Subtracting 2 removes the bias: one dominant variance gives 1, and n equal ones give n - 2.
struct VarianceSum {
  double sum = 0, squares = 0, count = 0;

  double DegreesOfFreedom() const {
    return squares > 0 ? std::clamp(3 * sum * sum / squares - 2, 1., count) : 1;
  }
};

class Tester {
 public:
  Tester(const CellPictures& comparison, const Side& reference, const Side& picture,
         NoiseSource source)
      : comparison_(comparison), reference_(reference), picture_(picture), source_(source) {
    if (source_ != NoiseSource::Replicates) inflation_ = Inflation();
  }

  NoiseFinding Test(const PixelBounds& cells, std::size_t channel) const {
    NoiseFinding finding;
    finding.channel = std::string(1, "RGB"[channel]);
    finding.part = comparison_.Cells().Pixels(cells);
    const double count = Over(cells, [&](std::size_t i) { return comparison_.Count(i); });
    if (count == 0) return finding;
    const double r = MeanOf(reference_, cells, channel, count);
    const double difference = MeanOf(picture_, cells, channel, count) - r;
    finding.relativeDifference = r != 0 ? difference / r : difference > 0 ? HUGE_VAL : 0;
    if (difference == 0) return finding;
    double degrees = 1;
    double variance = source_ == NoiseSource::Replicates
                          ? ReplicateVariance(cells, channel, count, &degrees)
                          : CellVariance(cells, channel, count, &degrees);
    variance += kRounding * kRounding * r * r;
    finding.p = variance > 0 ? StudentTail(difference / std::sqrt(variance), degrees) : 0;
    return finding;
  }

 private:
  template <class Value>
  double Over(const PixelBounds& cells, const Value& value) const {
    double sum = 0;
    for (int y = cells.y0; y < cells.y1; ++y)
      for (int x = cells.x0; x < cells.x1; ++x)
        sum += value(std::size_t(y * comparison_.Cells().columns + x));
    return sum;
  }
  double SumOf(const CellSums& sums, const PixelBounds& cells, std::size_t channel) const {
    return Over(cells, [&](std::size_t i) { return sums[i][channel]; });
  }
  double MeanOf(const CellSums& sums, const PixelBounds& cells, std::size_t channel,
                double count) const {
    return SumOf(sums, cells, channel) / count;
  }
  double MeanOf(const Side& side, const PixelBounds& cells, std::size_t channel,
                double count) const {
    double sum = 0;
    for (const CellSums& sums : side.pictures) sum += MeanOf(sums, cells, channel, count);
    return sum / double(side.pictures.size());
  }

  // Pooled over both sides. A side of one picture adds no knowledge of the noise.
  double ReplicateVariance(const PixelBounds& cells, std::size_t channel, double count,
                           double* degrees) const {
    double squares = 0, inverse = 0;
    *degrees = 0;
    for (const Side* side : {&reference_, &picture_}) {
      const double mean = MeanOf(*side, cells, channel, count);
      for (const CellSums& sums : side->pictures)
        squares += std::pow(MeanOf(sums, cells, channel, count) - mean, 2);
      *degrees += double(side->pictures.size()) - 1;
      inverse += 1 / double(side->pictures.size());
    }
    return squares / *degrees * inverse;
  }

  double CellVariance(const PixelBounds& cells, std::size_t channel, double count,
                      double* degrees) const {
    VarianceSum variance;
    for (const Side* side : {&reference_, &picture_}) {
      const double scale = 1 / (count * double(side->pictures.size())), scale2 = scale * scale;
      for (const CellNoise& noise : side->noise) {
        variance.sum += scale2 * SumOf(noise.variances, cells, channel);
        variance.squares += scale2 * scale2 * SumOf(noise.squares, cells, channel);
        variance.count += count;
      }
    }
    // Pixels that share samples count as fewer.
    *degrees = std::max(1., variance.DegreesOfFreedom() / inflation_);
    return variance.sum * inflation_;
  }

  // Returns the factor by which the variance of a mean exceeds its value for independent pixels, as
  // filters share samples between pixels. It compares cells with the sum of their pixels. The
  // median ignores the few cells between which the pictures really differ.
  double Inflation() const {
    std::vector<double> ratios;
    const auto add = [&ratios](double difference, double variance) {
      if (variance > 0) ratios.push_back(difference * difference / variance);
    };
    const int columns = comparison_.Cells().columns;
    for (int i = 0; i + 1 < comparison_.Cells().Count(); ++i) {
      const auto cell = std::size_t(i);
      for (std::size_t c = 0; c < 3; ++c) {
        for (const Side* side : {&reference_, &picture_})
          for (const CellNoise& noise : side->noise)
            if (!noise.differences.empty())
              add(noise.differences[cell][c], noise.variances[cell][c]);
        if (source_ == NoiseSource::Halves || i % columns == columns - 1) continue;
        const auto [a, varianceA] = DifferenceAt(cell, c);
        const auto [b, varianceB] = DifferenceAt(cell + 1, c);
        add(a - b, varianceA + varianceB);
      }
    }
    if (ratios.empty()) return 1;
    const auto middle = ratios.begin() + std::ptrdiff_t(ratios.size() / 2);
    std::nth_element(ratios.begin(), middle, ratios.end());
    const double factor = std::max(1., *middle / kMedianChiSquare1);
    return factor * std::min(kNeighbours, 1 + (kNeighbours - 1) * (factor - 1));
  }
  // Returns the difference of a cell's means, and its predicted variance.
  std::pair<double, double> DifferenceAt(std::size_t cell, std::size_t channel) const {
    const double count = comparison_.Count(cell);
    if (count == 0) return {0, 0};
    double difference = 0, variance = 0, sign = -1;
    for (const Side* side : {&reference_, &picture_}) {
      const double pictures = double(side->pictures.size());
      for (const CellSums& sums : side->pictures)
        difference += sign * sums[cell][channel] / (count * pictures);
      for (const CellNoise& noise : side->noise)
        variance += noise.variances[cell][channel] / (count * count * pictures * pictures);
      sign = 1;
    }
    return {difference, variance};
  }

  const CellPictures& comparison_;
  const Side &reference_, &picture_;
  const NoiseSource source_;
  double inflation_ = 1;
};

bool HaveLayer(std::span<const Image> references, const Image& picture, const char* name) {
  bool all = FindLayer(picture, name).has_value();
  for (const Image& reference : references) all = all && FindLayer(reference, name);
  return all;
}

NoiseSource ChooseSource(std::span<const Image> references, const Image& picture,
                         const NoiseTestOptions& options, std::string* reason) {
  const bool haveHalves =
      HaveLayer(references, picture, "half1") && HaveLayer(references, picture, "half2");
  if (haveHalves) return options.sharesNoise ? NoiseSource::Replicates : NoiseSource::Halves;
  if (references.size() >= kMinReplicates) return NoiseSource::Replicates;
  const bool haveVariance = HaveLayer(references, picture, kVariance);
  if (haveVariance && !options.sharesNoise) return NoiseSource::Variance;
  *reason = haveVariance ? "the layer variance lacks noise that pixels share, such as the noise of "
                           "photons: render with --two-halves"
                         : "the pictures have no layers of halves or variance: render with "
                           "--two-halves";
  return NoiseSource::None;
}

Side MakeSide(const CellPictures& comparison, std::span<const Image> images, NoiseSource source) {
  Side side;
  for (const Image& image : images) {
    const std::optional<ColorLayer> whole = FindLayer(image, ""), first = FindLayer(image, "half1"),
                                    second = FindLayer(image, "half2"),
                                    variance = FindLayer(image, kVariance);
    const bool splits = source == NoiseSource::Replicates && first && second;
    if (splits) {
      side.pictures.push_back(comparison.Sum(*first, nullptr, 1));
      side.pictures.push_back(comparison.Sum(*second, nullptr, 1));
    } else {
      side.pictures.push_back(comparison.Sum(*whole, nullptr, 1));
    }
    if (source == NoiseSource::Halves)
      side.noise.push_back({comparison.Sum(*first, &*second, .5, 2),
                            comparison.Sum(*first, &*second, .5, 4),
                            comparison.Sum(*first, &*second, .5)});
    if (source == NoiseSource::Variance)
      side.noise.push_back(
          {comparison.Sum(*variance, nullptr, 1), comparison.Sum(*variance, nullptr, 1, 2), {}});
  }
  return side;
}

// Continued fraction of the incomplete beta function (DLMF 8.17.22), by Lentz's method.
double BetaFraction(double a, double b, double x) {
  constexpr double kTiny = 1e-300;
  double c = 1, d = 1 - (a + b) * x / (a + 1);
  d = 1 / (std::abs(d) < kTiny ? kTiny : d);
  double result = d;
  for (int m = 1; m < 500; ++m) {
    for (const double term : {m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m)),
                              -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1))}) {
      d = 1 + term * d;
      c = 1 + term / c;
      d = 1 / (std::abs(d) < kTiny ? kTiny : d);
      c = std::abs(c) < kTiny ? kTiny : c;
      result *= c * d;
    }
    if (std::abs(c * d - 1) < 1e-14) break;
  }
  return result;
}

// The regularised incomplete beta function I_x(a, b).
double IncompleteBeta(double a, double b, double x) {
  if (x <= 0) return 0;
  if (x >= 1) return 1;
  const double front = std::exp(std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) +
                                a * std::log(x) + b * std::log1p(-x));
  return x < (a + 1) / (a + b + 2) ? front * BetaFraction(a, b, x) / a
                                   : 1 - front * BetaFraction(b, a, 1 - x) / b;
}

}  // namespace

double StudentTail(double t, double degreesOfFreedom) {
  const double x = degreesOfFreedom / (degreesOfFreedom + t * t);
  return IncompleteBeta(degreesOfFreedom / 2, .5, x);
}

NoiseTest TestAgainstNoise(std::span<const Image> references, const Image& picture,
                           const NoiseTestOptions& options) {
  for (const Image& reference : references) CompareImages(reference, picture);  // checks them
  NoiseTest result;
  result.source = ChooseSource(references, picture, options, &result.reason);
  if (result.source == NoiseSource::None) return result;
  const CellPictures comparison(references, picture);
  const Side reference = MakeSide(comparison, references, result.source);
  const Side other = MakeSide(comparison, {&picture, 1}, result.source);
  const Tester tester(comparison, reference, other, result.source);
  const CellGrid& grid = comparison.Cells();
  const std::vector<PixelBounds> blocks = grid.Blocks();
  for (std::size_t c = 0; c < 3; ++c) {
    const NoiseFinding mean = tester.Test({0, 0, grid.columns, grid.rows}, c);
    if (c == 0 || mean.p < result.mean.p) result.mean = mean;
    for (const PixelBounds& block : blocks) {
      const NoiseFinding found = tester.Test(block, c);
      if (result.block.channel.empty() || found.p < result.block.p) result.block = found;
    }
  }
  result.count = 3 + 3 * int(blocks.size());
  result.threshold = -std::expm1(std::log1p(-options.significance) / result.count);
  return result;
}

}  // namespace exphoton
