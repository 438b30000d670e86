// SPDX-License-Identifier: BSD-2-Clause
// CheckPicture compares pictures bit for bit, pixel by pixel and by means.
#include "tests/hardcases/picture_checks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "tests/support/equivalence.h"

namespace exphoton::hardcases {
namespace {

std::string Text(const char* format, auto... values) {
  std::array<char, 200> buffer{};
  std::snprintf(buffer.data(), buffer.size(), format, values...);
  return buffer.data();
}

// Converts "1%" to a fraction of the scale and any other word to an absolute number.
double Tolerance(const std::string& word, double scale) {
  const double number = std::stod(word);
  return word.back() == '%' ? number / 100 * std::abs(scale) : number;
}

double MeanOver(const Image& image, PixelBounds region) {
  if (region.IsEmpty()) region = {0, 0, image.Width(), image.Height()};
  double sum = 0;
  for (int y = region.y0; y < region.y1; ++y)
    for (int x = region.x0; x < region.x1; ++x)
      for (int c = 0; c < 3; ++c) sum += double(image.At(x, y, c));
  return sum / (3.0 * region.Width() * region.Height());
}

SeedEstimate Estimate(std::span<const Image> pictures, PixelBounds region) {
  std::vector<double> means;
  for (const Image& image : pictures) means.push_back(MeanOver(image, region));
  return EstimateFrom(means);
}

PictureResult CheckMean(const Check& check, std::span<const Image> pictures, PixelBounds region) {
  const double truth = std::stod(check.arguments.at(0));
  const double tolerance = Tolerance(check.arguments.at(1), truth);
  const SeedEstimate estimate = Estimate(pictures, region);
  const bool isRight = std::abs(estimate.mean - truth) + estimate.halfWidth <= tolerance;
  return {isRight, Text("mean %.5g ± %.2g (truth %.5g)", estimate.mean, estimate.halfWidth, truth),
          FalseAlarmRate(estimate, estimate.mean - truth, tolerance)};
}

PictureResult CheckEquals(const Check& check, std::span<const Image> pictures,
                          std::span<const Image> others, PixelBounds region) {
  const SeedEstimate a = Estimate(pictures, region), b = Estimate(others, region);
  SeedEstimate difference;
  difference.mean = a.mean - b.mean;
  difference.standardDeviation = std::hypot(a.standardDeviation, b.standardDeviation);
  difference.halfWidth = std::hypot(a.halfWidth, b.halfWidth);
  difference.seeds = std::min(a.seeds, b.seeds);
  const double tolerance = Tolerance(check.arguments.at(1), b.mean);
  const bool isRight = std::abs(difference.mean) + difference.halfWidth <= tolerance;
  return {isRight,
          Text("mean %.5g ± %.2g, %s %.5g ± %.2g", a.mean, a.halfWidth, check.arguments[0].c_str(),
               b.mean, b.halfWidth),
          FalseAlarmRate(difference, difference.mean, tolerance)};
}

PictureResult CheckBound(const Check& check, const Image& picture, PixelBounds region) {
  const double mean = MeanOver(picture, region), bound = std::stod(check.arguments.at(0));
  const bool isRight = check.kind == "atmost" ? mean <= bound : mean >= bound;
  return {isRight, Text("mean %.4g", mean)};
}

PictureResult CheckSpread(const Check& check, std::span<const Image> pictures) {
  constexpr int kBlocks = 4;
  double worst = 0;
  double all = 0;
  for (const Image& image : pictures) all += MeanOver(image, {}) / double(pictures.size());
  for (int i = 0; i < kBlocks * kBlocks; ++i) {
    const Image& first = pictures[0];
    const int x = i % kBlocks, y = i / kBlocks, w = first.Width(), h = first.Height();
    const PixelBounds block{x * w / kBlocks, y * h / kBlocks, (x + 1) * w / kBlocks,
                            (y + 1) * h / kBlocks};
    double mean = 0;
    for (const Image& image : pictures) mean += MeanOver(image, block) / double(pictures.size());
    worst = std::max(worst, std::abs(mean / all - 1));
  }
  return {worst <= Tolerance(check.arguments.at(0), 1), Text("blocks within %.2g %%", worst * 100)};
}

// Compares bit for bit after multiplication by a factor and an optional permutation of channels.
PictureResult CheckBits(const Image& picture, const Image& other, float factor, bool isPermuted) {
  if (picture.data != other.data || picture.ChannelCount() != other.ChannelCount())
    return {false, "the pictures differ in size"};
  static constexpr std::array<int, 4> kPlain{0, 1, 2, 3}, kTurned{1, 2, 0, 3};
  int different = 0;
  for (int y = 0; y < picture.Height(); ++y) {
    for (int x = 0; x < picture.Width(); ++x) {
      bool isSame = true;
      for (int c = 0; c < 3; ++c) {
        const int from = (isPermuted ? kTurned : kPlain)[std::size_t(c)];
        if (picture.At(x, y, c) != other.At(x, y, from) * factor) isSame = false;
      }
      different += !isSame;
    }
  }
  return {different == 0, different == 0 ? "same bits" : Text("%d pixels differ", different)};
}

// Compares the ratio of two means, computed in double precision.
PictureResult CheckRatio(const Check& check, const Image& picture, const Image& other) {
  const double ratio = MeanOver(picture, {}) / MeanOver(other, {});
  const double asked = std::stod(check.arguments.at(1));
  const bool isRight = std::abs(ratio / asked - 1) <= Tolerance(check.arguments.at(2), 1);
  return {isRight, Text("%.6g times %s", ratio, check.arguments[0].c_str())};
}

PictureResult CheckNear(const Check& check, const Image& picture, const Image& other) {
  if (picture.pixels.size() != other.pixels.size()) return {false, "the pictures differ in size"};
  const double tolerance = Tolerance(check.arguments.at(1), 1);
  const double asked = Tolerance(check.arguments.at(2), 1);
  const double mean = MeanOver(other, {});
  int near = 0;
  const int total = picture.Width() * picture.Height();
  for (int i = 0; i < total; ++i) {
    bool isNear = true;
    for (int c = 0; c < 3; ++c) {
      const double a = double(picture.At(i % picture.Width(), i / picture.Width(), c));
      const double b = double(other.At(i % picture.Width(), i / picture.Width(), c));
      if (!(std::abs(a - b) <= tolerance * std::max(std::abs(b), mean))) isNear = false;
    }
    near += isNear;
  }
  const double share = double(near) / total;
  return {share >= asked, Text("%.4g %% of pixels within %g", share * 100, tolerance)};
}

}  // namespace

PixelBounds RegionFrom(const std::vector<std::string>& words) {
  if (words.size() != 4) throw std::runtime_error("a region is x0 x1 y0 y1");
  return {std::stoi(words[0]), std::stoi(words[2]), std::stoi(words[1]), std::stoi(words[3])};
}

bool NeedsOther(const std::string& kind) {
  return kind == "same" || kind == "scaled" || kind == "permuted" || kind == "near" ||
         kind == "equals" || kind == "ratio";
}

PictureResult CheckPicture(const Check& check, std::span<const Image> pictures,
                           std::span<const Image> others, PixelBounds region) {
  const std::string& kind = check.kind;
  if (kind == "mean") return CheckMean(check, pictures, region);
  if (kind == "equals") return CheckEquals(check, pictures, others, region);
  if (kind == "spread") return CheckSpread(check, pictures);
  if (kind == "atmost" || kind == "atleast") return CheckBound(check, pictures[0], region);
  if (kind == "ratio") return CheckRatio(check, pictures[0], others[0]);
  if (kind == "near") return CheckNear(check, pictures[0], others[0]);
  const float factor = kind == "scaled" ? std::stof(check.arguments.at(1)) : 1;
  return CheckBits(pictures[0], others[0], factor, kind == "permuted");
}

}  // namespace exphoton::hardcases
