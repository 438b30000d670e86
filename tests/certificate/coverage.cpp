// SPDX-License-Identifier: BSD-2-Clause
// This program measures how often the intervals of --certify contain the true bias. It renders a
// scene with several seeds for each setting. The true bias of the blocks follows from the mean of
// all seeds and a reference of two independent halves. The columns are the scene, the setting, the
// widths of blocks, the noise, the true bias, the mean estimate, the mean width of the interval,
// the smallest bias that can be certified (all in %), how many intervals contain the true bias, how
// many lie above it and below it, and the time that --certify adds (in %).
//   certificate_coverage SCENE WIDTHxHEIGHT SEEDS REFERENCE-SAMPLES SETTING ...
// A setting is a word such as exphotonmap:indirectphotons=3000:spp=8. The first word of the
// reference is guidedpath unless REFERENCE-SAMPLES is INTEGRATOR:SAMPLES.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "core/imaging/film/local_square.h"
#include "core/imaging/metrics/metrics.h"
#include "core/render/certificate/certificate.h"
#include "core/render/passes/render_halves.h"
#include "tests/images/reference.h"

namespace exphoton {
namespace {

// The pictures of two halves, three values per pixel, and what the render cost.
struct Rendered {
  std::vector<float> picture, halves[2];
  std::optional<Certificate> certificate;
  double cpuSeconds = 0;
};

std::vector<float> ValuesOf(const Film& film) {
  std::vector<float> values;
  const PixelBounds& crop = film.Crop();
  for (int y = crop.y0; y < crop.y1; ++y)
    for (int x = crop.x0; x < crop.x1; ++x)
      for (std::size_t c = 0; c < 3; ++c)
        values.push_back(float(std::max(film.MeanOf({x, y})[c], 0.)));
  return values;
}

Rendered RenderOnce(const std::string& scene, const LoadOptions& load, std::uint64_t seed,
                    double share) {
  LoadedScene loaded = LoadSceneFile(scene, load);
  RenderSetup& setup = *loaded.setup;
  Film film(setup.film.Full(), setup.crop), first = film, second = film;
  ThreadPool threads(1);
  ProgressReporter progress(ProgressReporter::Mode::Quiet);
  Statistics statistics;
  RenderOptions options;
  options.seed = seed;
  options.footprintSamples = 4;
  Corrections corrections(setup.crop, share);
  if (share > 0) options.corrections = &corrections;
  Rendered rendered;
  const double start = ProcessCpuSeconds();
  const PassesResult result = RenderTwoHalves(
      {*setup.scene, *setup.integrator, *setup.sampler, *setup.filter, *setup.camera, film, threads,
       *loaded.log, progress, statistics, setup.volumeIntegrator.get()},
      options, &first, &second);
  rendered.cpuSeconds = ProcessCpuSeconds() - start;
  rendered.picture = ValuesOf(film);
  rendered.halves[0] = ValuesOf(first);
  rendered.halves[1] = ValuesOf(second);
  const double noise = result.noise.value_or(0);
  if (share > 0)
    rendered.certificate =
        Certify(corrections, result.levels, noise, CertificateGoal::ForNoise(noise));
  return rendered;
}

// Relative errors of pictures against a reference, and their squared means over blocks.
class TrueBias {
 public:
  TrueBias(const Rendered& reference, int width)
      : width_(width), reference_(reference), scale_(LevelsOf(reference, std::size_t(width))) {
    for (double& r : scale_) r = std::sqrt(r + kRelMseOffset);
  }
  void Add(const Rendered& picture) { pictures_.push_back(picture.picture); }

  // Returns the mean over pairs of pictures of the product of their errors, each against another
  // half of the reference. Noise of the pictures and of the reference does not add to it.
  double InBlocks(int blockWidth) const {
    const int height = int(scale_.size() / 3) / width_;
    double total = 0;
    for (int y = 0; y < height; y += blockWidth)
      for (int x = 0; x < width_; x += blockWidth)
        for (int c = 0; c < 3; ++c)
          total += OfBlock(
              {x, y, std::min(x + blockWidth, width_), std::min(y + blockWidth, height)}, c);
    return total / double(scale_.size());
  }

 private:
  // Returns r^2 of each pixel of the mean of two halves.
  static std::vector<double> LevelsOf(const Rendered& reference, std::size_t width) {
    std::vector<float> variances;
    for (std::size_t i = 0; i < reference.picture.size(); ++i) {
      const double half = (double(reference.halves[0][i]) - double(reference.halves[1][i])) / 2;
      variances.push_back(float(half * half));
    }
    return SquaredLevels(reference.picture, variances, width);
  }
  // Returns the number of pixels times the product.
  double OfBlock(const PixelBounds& block, int channel) const {
    const auto count = double(block.Width()) * block.Height();
    double sums[2] = {0, 0}, own = 0;
    for (const std::vector<float>& picture : pictures_) {
      double errors[2] = {0, 0};
      for (int y = block.y0; y < block.y1; ++y)
        for (int x = block.x0; x < block.x1; ++x) {
          const auto at = std::size_t(3 * (y * width_ + x) + channel);
          for (int half = 0; half < 2; ++half)
            errors[half] +=
                (double(picture[at]) - double(reference_.halves[half][at])) / scale_[at] / count;
        }
      for (int half = 0; half < 2; ++half) sums[half] += errors[half];
      own += errors[0] * errors[1];
    }
    const auto pictures = double(pictures_.size());
    return count * (sums[0] * sums[1] - own) / (pictures * (pictures - 1));
  }

  int width_;
  const Rendered& reference_;
  std::vector<double> scale_;
  std::vector<std::vector<float>> pictures_;
};

struct Setting {
  std::string text;
  LoadOptions load;
  double share = 1. / 128;
};

Setting ParseSetting(const std::string& text, const LoadOptions& base) {
  Setting setting{text, base};
  std::istringstream in(text);
  std::string word;
  std::getline(in, word, ':');
  setting.load.integrator = word;
  while (std::getline(in, word, ':')) {
    const std::size_t equals = word.find('=');
    const std::string name = word.substr(0, equals), value = word.substr(equals + 1);
    if (name == "spp")
      setting.load.samplesPerPixel = std::atoll(value.c_str());
    else if (name == "share")
      setting.share = std::atof(value.c_str());
    else
      setting.load.parameters.push_back({"SurfaceIntegrator", name, value});
  }
  return setting;
}

struct Totals {
  int covered = 0, runs = 0;
};

void Measure(const std::string& scene, const Setting& setting, int seeds, TrueBias bias,
             Totals* totals) {
  std::vector<Certificate> certificates;
  double with = 0, without = 0;
  for (int seed = 1; seed <= seeds; ++seed) {
    const Rendered rendered =
        RenderOnce(scene, setting.load, std::uint64_t(seed) * 1000, setting.share);
    with += rendered.cpuSeconds;
    if (seed % 4 == 1)
      without += 4 * RenderOnce(scene, setting.load, std::uint64_t(seed) * 1000, 0).cpuSeconds;
    bias.Add(rendered);
    certificates.push_back(*rendered.certificate);
  }
  int covered = 0, tooHigh = 0, tooLow = 0;
  double squared = 0, width = 0, truth = 0, noise = 0, smallest = 0;
  std::map<int, double> truths;
  std::map<int, int> widths;
  for (const Certificate& certificate : certificates) {
    const BlockBias& block = certificate.bias;
    const double real = truths.try_emplace(block.blockWidth, 0).first->second != 0
                            ? truths[block.blockWidth]
                            : (truths[block.blockWidth] = bias.InBlocks(block.blockWidth));
    ++widths[block.blockWidth];
    if (block.lower > std::max(real, 0.))
      ++tooHigh;
    else if (block.upper < real)
      ++tooLow;
    else
      ++covered;
    squared += block.squared / seeds;
    truth += real / seeds;
    noise += certificate.noise / seeds;
    smallest += BlockBias::Root(block.smallest) / seeds;
    width += (BlockBias::Root(block.upper) - BlockBias::Root(block.lower)) / seeds;
  }
  std::string blocks;
  for (const auto& [size, count] : widths)
    blocks += (blocks.empty() ? "" : ", ") + std::to_string(size);
  const auto percent = [](double x) { return 100 * BlockBias::Root(x); };
  std::printf("| %s | %s | %s | %.2f | %.2f | %.2f | %.2f | %.2f | %d of %d | %d, %d | %.0f |\n",
              scene.c_str(), setting.text.c_str(), blocks.c_str(), percent(noise), percent(truth),
              percent(squared), 100 * width, 100 * smallest, covered, seeds, tooHigh, tooLow,
              100 * (with / without - 1));
  std::fflush(stdout);
  totals->covered += covered;
  totals->runs += seeds;
}

int Main(int argc, char** argv) {
  if (argc < 6) {
    std::fprintf(stderr,
                 "usage: certificate_coverage SCENE WxH SEEDS [INTEGRATOR:]SAMPLES SETTING ...\n");
    return 2;
  }
  const std::string scene = argv[1], size = argv[2], reference = argv[4];
  const std::size_t x = size.find('x'), colon = reference.find(':');
  LoadOptions load;
  load.parameters = {{"Film", "xresolution", size.substr(0, x)},
                     {"Film", "yresolution", size.substr(x + 1)}};
  LoadOptions exact = load;
  exact.integrator = colon == std::string::npos ? "guidedpath" : reference.substr(0, colon);
  exact.samplesPerPixel =
      std::atoll(reference.c_str() + (colon == std::string::npos ? 0 : colon + 1));
  exact.parameters.push_back({"SurfaceIntegrator", "maxdepth", "100"});
  const Rendered truth = RenderOnce(scene, exact, 77, 0);
  std::fprintf(stderr, "the reference took %.0f CPU s\n", truth.cpuSeconds);
  const TrueBias bias(truth, std::atoi(size.c_str()));
  Totals totals;
  for (int i = 5; i < argc; ++i)
    Measure(scene, ParseSetting(argv[i], load), std::atoi(argv[3]), bias, &totals);
  std::printf("covered %d of %d\n", totals.covered, totals.runs);
  return 0;
}

}  // namespace
}  // namespace exphoton

int main(int argc, char** argv) { return exphoton::Main(argc, argv); }
