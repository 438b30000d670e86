// SPDX-License-Identifier: BSD-2-Clause
// Separate sums over pixels in double precision. A pixel that is not finite in any picture is left
// out.
#include "core/app/analysis/separation.h"

#include <algorithm>
#include <array>

#include "core/imaging/metrics/metrics.h"

namespace exphoton::study {
namespace {

// Returns R, G, B of each pixel, row by row.
std::vector<float> Colors(const Image& image, const std::string& name) {
  const std::array<int, 3> from = FindColors(image, name);
  std::vector<float> values;
  values.reserve(3 * std::size_t(image.Width()) * std::size_t(image.Height()));
  for (int y = 0; y < image.Height(); ++y)
    for (int x = 0; x < image.Width(); ++x)
      for (const int channel : from) values.push_back(image.At(x, y, channel));
  return values;
}

bool IsFinitePixel(const std::vector<float>& values, std::size_t pixel) {
  return std::isfinite(values[3 * pixel]) && std::isfinite(values[3 * pixel + 1]) &&
         std::isfinite(values[3 * pixel + 2]);
}

// Sums computes weighted means over the pixels that are finite in the reference and in all
// pictures.
class Sums {
 public:
  Sums(const std::vector<std::vector<float>>& pictures, const std::vector<float>& truth)
      : pictures_(pictures), truth_(truth) {
    for (std::size_t p = 0; p < truth.size() / 3; ++p) {
      bool counts = IsFinitePixel(truth, p);
      for (const auto& picture : pictures) counts = counts && IsFinitePixel(picture, p);
      if (counts) pixels_.push_back(p);
    }
  }
  const std::vector<std::size_t>& Pixels() const { return pixels_; }
  double Count() const { return 3 * double(pixels_.size()); }

  // Returns mean w (x_k - r)^2.
  double RelMse(std::size_t k) const {
    double sum = 0;
    ForValues([&](std::size_t i, double w) {
      const double d = double(pictures_[k][i]) - double(truth_[i]);
      sum += w * d * d;
    });
    return sum / Count();
  }
  // Returns mean w s^2 over all seeds except `without`, or over all seeds if `without` >= K.
  double Variance(std::size_t without) const {
    const std::size_t all = pictures_.size();
    const double count = double(without < all ? all - 1 : all);
    double sum = 0;
    ForValues([&](std::size_t i, double w) {
      double mean = 0, squares = 0;
      for (std::size_t k = 0; k < all; ++k)
        if (k != without) mean += double(pictures_[k][i]) / count;
      for (std::size_t k = 0; k < all; ++k) {
        const double d = double(pictures_[k][i]) - mean;
        if (k != without) squares += d * d;
      }
      sum += w * squares / (count - 1);
    });
    return sum / Count();
  }
  template <class Visit>
  void ForValues(Visit&& visit) const {
    for (const std::size_t p : pixels_)
      for (std::size_t i = 3 * p; i < 3 * p + 3; ++i) visit(i, RelMseWeight(double(truth_[i])));
  }

 private:
  const std::vector<std::vector<float>>& pictures_;
  const std::vector<float>& truth_;
  std::vector<std::size_t> pixels_;
};

// Returns the jackknife standard error from the estimates that leave out one seed each.
double Jackknife(const std::vector<double>& partial) {
  const Measured mean = MeanOf(partial);
  double squares = 0;
  for (const double v : partial) squares += (v - mean.value) * (v - mean.value);
  const double count = double(partial.size());
  return std::sqrt((count - 1) / count * squares);
}

// Returns the standard error of 2 mean w (m - truth)(truth - r), m the mean picture and r the
// reference. This is the cross term of relMse between the error and the reference's noise. `noise`,
// (a - b) / 2, is a sample of that noise.
double CrossError(const Sums& sums, const std::vector<float>& mean, const std::vector<float>& truth,
                  const std::vector<float>& noise) {
  if (noise.empty()) return 0;
  double squares = 0;
  for (const std::size_t p : sums.Pixels()) {
    double pixel = 0;
    for (std::size_t i = 3 * p; i < 3 * p + 3; ++i)
      pixel +=
          RelMseWeight(double(truth[i])) * (double(mean[i]) - double(truth[i])) * double(noise[i]);
    squares += pixel * pixel;
  }
  return 2 * std::sqrt(squares) / sums.Count();
}

// BlockErrors holds sums over the pixels of a block, for one colour.
struct BlockErrors {
  double pixels = 0;
  double reference = 0;          // relative (a - b) / 2, a sample of the reference's noise
  std::vector<double> pictures;  // relative errors of each picture

  double MeanError() const {
    double mean = 0;
    for (const double sum : pictures) mean += sum / (pixels * double(pictures.size()));
    return mean;
  }
  // Returns the mean over pairs of pictures, except `without`, of the products of their mean
  // errors, minus the squared noise of the reference.
  double Squared(std::size_t without) const {
    double sum = 0, squares = 0, count = 0;
    for (std::size_t k = 0; k < pictures.size(); ++k) {
      if (k == without) continue;
      const double mean = pictures[k] / pixels;
      sum += mean, squares += mean * mean, ++count;
    }
    const double noise = reference / pixels;
    return (sum * sum - squares) / (count * (count - 1)) - noise * noise;
  }
};

// BlockMeans divides pictures into square blocks.
class BlockMeans {
 public:
  BlockMeans(const std::vector<std::vector<float>>& pictures, const std::vector<float>& truth,
             const Reference& reference, std::size_t blockWidth)
      : sums_(pictures, truth) {
    const auto width = std::size_t(reference.mean.Width()),
               height = std::size_t(reference.mean.Height());
    const std::size_t columns = (width + blockWidth - 1) / blockWidth,
                      rows = (height + blockWidth - 1) / blockWidth;
    blocks_.resize(columns * rows);
    sums_.ForValues([&](std::size_t i, double w) {
      const std::size_t x = i / 3 % width, y = i / 3 / width;
      BlockErrors& block = blocks_[y / blockWidth * columns + x / blockWidth][i % 3];
      const double scale = std::sqrt(w);
      block.pictures.resize(pictures.size());
      for (std::size_t k = 0; k < pictures.size(); ++k)
        block.pictures[k] += scale * (double(pictures[k][i]) - double(truth[i]));
      if (!reference.halfDifference.empty())
        block.reference += scale * double(reference.halfDifference[i]);
      ++block.pixels;
    });
  }

  // Returns the mean of the squared bias, without one of the pictures.
  double Squared(std::size_t without) const {
    double sum = 0;
    for (const auto& colors : blocks_)
      for (const BlockErrors& block : colors)
        if (block.pixels > 0) sum += block.pixels * block.Squared(without);
    return sum / sums_.Count();
  }
  // Returns the standard error of Squared by the noise N of the reference. In a block with the bias
  // B it adds 2 B N + N^2 - H^2, and H, which is taken off, is another sample of N. The variances
  // are about 4 B^2 H^2 and 4 H^4 / 3. The noise of the colours counts as the same.
  double ReferenceError() const {
    double variance = 0;
    for (const auto& colors : blocks_) {
      double cross = 0, squares = 0;
      for (const BlockErrors& block : colors) {
        if (block.pixels == 0) continue;
        cross += 2 * block.reference * block.MeanError();
        squares += block.reference * block.reference / block.pixels;
      }
      variance += cross * cross + 4. / 3 * squares * squares;
    }
    return std::sqrt(variance) / sums_.Count();
  }

 private:
  Sums sums_;
  std::vector<std::array<BlockErrors, 3>> blocks_;
};

}  // namespace

Measured MeanOf(const std::vector<double>& values) {
  Measured result;
  if (values.empty()) return result;
  const double count = double(values.size());
  result.value = 0;
  for (const double v : values) result.value += v / count;
  if (values.size() < 2) return result;
  double squares = 0;
  for (const double v : values) squares += (v - result.value) * (v - result.value);
  result.error = std::sqrt(squares / (count - 1) / count);
  return result;
}

Reference MakeReference(Image a) {
  FindColors(a, "the reference");
  return {std::move(a), {}, {}};
}

Reference MakeReference(const Image& a, const Image& b) {
  CompareImages(a, b);  // checks sizes and channels
  Reference reference;
  const std::vector<float> first = Colors(a, "half a"), second = Colors(b, "half b");
  reference.mean = Image(a.data, a.display, {"R", "G", "B"});
  std::vector<double> squares;  // of each pixel
  for (std::size_t i = 0; i < first.size(); ++i) {
    reference.mean.pixels[i] = float((double(first[i]) + double(second[i])) / 2);
    reference.halfDifference.push_back(float((double(first[i]) - double(second[i])) / 2));
  }
  for (std::size_t p = 0; p < first.size() / 3; ++p) {
    if (!IsFinitePixel(first, p) || !IsFinitePixel(second, p)) continue;
    double sum = 0;
    for (std::size_t i = 3 * p; i < 3 * p + 3; ++i) {
      const double d = double(reference.halfDifference[i]);
      sum += RelMseWeight(double(reference.mean.pixels[i])) * d * d / 3;
    }
    squares.push_back(sum);
  }
  reference.variance = MeanOf(squares);
  return reference;
}

double BlackError(const Reference& reference) {
  Image black = reference.mean;
  std::fill(black.pixels.begin(), black.pixels.end(), 0.f);
  return CompareImages(reference.mean, black).relMse;
}

Separation Separate(const std::vector<Image>& pictures, const Reference& reference) {
  Separation result;
  result.seeds = int(pictures.size());
  std::vector<std::vector<float>> values;
  for (const Image& picture : pictures) {
    CompareImages(reference.mean, picture);  // checks sizes and channels
    values.push_back(Colors(picture, "the picture"));
  }
  const std::vector<float> truth = Colors(reference.mean, "the reference");
  result.mean.resize(truth.size());
  for (std::size_t i = 0; i < truth.size(); ++i) {
    double sum = 0;
    for (const auto& picture : values) sum += double(picture[i]);
    result.mean[i] = float(sum / double(values.size()));
  }
  const Sums sums(values, truth);
  if (values.empty() || sums.Count() == 0) return result;
  const std::size_t count = values.size();
  std::vector<double> relMses;
  for (std::size_t k = 0; k < count; ++k) relMses.push_back(sums.RelMse(k));
  result.relMse = MeanOf(relMses);
  const double noise = reference.variance.IsKnown() ? reference.variance.value : 0;
  const double noiseError = std::isfinite(reference.variance.error) ? reference.variance.error : 0;
  const double cross = CrossError(sums, result.mean, truth, reference.halfDifference);
  result.error = {result.relMse.value - noise, std::hypot(result.relMse.error, noiseError, cross)};
  if (count < 2) return result;
  result.variance.value = sums.Variance(count);
  result.bias2.value = result.error.value - result.variance.value;
  if (count < 3) return result;
  std::vector<double> variances, biases;
  for (std::size_t k = 0; k < count; ++k) {
    double others = 0;
    for (std::size_t j = 0; j < count; ++j)
      if (j != k) others += relMses[j] / double(count - 1);
    variances.push_back(sums.Variance(k));
    biases.push_back(others - variances.back());
  }
  result.variance.error = Jackknife(variances);
  result.bias2.error = std::hypot(Jackknife(biases), noiseError, cross);
  return result;
}

Measured SeparateBlocks(const std::vector<Image>& pictures, const Reference& reference,
                        int blockWidth) {
  Measured result;
  const std::size_t count = pictures.size();
  if (count < 2) return result;
  std::vector<std::vector<float>> values;
  for (const Image& picture : pictures) values.push_back(Colors(picture, "the picture"));
  const std::vector<float> truth = Colors(reference.mean, "the reference");
  const BlockMeans blocks(values, truth, reference, std::size_t(blockWidth));
  result.value = blocks.Squared(count);
  if (count < 3) return result;
  std::vector<double> partial;
  for (std::size_t k = 0; k < count; ++k) partial.push_back(blocks.Squared(k));
  result.error = std::hypot(Jackknife(partial), blocks.ReferenceError());
  return result;
}

double ReferenceShortfall(const Reference& reference, double error) {
  if (!reference.variance.IsKnown()) return 0;
  if (!(error > 0)) return std::numeric_limits<double>::infinity();
  return reference.variance.value / (kMaxReferenceShare * error);
}

}  // namespace exphoton::study
