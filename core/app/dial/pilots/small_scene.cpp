// SPDX-License-Identifier: BSD-2-Clause
#include "core/app/dial/pilots/small_scene.h"

#include <algorithm>
#include <cmath>

#include "core/app/process/signals.h"
#include "core/base/error.h"

namespace exphoton::cli {
namespace {

// A crop window in fractions may contain no pixel of a small picture, so all windows become pixels.
void ScalePicture(const FilmSettings& film, const PixelBounds& crop, double scale,
                  LoadOptions* options) {
  const auto scaled = [scale](int pixels) {
    return std::to_string(std::max(std::min(4, pixels), int(pixels * scale)));
  };
  options->parameters.push_back({"Film", "xresolution", scaled(film.xResolution)});
  options->parameters.push_back({"Film", "yresolution", scaled(film.yResolution)});
  options->pixelBounds = crop;
  options->boundsResolution = Point2i{film.xResolution, film.yResolution};
}

}  // namespace

LoadOptions SmallScene::Options(const RenderCommand& command, std::unique_ptr<RenderSetup>* full) {
  LoadOptions options = command.load;
  options.stop = &StopFlag();
  options.threads = command.threadCount;
  options.sceneLog = sceneLog_;
  std::unique_ptr<RenderSetup> setup = Load(options);
  options.sceneLog = nullptr;
  SetPixels(*setup, kPilotPixels, &options);
  if (full) *full = std::move(setup);
  return options;
}

void SmallScene::SetPixels(const RenderSetup& full, double pixels, LoadOptions* options) {
  const double all = double(full.crop.Width()) * double(full.crop.Height());
  ScalePicture(full.film, full.crop, std::min(1., std::sqrt(pixels / all)), options);
}

std::unique_ptr<RenderSetup> SmallScene::Load(const LoadOptions& options) {
  FileSource source(streams_);
  auto setups = LoadScenes(source, path_, options, log_);
  if (setups.size() == 1) return std::move(setups.front());
  throw Error(ExitStatus::CommandLine, option_ + " renders one picture, but \"" + path_ +
                                           "\" holds " + std::to_string(setups.size()) + " scenes");
}

RenderJob SmallRender::Job(const RenderSetup& setup, const Sampler& sampler, Film* film) {
  return {*setup.scene,
          *setup.integrator,
          sampler,
          *setup.filter,
          *setup.camera,
          *film,
          threads_,
          log_,
          progress_,
          statistics_,
          setup.volumeIntegrator.get(),
          setup.integratorName};
}

std::vector<double> ValuesOf(const Film& film) {
  const PixelBounds& crop = film.Crop();
  std::vector<double> values;
  for (int y = crop.y0; y < crop.y1; ++y)
    for (int x = crop.x0; x < crop.x1; ++x) {
      const auto mean = film.MeanOf({x, y});
      values.insert(values.end(), mean.begin(), mean.begin() + 3);
    }
  return values;
}

}  // namespace exphoton::cli
