// SPDX-License-Identifier: BSD-2-Clause
#include "core/app/budget/setting_renders.h"

#include "core/app/dial/pilots/counted_cost.h"
#include "core/app/process/signals.h"

namespace exphoton::cli {
namespace {

PictureValues MeanOfGroup(const Corrections::Group& group) {
  PictureValues values = group.sums;
  for (double& value : values) value /= double(group.samplesPerPixel);
  return values;
}

int CountMaps(const std::vector<PictureSeeds>& pictures) {
  int maps = 0;
  for (std::size_t i = 0; i < pictures.size(); ++i)
    maps += i == 0 || pictures[i].photons != pictures[i - 1].photons ? 1 : 0;
  return maps;
}

void TakeCosts(const Statistics& statistics, const SettingRequest& request,
               SettingRenders* renders) {
  const double maps = CountMaps(request.pictures), count = double(request.pictures.size());
  for (const Statistics::Phase& phase : statistics.Phases()) {
    const bool isOfSamples = phase.name == "render" || phase.name == "share";
    if (isOfSamples)
      renders->sampleSeconds += phase.cpuSeconds / count;
    else
      renders->mapSeconds += phase.cpuSeconds / maps;
  }
  renders->rays = statistics.Rays();
  renders->cameraSamples = CounterOf(statistics, "render/camera samples");
  renders->storedPhotons = StoredPhotons(statistics) / maps;
  renders->causticPhotons = CounterOf(statistics, "photons/caustic stored") / maps;
}

}  // namespace

SettingRenders RenderSetting(const RenderSetup& setup, const SettingRequest& request, int threads) {
  SettingRenders renders;
  // The pictures have photons of their own, so each is a group.
  if (request.correctedShare > 0)
    renders.groups.emplace(setup.crop, request.correctedShare, int(request.pictures.size()));
  Film film(setup.film.Full(), setup.crop);
  SmallRender small(threads);
  const std::int64_t samples =
      request.samples > 0 ? request.samples : setup.sampler->SamplesPerPixel();
  const auto sampler = setup.sampler->WithSamplesPerPixel(samples);
  const RenderJob job = small.Job(setup, *sampler, &film);
  RenderOptions options;
  options.stop = &StopFlag();
  options.footprintSamples = request.footprintSamples;
  options.corrections = renders.groups ? &*renders.groups : nullptr;
  PassRenderer renderer(job, options);
  for (const PictureSeeds& seeds : request.pictures) {
    film.Clear();
    if (!renderer.Run({seeds.photons, seeds.samples, 0, samples}, *sampler, &film))
      throw LoadingStopped();
    if (renders.groups) renders.groups->EndPass(int(renders.pictures.size()), samples);
    renders.pictures.push_back(ValuesOf(film));
  }
  renderer.Finish();
  if (renders.groups)
    for (const Corrections::Group* group : renders.groups->Groups())
      renders.corrections.push_back(MeanOfGroup(*group));
  TakeCosts(small.Counts(), request, &renders);
  return renders;
}

}  // namespace exphoton::cli
