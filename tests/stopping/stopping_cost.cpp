// SPDX-License-Identifier: BSD-2-Clause
// This program measures what --target-error costs. It renders scenes plainly with several numbers
// of samples, and to several targets, with several seeds. It prints the median of the true noise
// and of the cost, and ratios of costs:
//   equal noise: to a plain render with the noise that was reached, between the measured ones
//   choice:      to the cheapest of the plain renders whose noise is at most the target
//   bound:       the least ratio at equal noise for any rule that shoots photons twice, if the
//                second shot reduced no noise. Cost is counted in rays.
// Noise is measured between seeds, of which there are at least two. CPU seconds are the least of
// three rounds. Each round has all renders of the scene, so that other work on the machine disturbs
// plain renders and renders with a target alike.
//   stopping_cost SCENE,SCENE... WIDTHxHEIGHT SEEDS SAMPLES,SAMPLES... TARGET,TARGET...
//                 [--most-rays RATIO]
// A negative target -N renders two halves with N samples together.
// With --most-rays RATIO, the exit status is 1 if a target needs more rays at equal noise than
// that. Rays are the same on every machine, so each picture is then rendered once.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <sstream>
#include <string>
#include <vector>

#include "core/render/passes/render_halves.h"
#include "core/render/passes/render_passes.h"
#include "tests/images/reference.h"

namespace exphoton {
namespace {

constexpr int kRounds = 3;

struct Measured {
  Image image;
  double cpuSeconds = 0, rays = 0, samples = 0, photonRays = 0;
  int passes = 0;
  double estimate = 0;  // of the noise
};

struct Scene {
  std::string variant;
  LoadOptions load;
};

Measured RenderOnce(const Scene& scene, std::uint64_t seed, std::int64_t samples, double target) {
  LoadOptions load = scene.load;
  if (samples > 0) load.samplesPerPixel = samples;
  LoadedScene loaded = LoadSceneFile(scene.variant, load);
  RenderSetup& setup = *loaded.setup;
  Film film(setup.film.Full(), setup.crop);
  ThreadPool threads(1);
  ProgressReporter progress(ProgressReporter::Mode::Quiet);
  Statistics statistics;
  RenderOptions options;
  options.seed = seed;
  options.footprintSamples = 4;
  const RenderJob job{*setup.scene,
                      *setup.integrator,
                      *setup.sampler,
                      *setup.filter,
                      *setup.camera,
                      film,
                      threads,
                      *loaded.log,
                      progress,
                      statistics,
                      setup.volumeIntegrator.get()};
  Measured measured;
  const double start = ProcessCpuSeconds();
  if (target < 0) {
    Film first(setup.film.Full(), setup.crop), second(setup.film.Full(), setup.crop);
    const PassesResult result = RenderTwoHalves(job, options, &first, &second);
    measured.samples = double(result.samplesPerPixel);
    measured.passes = 2;
    measured.estimate = result.noise.value_or(0);
  } else if (target > 0) {
    StoppingRule rule;
    rule.targetError = target;
    const PassesResult result = RenderInPasses(job, options, rule);
    measured.samples = double(result.samplesPerPixel);
    measured.passes = result.passes;
    measured.estimate = result.noise.value_or(0);
  } else {
    Render(job, options);
    measured.samples = double(setup.sampler->SamplesPerPixel());
    measured.passes = 1;
  }
  measured.cpuSeconds = ProcessCpuSeconds() - start;
  measured.rays = double(statistics.Rays().Total());
  measured.photonRays = double(statistics.Rays().counts[std::size_t(RayKind::Photon)]);
  measured.image = film.ToImage(setup.film.premultiplyAlpha);
  return measured;
}

double Median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return n % 2 ? values[n / 2] : (values[n / 2 - 1] + values[n / 2]) / 2;
}
template <class Get>
double MedianOf(const std::vector<Measured>& all, const Get& get) {
  std::vector<double> values;
  for (const Measured& one : all) values.push_back(get(one));
  return Median(values);
}

// The mean of all plain renders. Noise is relative to it.
class MeanPicture {
 public:
  void Add(const Measured& plain) {
    if (sum_.empty()) sum_.resize(plain.image.pixels.size());
    for (std::size_t i = 0; i < sum_.size(); ++i)
      sum_[i] += plain.samples * double(plain.image.pixels[i]);
    samples_ += plain.samples;
  }
  // Returns the noise part of relMSE of each render, from its difference to the mean of the others:
  // they have other seeds, so they share neither samples nor photons, and they have the same bias.
  std::vector<double> Noise(const std::vector<Measured>& renders) const {
    const double count = double(renders.size());
    std::vector<double> noise(renders.size());
    double values = 0;
    for (std::size_t i = 0; i < sum_.size(); ++i) {
      if (int(i) % renders[0].image.ChannelCount() > 2) continue;
      const double r = sum_[i] / samples_;
      double all = 0;
      for (const Measured& one : renders) all += double(one.image.pixels[i]);
      for (std::size_t k = 0; k < renders.size(); ++k) {
        const double own = double(renders[k].image.pixels[i]);
        const double difference = own - (all - own) / (count - 1);
        noise[k] += difference * difference * (1 - 1 / count) / (r * r + .01);
      }
      ++values;
    }
    for (double& one : noise) one /= values;
    return noise;
  }

 private:
  std::vector<double> sum_;
  double samples_ = 0;
};

// One number of samples, or one target.
struct Row {
  double setting = 0;
  std::vector<Measured> renders;
  std::vector<double> errors;
};

// Returns the cost of the plain render with this error, between the measured ones.
double CostOf(const std::vector<double>& errors, const std::vector<double>& costs, double error) {
  std::size_t i = 1;
  while (i + 1 < errors.size() && errors[i] > error) ++i;
  const double t = std::log(error / errors[i - 1]) / std::log(errors[i] / errors[i - 1]);
  return costs[i - 1] * std::pow(costs[i] / costs[i - 1], t);
}

std::vector<double> Numbers(const std::string& text) {
  std::vector<double> numbers;
  std::istringstream in(text);
  for (std::string one; std::getline(in, one, ',');) numbers.push_back(std::atof(one.c_str()));
  return numbers;
}

// The median errors and costs of the plain renders, by samples.
struct PlainCosts {
  std::vector<double> errors, seconds, rays;
  double photonRays = 0;  // of one render
};

Measured RenderOnce(const Scene& scene, std::size_t seed, double setting, bool isPlain) {
  const auto samples = std::int64_t(isPlain ? setting : std::max(-setting, 0.));
  return RenderOnce(scene, std::uint64_t(seed), samples, isPlain ? 0 : setting);
}

std::vector<Row> RenderRows(const Scene& scene, int seeds, const std::string& settings,
                            bool isPlain) {
  std::vector<Row> rows;
  for (const double setting : Numbers(settings)) {
    Row row{setting, {}, {}};
    for (int seed = 1; seed <= seeds; ++seed)
      row.renders.push_back(RenderOnce(scene, std::size_t(seed), setting, isPlain));
    rows.push_back(std::move(row));
  }
  return rows;
}

// Renders all rows again, and keeps the smaller times.
void TimeAgain(const Scene& scene, bool isPlain, std::vector<Row>* rows) {
  for (Row& row : *rows)
    for (std::size_t i = 0; i < row.renders.size(); ++i) {
      double& least = row.renders[i].cpuSeconds;
      least = std::min(least, RenderOnce(scene, i + 1, row.setting, isPlain).cpuSeconds);
    }
}

PlainCosts PrintPlain(const MeanPicture& mean, std::vector<Row>* rows) {
  PlainCosts costs;
  std::printf("| samples | noise | CPU s | rays | of photons |\n| --- | --- | --- | --- | --- |\n");
  for (Row& row : *rows) {
    row.errors = mean.Noise(row.renders);
    costs.errors.push_back(Median(row.errors));
    costs.seconds.push_back(MedianOf(row.renders, [](const Measured& m) { return m.cpuSeconds; }));
    costs.rays.push_back(MedianOf(row.renders, [](const Measured& m) { return m.rays; }));
    costs.photonRays = MedianOf(row.renders, [](const Measured& m) { return m.photonRays; });
    std::printf("| %g | %.5f | %.2f | %.0f | %.0f |\n", row.setting, costs.errors.back(),
                costs.seconds.back(), costs.rays.back(), costs.photonRays);
  }
  return costs;
}

// Returns the least rays of a plain render with at most this noise; the most rays if there is none.
double ChoiceOf(const PlainCosts& plain, double noise) {
  for (std::size_t i = 0; i < plain.errors.size(); ++i)
    if (plain.errors[i] <= noise) return plain.rays[i];
  return plain.rays.back();
}

// Returns the ratio of rays at equal noise.
double PrintTarget(const MeanPicture& mean, const PlainCosts& plain, Row* row) {
  row->errors = mean.Noise(row->renders);
  const auto [least, most] = std::minmax_element(row->errors.begin(), row->errors.end());
  const double cpu = MedianOf(row->renders, [](const Measured& m) { return m.cpuSeconds; });
  const double rays = MedianOf(row->renders, [](const Measured& m) { return m.rays; });
  const double own = Median(row->errors);
  const double target = row->setting > 0 ? row->setting : own;
  const double equal = CostOf(plain.errors, plain.rays, own);
  std::printf("| %g | %.5f [%.5f %.5f] | %.5f | %g | %g | %.2f | %.2f | %.2f | %.2f | %.2f |\n",
              row->setting, own, *least, *most,
              MedianOf(row->renders, [](const Measured& m) { return m.estimate; }),
              MedianOf(row->renders, [](const Measured& m) { return m.samples; }),
              MedianOf(row->renders, [](const Measured& m) { return double(m.passes); }), cpu,
              cpu / CostOf(plain.errors, plain.seconds, own), rays / equal,
              rays / ChoiceOf(plain, target), (equal + plain.photonRays) / equal);
  return rays / equal;
}

// Returns the largest ratio of rays at equal noise.
double MeasureScene(const std::string& name, char** argv, int rounds) {
  Scene scene{name, {}};
  const std::string size = argv[2];
  const std::size_t x = size.find('x');
  scene.load.parameters = {{"Film", "xresolution", size.substr(0, x)},
                           {"Film", "yresolution", size.substr(x + 1)}};
  const int seeds = std::atoi(argv[3]);
  std::printf("%s, %s, %d seeds\n\n", name.c_str(), size.c_str(), seeds);
  std::vector<Row> plain = RenderRows(scene, seeds, argv[4], true),
                   targets = RenderRows(scene, seeds, argv[5], false);
  for (int round = 1; round < rounds; ++round) {
    TimeAgain(scene, true, &plain);
    TimeAgain(scene, false, &targets);
  }
  MeanPicture mean;
  for (const Row& row : plain)
    for (const Measured& one : row.renders) mean.Add(one);
  const PlainCosts costs = PrintPlain(mean, &plain);
  std::printf(
      "\n| target | noise [min max] | estimate | samples | passes | CPU s | CPU, equal noise | "
      "rays, equal noise | rays, choice | bound |\n| --- | --- | --- | --- | --- | --- | --- | --- "
      "| "
      "--- | --- |\n");
  double most = 0;
  for (Row& row : targets) most = std::max(most, PrintTarget(mean, costs, &row));
  std::printf("\n");
  std::fflush(stdout);
  return most;
}

int Main(int argc, char** argv) {
  const bool checks = argc == 8 && std::string(argv[6]) == "--most-rays";
  if (!(argc == 6 || checks) || std::atoi(argv[3]) < 2) {
    std::fprintf(stderr,
                 "usage: stopping_cost SCENE,... WxH SEEDS SAMPLES,... TARGET,... "
                 "[--most-rays RATIO]\n");
    return 2;
  }
  const double limit = checks ? std::atof(argv[7]) : 1e300;
  double most = 0;
  std::istringstream names(argv[1]);
  for (std::string name; std::getline(names, name, ',');)
    most = std::max(most, MeasureScene(name, argv, checks ? 1 : kRounds));
  if (most <= limit) return 0;
  std::fprintf(stderr,
               "stopping_cost: a target needs %.2f times the rays of a plain render, and at "
               "most %g are expected\n",
               most, limit);
  return 1;
}

}  // namespace
}  // namespace exphoton

int main(int argc, char** argv) {
  try {
    return exphoton::Main(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "stopping_cost: %s\n", error.what());
    return 1;
  }
}
