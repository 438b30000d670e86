// SPDX-License-Identifier: BSD-2-Clause
#include "core/app/dial/pilots/pilot.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/app/process/signals.h"
#include "core/base/error.h"
#include "core/base/format.h"
#include "core/base/parallel.h"
#include "core/base/progress.h"
#include "core/render/passes/pass_parts.h"
#include "core/render/passes/unshared/unshared_picture.h"
#include "core/render/photon_noise.h"
#include "core/render/sharing/sharing_plan.h"

namespace exphoton::cli {
namespace {

constexpr double kCorrectedShare = 1. / 16;
// A pilot of a small picture would take as long as a part of the picture.
constexpr double kPixelShare = .25, kFewestPixels = 750;
constexpr double kMostShrinking = 16;         // of pixels, for which noise and bias are known
constexpr double kSharingSlopeOfPixels = .4;  // of the squared bias of sharing over pixels

// Returns the CPU time of the phases, which depends on a clock.
CountedCost SecondsOf(const Statistics& statistics) {
  CountedCost seconds;
  for (const Statistics::Phase& phase : statistics.Phases()) {
    const bool isOfSamples = phase.name == "render" || phase.name == "share";
    double& sum = isOfSamples ? seconds.samples : seconds.maps;
    sum += phase.cpuSeconds;
  }
  return seconds;
}

// Returns a number that the scene gives; 0: it gives none.
double GivenNumber(const RenderSetup& setup, const std::string& name) {
  const ParsedParam* const given = setup.integratorParameters.Find(name);
  return given && !given->numbers.empty() ? given->numbers.front() : 0;
}

// The bias of gathers in single pixels is about proportional to the radius of density estimates, so
// to the root of the share of the photons that an estimate uses. This is right to a factor of 2 in
// five scenes (docs/decisions/0112-guess-of-the-bias-of-photons.md).
double GuessedBias(double usedPhotons, double indirectPhotons) {
  constexpr double kOfRoot = .5, kUsedByDefault = 50;
  const double used = usedPhotons > 0 ? usedPhotons : kUsedByDefault;
  return indirectPhotons > 0 ? kOfRoot * std::sqrt(used / indirectPhotons) : 0;
}

// Returns the photons that a map should have. Where the scene does not say it, the photons that the
// integrator wanted, or else the stored ones, are about as many. A map without photons counts as 0.
double PhotonsOf(const RenderSetup& setup, const Statistics& statistics, int maps,
                 const std::string& map) {
  const double given = GivenNumber(setup, map + "photons");
  const double wanted = CounterOf(statistics, "photons/" + map + " wanted");
  const double stored = CounterOf(statistics, "photons/" + map + " stored") / std::max(maps, 1);
  if (!(stored > 0)) return 0;
  return given > 0 ? given : std::max(wanted, stored);
}

}  // namespace

PilotRenderer::PilotRenderer(const RenderCommand& command, std::string scene,
                             Surroundings surroundings)
    : command_(command),
      scene_(std::move(scene), surroundings.option, surroundings.streams),
      verbose_(*surroundings.log) {
  const double begin = ProcessCpuSeconds();
  if (surroundings.showsMessages) scene_.ShowMessages(surroundings.log);
  small_ = scene_.Options(command, &setup_);
  loadSeconds_ = ProcessCpuSeconds() - begin;
  sceneIntegrator_ = setup_->integratorName;
  sceneSampler_ = setup_->sampler->WithSamplesPerPixel(setup_->sampler->SamplesPerPixel());
  sceneGatherRays_ = int(GivenNumber(*setup_, "finalgathersamples"));
  if (setup_->integrator && setup_->scene)
    sceneSharesGathers_ = PlanSharing(*setup_->integrator, *setup_->scene, *setup_->camera).isOn;
  hasSpecularSurfaces_ = setup_->scene && setup_->scene->Features().Needs(Feature::Specular);
  // The features of the scene leave out what its own integrator does not compute.
  hasIndirectLight_ = setup_->scene &&
                      Intersects(setup_->scene->Primitives().PossibleLobes(), LobeSet::NonSpecular);
  sceneUsedPhotons_ = GivenNumber(*setup_, "nused");
  sceneDirectPhotons_ = GivenNumber(*setup_, "directphotons");
  scenePaths_ = GivenNumber(*setup_, "maxphotonpaths");
  width_ = setup_->crop.Width(), height_ = setup_->crop.Height();
  pilotPixels_ = std::min(Pixels(), kPilotPixels);
  small_.isStrict = false;  // parameters of other integrators are unknown
  fewer_ = small_;
  // For a picture, pilots of photon maps have at most a quarter of its pixels.
  if (surroundings.isForPicture)
    SmallScene::SetPixels(
        *setup_,
        std::clamp(kPixelShare * Pixels(), std::min(kFewestPixels, pilotPixels_), kPilotPixels),
        &fewer_);
}

bool PilotRenderer::HasWholeScene(const RenderSetup& setup) {
  return setup.scene && setup.scene->IsWhole();
}

std::string PilotRenderer::TextOf(const PilotRequest& request, const PilotPicture& picture) {
  std::string text = (request.isRough ? "rough pilot of " : "pilot of ") + request.integrator;
  if (request.settings.photons != 1)
    text += Format(" with %.3g times the photons", request.settings.photons);
  text += Format(", %g %s a pixel: noise %.3g \u00b1 %.2g of relMSE", picture.pilot.samples,
                 picture.pilot.samples == 1 ? "sample" : "samples", picture.pilot.noise,
                 picture.pilot.error);
  if (picture.pilot.photonNoise > 0)
    text += Format(", of the photons %.3g", picture.pilot.photonNoise);
  if (picture.sharing.squared > 0)
    text += Format(", bias of sharing %.2g in the picture", picture.sharing.squared);
  if (picture.certificate)
    text += Format(", bias %.3g to %.3g", picture.certificate->bias.lower,
                   picture.certificate->bias.upper);
  return text + Format("; price of maps %.3g, of samples %.3g; %.2g CPU s", picture.cost.maps,
                       picture.cost.samples, picture.seconds);
}

// Pilots that differ only in their samples use the same objects. The numbers of photons in the
// settings are always the scene's, so only their factor matters.
const RenderSetup& PilotRenderer::Load(const PilotRequest& request) {
  const bool isLoaded = setup_->scene && loaded_.integrator == request.integrator &&
                        loaded_.settings.photons == request.settings.photons &&
                        loaded_.settings.gatherRays == request.settings.gatherRays &&
                        loaded_.isRough == request.isRough &&
                        HaveSameNames(loaded_.omitted, request.omitted);
  if (isLoaded) return *setup_;
  const bool hasMaps = ReadsPhotonMaps(request.integrator);
  LoadOptions options = hasMaps && !request.isRough ? fewer_ : small_;
  options.integrator = request.integrator;
  options.isQuick = request.isRough;
  for (ParameterOverride& parameter : request.settings.Overrides())
    options.parameters.push_back(std::move(parameter));
  if (request.isRough) options.parameters.push_back(LimitOfPaths());
  options.known = HasWholeScene(*setup_) ? setup_.get() : nullptr;
  // The integrators refer to the scene, so they go first.
  setup_->integrator.reset();
  setup_->volumeIntegrator.reset();
  preparedSeed_.reset();
  loaded_ = {};
  setup_ = scene_.Load(options);
  Omit(request.omitted, *setup_);
  loaded_ = request;
  return *setup_;
}

// Where few paths leave photons, the limit of the paths decides what photons cost.
std::int64_t PilotRenderer::FewPaths() const {
  constexpr double kByDefault = 1 << 24;
  const double paths = kFewPhotons * (scenePaths_ > 0 ? scenePaths_ : kByDefault);
  return std::max<std::int64_t>(std::int64_t(paths), 1);
}

ParameterOverride PilotRenderer::LimitOfPaths() const {
  return {"SurfaceIntegrator", "maxphotonpaths", std::to_string(std::min(FewPaths(), roughPaths_))};
}

void PilotRenderer::LimitRoughPaths(double paths) {
  const std::int64_t limit =
      paths < double(kNoLimit) ? std::max<std::int64_t>(std::int64_t(paths), 1) : kNoLimit;
  if (limit != roughPaths_ && loaded_.isRough) loaded_ = {};
  roughPaths_ = limit;
}

// With more pixels, more gathers lie near each other on a surface. The noise of shared gathers
// falls about with the fifth root of the number of pixels (docs/decisions/0091-smaller-pilots.md).
double PilotRenderer::NoiseOfPicture(const RenderSetup& setup, double pixels) const {
  if (!PlanSharing(*setup.integrator, *setup.scene, *setup.camera).isOn) return 1;
  return std::pow(std::clamp(pixels / Pixels(), 1 / kMostShrinking, 1.), .2);
}

// The bias of sharing falls with the number of pixels, too, because neighbours are nearer
// (docs/decisions/0087-expected-bias-of-sharing.md).
double PilotRenderer::SharingBiasOfPicture(double pixels) const {
  return std::pow(std::clamp(pixels / Pixels(), 1 / kMostShrinking, 1.), kSharingSlopeOfPixels);
}

std::uint64_t PilotRenderer::FirstSeed() const { return HashKey({command_.seed, kPassSeed, 0}); }

std::optional<std::uint64_t> PilotRenderer::Give(const DialChoice& choice, RenderSetup* setup) {
  const DialSettings& settings = choice.settings;
  const bool isSame = setup_ && loaded_.integrator == setup->integratorName &&
                      loaded_.settings.photons == settings.photons &&
                      loaded_.settings.gatherRays == settings.gatherRays && !loaded_.isRough &&
                      HaveSameNames(loaded_.omitted, choice.omitted) &&
                      preparedSeed_ == FirstSeed();
  work_.givesPhotons = isSame;
  if (!isSame) {
    if (setup_ && !setup_->scene) setup_.reset();  // its integrators refer to a scene elsewhere
    return std::nullopt;
  }
  // The integrators refer to the scene, so they go first.
  setup->integrator = std::move(setup_->integrator);
  setup->volumeIntegrator = std::move(setup_->volumeIntegrator);
  if (setup_->scene) setup->scene = std::move(setup_->scene);
  setup_.reset();
  return std::exchange(preparedSeed_, std::nullopt);
}

// Renders with the photons of the last pilot first, if they are the right ones.
PassesResult PilotRenderer::RenderHalves(const RenderJob& job, bool estimatesSharing,
                                         PictureFilms* films, PilotPicture* picture) {
  RenderOptions render;
  render.seed = command_.seed;
  render.stop = &StopFlag();
  render.footprintSamples = command_.footprintSamples;
  render.corrections = films->corrections.get();
  render.aovs = films->aovs.get();
  render.preparedSeed = preparedSeed_;
  std::unique_ptr<UnsharedPicture> unshared;
  PassSum sum(&job.film, {});
  if (estimatesSharing && UnsharedPicture::IsKnown(job)) {
    unshared = std::make_unique<UnsharedPicture>(job.film, nullptr);
    render.sharingChange = unshared->OfPass();
    sum.UseLevelsOf(unshared->Sum());
    if (films->corrections) films->corrections->KeepSharingApart();
  }
  PassRenderer renderer(job, render);
  PhotonNoise photonNoise(job.film.Crop());
  const std::int64_t samples = job.sampler.SamplesPerPixel();
  for (int half = 0; half < 2; ++half) {
    const std::uint64_t seed = HashKey({command_.seed, kPassSeed, std::uint64_t(half)});
    picture->mapCount += preparedSeed_ == FirstSeed() ? 0 : 1;
    Film* const film = films->halves[std::size_t(half)].get();
    RenderPass pass{FirstSeed(), seed, 0, samples};
    if (job.integrator.FillsSignedLight()) pass.photonNoise = &photonNoise;
    if (!renderer.Run(pass, job.sampler, film)) throw LoadingStopped();
    preparedSeed_ = FirstSeed();
    sum.Add(*film, samples, half);
    if (unshared) unshared->Add(*film, samples, half);
    photonNoise.EndPass(samples);
    if (films->corrections) films->corrections->EndPass(half, samples);
  }
  PassesResult result;
  result.render = renderer.Finish();
  sum.Describe(false, &result);
  result.levels = sum.Levels();
  if (unshared)
    picture->sharing = unshared->BiasOf(sum, GroupSamples::Independent).value_or(SharingBias{});
  picture->pilot = {double(result.samplesPerPixel), result.noise.value_or(0), result.noiseError,
                    photonNoise.RelativeVariance(result.levels)};
  return result;
}

std::vector<std::string> PilotRenderer::UnseenLight(const PilotRequest& request) {
  const RenderSetup& setup = Load(request);
  return setup.integrator->UnseenLight(*setup.scene);
}

PilotPicture PilotRenderer::Render(const PilotRequest& request) {
  const RenderSetup& setup = Load(request);
  const double begin = ProcessCpuSeconds();
  const bool hasParts = kLightAovs.Without(setup.integrator->Aovs()).IsEmpty();
  PictureFilms films(setup.film.Full(), setup.crop, hasParts ? kLightAovs : AovSet{}, true);
  PilotPicture picture;
  const auto certification = setup.integrator->Certification(*setup.scene);
  picture.hasBias = certification.has_value();
  if (request.estimatesBias && picture.hasBias)
    films.corrections = std::make_unique<Corrections>(setup.crop, kCorrectedShare);
  SmallRender small(command_.threadCount);
  const auto sampler = setup.sampler->WithSamplesPerPixel(std::max(request.samples / 2, 1));
  const PassesResult result = RenderHalves(small.Job(setup, *sampler, &films.film),
                                           request.estimatesSharing, &films, &picture);
  picture.messages = small.Messages();
  const Statistics& statistics = small.Counts();
  work_.Add(statistics);
  picture.cost = CostOf(statistics, setup.integratorName);
  picture.cpuSeconds = SecondsOf(statistics);
  picture.seconds = ProcessCpuSeconds() - begin;
  picture.pixels = double(setup.crop.Width()) * double(setup.crop.Height());
  picture.noiseOfPicture = NoiseOfPicture(setup, picture.pixels);
  picture.sharing.squared *= SharingBiasOfPicture(picture.pixels);
  picture.sharing.standardError *= SharingBiasOfPicture(picture.pixels);
  picture.light = MeanOfHalves(*films.halves[0], *films.halves[1]);
  if (films.aovs) picture.parts = LightPartsOf(films.film, *films.aovs);
  picture.gatherRays = double(statistics.Rays().counts[std::size_t(RayKind::Gather)]);
  picture.settings = request.settings;
  picture.isCutOff = request.isRough && roughPaths_ < FewPaths() &&
                     CounterOf(statistics, "photons/shot") >= double(roughPaths_);
  const auto photonsOf = [&](const std::string& map) {
    return PhotonsOf(setup, statistics, picture.mapCount, map);
  };
  const DialSettings& known = request.settings;
  if (picture.mapCount > 0 && !(known.indirectPhotons + known.causticPhotons > 0)) {
    const double factor = request.isRough ? 1 / kFewPhotons : 1;
    picture.settings.indirectPhotons = factor * photonsOf("indirect");
    picture.settings.causticPhotons = factor * photonsOf("caustic");
  }
  picture.guessedBias = GuessedBias(sceneUsedPhotons_, picture.settings.indirectPhotons);
  // The bias of sharing is known apart.
  if (films.corrections) films.corrections->UseSharing(!request.estimatesSharing);
  if (films.corrections) picture.certificate = Certify(*films.corrections, result.levels, 0, {});
  if (picture.certificate) picture.certificate->notCovered = certification->notCovered;
  verbose_.Verbose(TextOf(request, picture));
  return picture;
}

}  // namespace exphoton::cli
