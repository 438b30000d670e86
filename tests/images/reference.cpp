// SPDX-License-Identifier: BSD-2-Clause
// MeasureRegion and LargestFirefly compare pictures with the stored references.
#include "tests/images/reference.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <stdexcept>

#include "core/base/log.h"
#include "core/imaging/files/exr.h"
#include "core/imaging/files/png.h"
#include "core/imaging/metrics/metrics.h"
#include "tests/support/equivalence.h"

namespace exphoton {
namespace {

const std::string kReferenceFolder = std::string(EXPHOTON_SOURCE_DIR) + "/tests/images/references/";

double Grey(const Image& image, int x, int y) {
  double sum = 0;
  for (const char* name : {"R", "G", "B"}) sum += double(image.At(x, y, image.FindChannel(name)));
  return sum / 3;
}

// Returns which pixels count, as defined at Reference.
std::vector<bool> FindCounting(const Image& image) {
  const int width = image.Width(), height = image.Height();
  std::vector<double> greys;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) greys.push_back(Grey(image, x, y));
  std::vector<double> sorted = greys;
  std::nth_element(sorted.begin(), sorted.begin() + std::ptrdiff_t(sorted.size() / 2),
                   sorted.end());
  const double limit = 10 * sorted[sorted.size() / 2];
  std::vector<bool> counts(greys.size(), true);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      if (greys[std::size_t(y * width + x)] <= limit) continue;
      for (int v = std::max(0, y - 1); v <= std::min(height - 1, y + 1); ++v)
        for (int u = std::max(0, x - 1); u <= std::min(width - 1, x + 1); ++u)
          counts[std::size_t(v * width + u)] = false;
    }
  }
  return counts;
}

// Calls visit(x, y, index) for each pixel of the region that counts. Returns their number.
template <class Visit>
int ForCounting(const Reference& reference, const PixelBounds& region, Visit&& visit) {
  int count = 0;
  for (int y = region.y0; y < region.y1; ++y) {
    for (int x = region.x0; x < region.x1; ++x) {
      const auto index = std::size_t(y * reference.image.Width() + x);
      if (!reference.counts[index]) continue;
      visit(x, y, index);
      ++count;
    }
  }
  return count;
}

double MeanOfRegion(const Reference& reference, const Image& picture, const PixelBounds& region) {
  double sum = 0;
  const int count = ForCounting(reference, region,
                                [&](int x, int y, std::size_t) { sum += Grey(picture, x, y); });
  return sum / count;
}

// Returns P(|T| > t) for Student's T, by the finite series of Abramowitz and Stegun 26.7.3 and
// 26.7.4.
double StudentTail(double t, int degrees) {
  const double angle = std::atan(t / std::sqrt(double(degrees)));
  const double sine = std::sin(angle), cosine = std::cos(angle);
  const bool isOdd = degrees % 2 == 1;
  double term = isOdd ? cosine : 1, sum = 0;
  for (int k = isOdd ? 1 : 0; k <= degrees - 2; k += 2) {
    sum += term;
    term *= cosine * cosine * (k + 1) / (k + 2);
  }
  const double inside = isOdd ? (angle + sine * sum) * 2 / std::numbers::pi : sine * sum;
  return std::max(0.0, 1 - inside);
}

Image MeanOf(const std::vector<Image>& pictures) {
  Image mean = pictures.front();
  for (std::size_t i = 0; i < mean.pixels.size(); ++i) {
    double sum = 0;
    for (const Image& picture : pictures) sum += double(picture.pixels[i]);
    mean.pixels[i] = float(sum / double(pictures.size()));
  }
  return mean;
}

}  // namespace

Reference LoadReference(const std::string& name) {
  const Image half = ReadExr(kReferenceFolder + name + "-a.exr");
  const study::Reference measured =
      study::MakeReference(half, ReadExr(kReferenceFolder + name + "-b.exr"));
  Reference reference{measured.mean, {}, {}, measured};
  reference.footprintSamples = std::get<int>(half.attributes.at("samplesPerPixel"));
  reference.counts = FindCounting(reference.image);
  const std::vector<float>& error = measured.halfDifference;
  for (std::size_t i = 0; i < error.size(); i += 3) {
    const double grey = (double(error[i]) + double(error[i + 1]) + double(error[i + 2])) / 3;
    reference.variance.push_back(grey * grey);
  }
  return reference;
}

LoadedScene LoadSceneFile(const std::string& variant, LoadOptions options) {
  LoadedScene loaded;
  loaded.log = std::make_unique<Log>(Log::Level::Normal, Log::Sink::Memory);
  options.pluginFolders.push_back(std::string(EXPHOTON_BINARY_DIR) + "/plugins");
  const std::vector<ParameterOverride> size{{"Film", "xresolution", "64"},
                                            {"Film", "yresolution", "48"}};
  options.parameters.insert(options.parameters.begin(), size.begin(), size.end());
  FileSource source;
  const std::string path = std::string(EXPHOTON_SOURCE_DIR) + "/scenes/" + variant + ".pbrt";
  loaded.setup = std::move(LoadScenes(source, path, options, *loaded.log).at(0));
  return loaded;
}

RegionResult MeasureRegion(const Reference& reference, const std::vector<Image>& pictures,
                           const PixelBounds& region) {
  RegionResult result;
  result.name = "x " + std::to_string(region.x0) + ".." + std::to_string(region.x1) + ", y " +
                std::to_string(region.y0) + ".." + std::to_string(region.y1);
  result.truth = MeanOfRegion(reference, reference.image, region);
  std::vector<double> means;
  for (const Image& picture : pictures) means.push_back(MeanOfRegion(reference, picture, region));
  const SeedEstimate estimate = EstimateFrom(means);
  result.mean = estimate.mean;

  double variance = 0;  // of the reference's mean; its pixels are independent
  const int count = ForCounting(reference, region, [&](int, int, std::size_t index) {
    variance += reference.variance[index];
  });
  const double referenceError = std::sqrt(variance) / count;
  constexpr double kNormalQuantile995 = 2.5758;
  result.halfWidth = std::hypot(estimate.halfWidth, kNormalQuantile995 * referenceError);
  const double error =
      std::hypot(estimate.standardDeviation / std::sqrt(double(means.size())), referenceError);
  if (error > 0) {
    result.pValue =
        StudentTail(std::abs(result.mean - result.truth) / error, int(means.size()) - 1);
  }
  return result;
}

std::vector<PixelBounds> Blocks(const Image& image) {
  std::vector<PixelBounds> blocks;
  const int width = image.Width() / 4, height = image.Height() / 3;
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 4; ++x)
      blocks.push_back({x * width, y * height, (x + 1) * width, (y + 1) * height});
  }
  return blocks;
}

double LargestFirefly(const Reference& reference, const std::vector<Image>& pictures) {
  const Image& truth = reference.image;
  const PixelBounds all{0, 0, truth.Width(), truth.Height()};
  const double floor = MeanOfRegion(reference, truth, all) / 10;
  double largest = 0;
  ForCounting(reference, all, [&](int x, int y, std::size_t) {
    double brightest = 0;
    for (int v = std::max(0, y - 1); v <= std::min(truth.Height() - 1, y + 1); ++v)
      for (int u = std::max(0, x - 1); u <= std::min(truth.Width() - 1, x + 1); ++u)
        brightest = std::max(brightest, Grey(truth, u, v));
    for (const Image& picture : pictures)
      largest = std::max(largest, Grey(picture, x, y) / (brightest + floor));
  });
  return largest;
}

long long CountNonFinite(const std::vector<Image>& pictures) {
  long long count = 0;
  for (const Image& picture : pictures) {
    count += CompareImages(picture, picture).nonFinitePixels;
    for (const float value : picture.pixels) count += value < 0;
  }
  return count;
}

std::string WriteFailure(const std::string& name, const Reference& reference,
                         const std::vector<Image>& pictures) {
  std::string file = name;
  std::replace(file.begin(), file.end(), '/', '-');
  const std::filesystem::path folder = std::filesystem::current_path() / "failed-images";
  std::filesystem::create_directories(folder);
  const std::string base = (folder / file).string();
  const Image mean = MeanOf(pictures);
  WriteExr(base + ".exr", mean, false);
  WriteExr(base + "-reference.exr", reference.image, false);
  WriteExr(base + "-difference.exr", DifferenceImage(reference.image, mean), false);
  WritePng(base + "-difference.png", SignedErrorImage(reference.image, mean, .5));
  return base + ".exr";
}

}  // namespace exphoton
