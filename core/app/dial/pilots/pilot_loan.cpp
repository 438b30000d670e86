// SPDX-License-Identifier: BSD-2-Clause
// This file lends the scene of the pilots for single renders with few photons.
#include <algorithm>

#include "core/app/dial/pilots/pilot.h"
#include "core/app/process/signals.h"

namespace exphoton::cli {
namespace {

constexpr std::uint64_t kSingleSeed = 0x73696e67ull;  // "sing" in ASCII
constexpr double kUsedByDefault = 50, kLeastUsed = 2;

}  // namespace

// The integrator of the last pilot refers to the scene, which does not move in memory.
PilotRenderer::Loan::Loan(PilotRenderer* pilots, const std::string& integrator,
                          DialSettings settings)
    : pilots_(*pilots) {
  LoadOptions options = pilots_.small_;
  options.integrator = integrator;
  const double factor = settings.photons;
  settings.photons = 1;
  for (ParameterOverride& parameter : settings.Overrides())
    options.parameters.push_back(std::move(parameter));
  const auto set = [&](const char* name, double value) {
    options.parameters.push_back({"SurfaceIntegrator", name, std::to_string(std::int64_t(value))});
  };
  const auto few = [&](const char* name, double photons) {
    if (photons > 0) set(name, kFewPhotons * photons);
  };
  few("indirectphotons", settings.indirectPhotons * factor);
  few("causticphotons", settings.causticPhotons * std::max(factor, 1.));
  if (ReadsPhotonMaps(integrator)) {
    const double used = pilots_.sceneUsedPhotons_ > 0 ? pilots_.sceneUsedPhotons_ : kUsedByDefault;
    set("nused", std::max(kFewPhotons * used, kLeastUsed));
    set("maxphotonpaths", double(pilots_.FewPaths()));
    if (pilots_.sceneDirectPhotons_ > 0)
      set("directphotons", kFewPhotons * pilots_.sceneDirectPhotons_);
  }
  if (pilots_.setup_ && HasWholeScene(*pilots_.setup_)) {
    plan_ = pilots_.setup_->scene->Features();
    options.known = pilots_.setup_.get();
  }
  setup_ = pilots_.scene_.Load(options);
}

PilotRenderer::Loan::~Loan() {
  if (!plan_) return;
  setup_->integrator.reset();
  setup_->volumeIntegrator.reset();
  setup_->scene->SetFeatures(std::move(*plan_), setup_->camera->Shutter());
  pilots_.setup_->scene = std::move(setup_->scene);
  pilots_.setup_->names = std::move(setup_->names);
}

PilotRenderer::OnePass PilotRenderer::RenderOnce(const RenderSetup& setup, std::uint64_t number) {
  SmallRender small(command_.threadCount);
  RenderOptions options;
  options.seed = HashKey({command_.seed, kSingleSeed, number});
  options.stop = &StopFlag();
  options.footprintSamples = command_.footprintSamples;
  Film film(setup.film.Full(), setup.crop);
  const auto sampler = setup.sampler->WithSamplesPerPixel(OnceSamples());
  if (!exphoton::Render(small.Job(setup, *sampler, &film), options).isComplete)
    throw LoadingStopped();
  OnePass pass;
  work_.Add(small.Counts());
  pass.cost = CostOf(small.Counts(), setup.integratorName);
  pass.values = ValuesOf(film);
  return pass;
}

}  // namespace exphoton::cli
