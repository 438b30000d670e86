// SPDX-License-Identifier: BSD-2-Clause
// Each picture has two halves with seeds of their own. Pictures with and without an effect have the
// same seeds, so that most of their noise cancels in the difference.
#include "core/app/effects/measured_effects.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/app/dial/dial_settings.h"
#include "core/app/dial/pilots/small_scene.h"
#include "core/app/output/picture.h"
#include "core/app/process/signals.h"
#include "core/base/format.h"
#include "core/base/parallel.h"
#include "core/base/progress.h"
#include "core/imaging/metrics/metrics.h"
#include "core/render/sharing/sharing_plan.h"

namespace exphoton::cli {
namespace {

constexpr std::int64_t kLeastSamples = 4, kMostSamples = 16;  // of a half

using Values = std::vector<double>;  // three channels per pixel

struct Halves {
  std::array<Values, 2> values;
  double wholeSeconds = 0;  // as in MeasuredEffects
};

// Time of preprocessing, such as shooting photons, does not depend on the resolution. The rest is
// proportional to the number of samples.
struct Times {
  double preprocessing = 0, rendering = 0;

  void Add(const Statistics& statistics, double cpuSeconds) {
    double once = 0;
    for (const Statistics::Phase& phase : statistics.Phases())
      if (phase.name != "render" && phase.name != "share") once += phase.cpuSeconds;
    preprocessing += once;
    rendering += cpuSeconds - once;
  }
};

double PixelsOf(const RenderSetup& setup) {
  return double(setup.crop.Width()) * double(setup.crop.Height());
}

double Mean(const Values& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / double(values.size());
}

class Measurement {
 public:
  Measurement(const RenderCommand& command, const std::string& scene, FileSource::Streams* streams)
      : command_(command),
        scene_(scene, "--measure", streams),
        small_(scene_.Options(command, &full_)) {}

  MeasuredEffects Run() {
    const double samples = double(full_->sampler->SamplesPerPixel()) * PixelsOf(*full_);
    full_.reset();
    const auto setup = scene_.Load(small_);
    samples_ = std::clamp(setup->sampler->SamplesPerPixel() / 2, kLeastSamples, kMostSamples);
    wholeSamples_ = samples / (double(samples_) * PixelsOf(*setup));
    MeasuredEffects measured;
    measured.width = setup->crop.Width(), measured.height = setup->crop.Height();
    measured.samples = int(2 * samples_);
    // Without motion or a lens, gathers might be shared. Their change would count for the effect.
    if (ReadsPhotonMaps(setup->integratorName) &&
        !PlanSharing(*setup->integrator, *setup->scene, *setup->camera).isOn)
      small_.parameters.push_back({"SurfaceIntegrator", "sharedgather", "false"});
    const Halves whole = RenderHalves(*setup);
    measured.wholeSeconds = whole.wholeSeconds;
    measured.parts = PartsOf(*setup);
    for (int i = 0; i < kFeatureCount; ++i)
      if (setup->scene->Features().Needs(Feature(i)))
        measured.effects.push_back(Compare(FeatureName(Feature(i)), whole));
    return measured;
  }

 private:
  // Adds one render to the films.
  Times RenderInto(const RenderSetup& setup, std::uint64_t half, Film* film, AovFilm* aovs) {
    const double begin = ProcessCpuSeconds();
    SmallRender small(command_.threadCount);
    RenderOptions options;
    options.seed = command_.seed + half;
    options.stop = &StopFlag();
    options.footprintSamples = command_.footprintSamples;
    options.aovs = aovs;
    const auto sampler = setup.sampler->WithSamplesPerPixel(samples_);
    if (!exphoton::Render(small.Job(setup, *sampler, film), options).isComplete)
      throw LoadingStopped();
    Times times;
    times.Add(small.Counts(), ProcessCpuSeconds() - begin);
    return times;
  }

  Halves RenderHalves(const RenderSetup& setup) {
    Halves halves;
    for (std::size_t half = 0; half < 2; ++half) {
      Film film(setup.film.Full(), setup.crop);
      const Times times = RenderInto(setup, half, &film, nullptr);
      halves.wholeSeconds += (times.preprocessing + times.rendering * wholeSamples_) / 2;
      halves.values[half] = ValuesOf(film);
    }
    return halves;
  }

  std::vector<MeasuredLight> PartsOf(const RenderSetup& setup) {
    if (!kLightAovs.Without(setup.integrator->Aovs()).IsEmpty()) return {};
    Film film(setup.film.Full(), setup.crop);
    AovFilm aovs(setup.crop, kLightAovs);
    RenderInto(setup, 0, &film, &aovs);
    return LightPartsOf(film, aovs);
  }

  MeasuredEffect Compare(const std::string& name, const Halves& whole) {
    LoadOptions options = small_;
    options.effects = (options.effects == "auto" ? "" : options.effects + ",") + name + "=off";
    const Halves without = RenderHalves(*scene_.Load(options));
    MeasuredEffect effect;
    effect.name = name;
    const double mean = (Mean(whole.values[0]) + Mean(whole.values[1])) / 2;
    std::array<double, 2> light;
    for (std::size_t half = 0; half < 2; ++half)
      light[half] = mean > 0 ? (Mean(whole.values[half]) - Mean(without.values[half])) / mean : 0;
    effect.light = (light[0] + light[1]) / 2;
    effect.lightError = std::abs(light[0] - light[1]) / 2;
    effect.change = Change(whole, without);
    effect.time = 1 - without.wholeSeconds / whole.wholeSeconds;
    return effect;
  }

  // The product of the differences of two independent halves has the square of the difference as
  // its expected value.
  static double Change(const Halves& whole, const Halves& without) {
    double sum = 0;
    const std::size_t count = whole.values[0].size();
    for (std::size_t i = 0; i < count; ++i) {
      const double r = (whole.values[0][i] + whole.values[1][i]) / 2;
      const double a = whole.values[0][i] - without.values[0][i];
      const double b = whole.values[1][i] - without.values[1][i];
      sum += a * b / (r * r + kRelMseOffset);
    }
    return std::sqrt(std::max(sum / double(count), 0.));
  }

  const RenderCommand& command_;
  SmallScene scene_;
  std::unique_ptr<RenderSetup> full_;  // null after the first load of the small scene
  LoadOptions small_;
  std::int64_t samples_ = 0;  // a pixel, of a half
  double wholeSamples_ = 0;   // of the picture of the scene, relative to a half
};

}  // namespace

MeasuredEffects MeasureEffects(const RenderCommand& command, const std::string& scene,
                               FileSource::Streams* streams) {
  return Measurement(command, scene, streams).Run();
}

std::string MeasuredText(const MeasuredEffects& measured) {
  std::string text = Format(
      "measured      with %d x %d pixels and %s a pixel; the whole picture takes about %s CPU s\n",
      measured.width, measured.height, Counted(measured.samples, "sample").c_str(),
      Plain(measured.wholeSeconds, 2).c_str());
  for (const MeasuredEffect& effect : measured.effects)
    text += Format("  %-12s adds ", effect.name.c_str()) + Plain(100 * effect.light, 3) +
            " \u00b1 " + Plain(100 * effect.lightError, 1) +
            " % of the light, changes the picture by " + Plain(100 * effect.change, 2) +
            " %, takes " + Plain(100 * effect.time, 2) + " % of the time\n";
  if (measured.parts.empty()) return text;
  text += "light         ";
  double sum = 0;
  for (const MeasuredLight& part : measured.parts) {
    text += part.name + " " + Plain(100 * part.share, 3) + " %, ";
    sum += part.share;
  }
  return text + Format("together %.4g %%\n", 100 * sum);
}

}  // namespace exphoton::cli
