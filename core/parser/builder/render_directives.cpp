// SPDX-License-Identifier: BSD-2-Clause
// RenderDirectives applies defaults and command-line overrides, and makes camera, film, sampler,
// filter and integrators.
#include "core/parser/builder/render_directives.h"

#include <algorithm>
#include <utility>

#include "core/base/format.h"
#include "core/base/log.h"
#include "core/params/suggestions.h"
#include "core/parser/builder/graphics_state.h"
#include "core/parser/builder/missing_renderers.h"
#include "core/parser/film_parameters.h"
#include "core/parser/frame_name.h"
#include "core/parser/overrides.h"

namespace exphoton {
namespace {

constexpr const char* kIntegratorDirective = "SurfaceIntegrator";

constexpr int kQuickResolutionDivisor = 4;

// Renderer "sampler" has no parameters. The empty table reports those that a file gives.
struct RendererSettings {};

// Checks the name in a directive without plugins: Film, made by the core, and Renderer, ignored.
void RequireName(const std::string& what, const std::string& name, const SourceLocation& where,
                 const std::vector<std::string>& known) {
  if (std::find(known.begin(), known.end(), name) != known.end()) return;
  std::string list;
  for (const std::string& each : known) list += (list.empty() ? "\"" : ", \"") + each + "\"";
  FailAt(where, "unknown " + what + " \"" + name + "\"; known: " + list, DidYouMean(name, known));
}

std::vector<std::string> KnownRenderers() {
  std::vector<std::string> names{"sampler"};
  for (const MissingRenderer& renderer : kMissingRenderers) names.push_back(renderer.name);
  return names;
}

// Returns the pixels of a picture with `to` pixels that bounds in one with `from` pixels touch.
PixelBounds ScaledBounds(const PixelBounds& bounds, Point2i from, Point2i to) {
  const auto below = [](int edge, int pixels, int scaled) {
    return int(std::int64_t(edge) * scaled / pixels);
  };
  const auto above = [](int edge, int pixels, int scaled) {
    return int((std::int64_t(edge) * scaled + pixels - 1) / pixels);
  };
  return {below(bounds.x0, from.x, to.x), below(bounds.y0, from.y, to.y),
          above(bounds.x1, from.x, to.x), above(bounds.y1, from.y, to.y)};
}

// Puts the frame's number into the name of the picture.
void NumberFrame(int frame, const ParamSet& film, std::string* filename) {
  if (!HasFrameNumber(*filename)) {
    const ParsedParam* const name = film.Find("filename");
    FailAt(
        name ? name->where : film.where,
        "--frames writes one picture for each frame, but the name \"" + *filename +
            "\" has no place for the number",
        "%d stands for the number, %04d for one with leading zeros; -o NAME%d.exr on the command "
        "line takes precedence");
  }
  *filename = FrameName(*filename, frame);
}

}  // namespace

RenderDirectives::RenderDirectives(const LoadOptions& options, Dialect dialect)
    : options_(options), dialect_(dialect) {
  if (dialect == Dialect::V2) filter_.name = "box";
  OverrideIntegrator();
  OverridePlugins();
}

void RenderDirectives::OverridePlugin(Choice* choice, const std::optional<std::string>& name,
                                      const char* option) {
  if (!name || *name == choice->name) return;
  if (choice == &sampler_) sceneSampler_ = sampler_;
  choice->name = *name;
  choice->isReplaced = true;
  SourceLocation& where = choice->params.where;
  where = SourceLocation();
  where.file = kCommandLineLocation;
  where.line = 1;
  where.lineText = option + (' ' + *name);
  where.column = int(where.lineText.size() - name->size()) + 1;
}

void RenderDirectives::OverridePlugins() {
  OverridePlugin(&sampler_, options_.sampler, "--sampler");
  OverridePlugin(&filter_, options_.filter, "--filter");
  OverridePlugin(&camera_, options_.camera, "--camera");
  OverridePlugin(&accelerator_, options_.accelerator, "--accelerator");
}

// Cameras share parameters of the same meaning (shutter, lens, screen window). Widths of filters
// and counts of samplers mean different things in each plugin.
ParamSet RenderDirectives::KnownParameters(const Choice& choice,
                                           const std::vector<ParamDecl>& declared) const {
  ParamSet known;
  known.where = choice.params.where;
  if (&choice != &camera_) return known;
  for (const ParamDecl& decl : declared)
    if (const ParsedParam* param = choice.params.Find(decl.name)) known.Add(*param);
  return known;
}

// Replaces the name. KeepSharedParameters selects the parameters later, when plugins can be loaded.
void RenderDirectives::OverrideIntegrator() {
  if (!options_.integrator) return;
  fileIntegrator_ = integrator_.name;
  integrator_.name = *options_.integrator;
  integrator_.params.where = SourceLocation();
  integrator_.params.where.file = kCommandLineLocation;
  integrator_.params.where.line = 1;
  integrator_.params.where.lineText = "--integrator " + integrator_.name;
  integrator_.params.where.column = int(std::string("--integrator ").size()) + 1;
}

void RenderDirectives::Handle(Directive directive, const MovingTransform& current) {
  const std::string& name = directive.strings[0];
  Choice* choice = nullptr;
  switch (directive.spec->id) {
    case DirectiveId::Accelerator:
      choice = &accelerator_;
      break;
    case DirectiveId::Camera:
      choice = &camera_;
      worldToCamera_ = current;
      break;
    case DirectiveId::Film:
      RequireName("film", name, directive.Where(), {"image"});
      choice = &film_;
      break;
    case DirectiveId::PixelFilter:
      choice = &filter_;
      break;
    case DirectiveId::Renderer:
      RequireName("renderer", name, directive.Where(), KnownRenderers());
      choice = &renderer_;
      break;
    case DirectiveId::Sampler:
      choice = &sampler_;
      break;
    case DirectiveId::SurfaceIntegrator:
      choice = &integrator_;
      break;
    case DirectiveId::VolumeIntegrator:
      choice = &volumeIntegrator_;
      break;
    default:
      return;
  }
  *choice = {name, std::move(directive.params), true};
  if (choice == &integrator_) OverrideIntegrator();
  OverridePlugins();
}

void RenderDirectives::SetDefaultLocation(const SourceLocation& where) {
  for (Choice* choice :
       {&filter_, &film_, &sampler_, &accelerator_, &integrator_, &volumeIntegrator_, &camera_})
    if (choice->params.where.file.empty()) choice->params.where = where;
}

BindContext RenderDirectives::Bind(PluginKind kind, const std::string& name, Log& log) const {
  BindContext bind;
  bind.log = &log;
  bind.isStrict = options_.isStrict;
  bind.dialect = dialect_;
  bind.what = std::string(PluginKindName(kind)) + " \"" + name + "\"";
  return bind;
}

bool RenderDirectives::IsOfAnotherIntegrator(const ParameterOverride& set,
                                             PluginRegistry& registry) const {
  const auto declares = [&](const std::string& integrator) {
    const auto* const declared = registry.Declarations(PluginKind::Integrator, integrator);
    return declared && Declares(*declared, set.parameter);
  };
  return set.directive == kIntegratorDirective && !declares(integrator_.name) &&
         std::ranges::any_of(options_.comparedIntegrators, declares);
}

ParamSet RenderDirectives::Overridden(const char* directive, const Choice& choice, PluginKind kind,
                                      PluginRegistry& registry) const {
  const ParamTableBase& table = *registry.Find(kind, choice.name, choice.params.where).parameters;
  const std::vector<ParamDecl>& declared = table.Declarations();
  ParamSet params = choice.isReplaced ? KnownParameters(choice, declared) : choice.params;
  std::vector<ParameterOverride> sets = options_.parameters;
  std::erase_if(sets, [&](const auto& set) { return IsOfAnotherIntegrator(set, registry); });
  ApplyOverrides(sets, directive, std::string(PluginKindName(kind)) + " \"" + choice.name + "\"",
                 table, &params);
  if (kind != PluginKind::Integrator) return params;
  if (options_.integrator) AddNamedDefaults(declared, &params);
  if (options_.isQuick) ScaleForQuick(declared, &params);
  return params;
}

AcceleratorSpec RenderDirectives::Accelerator(PluginRegistry& registry) const {
  return {accelerator_.name,
          Overridden("Accelerator", accelerator_, PluginKind::Accelerator, registry),
          options_.threads};
}

void RenderDirectives::CreateFilm(Log& log, RenderSetup* setup) const {
  ParamSet params = film_.params;
  ApplyOverrides(options_.parameters, "Film", "film \"image\"", FilmParameterTable(), &params);
  BindContext bind;
  bind.log = &log;
  bind.isStrict = options_.isStrict;
  bind.what = "film \"image\"";
  setup->film = FilmParameterTable().Bind(params, bind);
  if (options_.frame) NumberFrame(*options_.frame, params, &setup->film.filename);
  if (options_.cropWindow) setup->film.cropWindow = options_.cropWindow;
  if (options_.isQuick) {
    setup->film.xResolution = std::max(1, setup->film.xResolution / kQuickResolutionDivisor);
    setup->film.yResolution = std::max(1, setup->film.yResolution / kQuickResolutionDivisor);
  }
  setup->crop = options_.pixelBounds.value_or(setup->film.Crop());
  const PixelBounds full = setup->film.Full();
  if (options_.pixelBounds && options_.boundsResolution)
    setup->crop = ScaledBounds(setup->crop, *options_.boundsResolution, {full.x1, full.y1});
  if (options_.pixelBounds) {
    setup->crop = {std::max(setup->crop.x0, full.x0), std::max(setup->crop.y0, full.y0),
                   std::min(setup->crop.x1, full.x1), std::min(setup->crop.y1, full.y1)};
    if (setup->crop.IsEmpty())
      throw Error(ExitStatus::CommandLine, "the requested pixels lie outside the picture of " +
                                               std::to_string(full.x1) + " x " +
                                               std::to_string(full.y1));
  }
  if (!setup->crop.IsEmpty()) return;
  const ParsedParam* window = params.Find("cropwindow");
  if (options_.cropWindow || !window)
    throw Error(ExitStatus::CommandLine, "the crop window has no pixel's upper left corner");
  FailAt(window->where, "the crop window has no pixel's upper left corner");
}

void RenderDirectives::CheckRenderer(Log& log) const {
  static const ParamTable<RendererSettings> table{};
  BindContext bind;
  bind.log = &log;
  bind.isStrict = options_.isStrict;
  bind.what = "renderer \"sampler\"";
  table.Bind(renderer_.params, bind);
}

// Returns the samples per pixel of the file's own sampler.
std::int64_t RenderDirectives::SceneSamples(PluginRegistry& registry) const {
  Log silent(Log::Level::Quiet, Log::Sink::Memory);
  const auto sampler =
      registry.Create<PluginKind::Sampler>(sceneSampler_.name, sceneSampler_.params,
                                           Bind(PluginKind::Sampler, sceneSampler_.name, silent),
                                           SamplerContext{silent, sceneSampler_.params.where});
  return sampler->SamplesPerPixel();
}

void RenderDirectives::CreateSampler(PluginRegistry& registry, Log& log, RenderSetup* setup) const {
  const ParamSet params = Overridden("Sampler", sampler_, PluginKind::Sampler, registry);
  setup->samplerName = sampler_.name;
  setup->sampler = registry.Create<PluginKind::Sampler>(
      sampler_.name, params, Bind(PluginKind::Sampler, sampler_.name, log),
      SamplerContext{log, sampler_.params.where});
  std::optional<std::int64_t> count = options_.samplesPerPixel;
  if (options_.isQuick && !count) count = 1;
  if (sampler_.isReplaced && !count) count = SceneSamples(registry);
  if (!count) return;
  setup->sampler = setup->sampler->WithSamplesPerPixel(*count);
  const std::int64_t made = setup->sampler->SamplesPerPixel();
  if (made != *count)
    log.Notice("sampler \"" + sampler_.name + "\" takes " + Counted(made, "sample") +
               " a pixel instead of " + std::to_string(*count));
}

void RenderDirectives::KeepSharedParameters(PluginRegistry& registry, Log& log) {
  if (fileIntegrator_ == integrator_.name || integrator_.params.IsEmpty()) return;
  const auto* to = registry.Declarations(PluginKind::Integrator, integrator_.name);
  if (!options_.integrator || !to) return;
  const auto* from = registry.Declarations(PluginKind::Integrator, fileIntegrator_);
  exphoton::KeepSharedParameters({fileIntegrator_, integrator_.name, from, *to}, log,
                                 &integrator_.params);
}

void RenderDirectives::CreateIntegrator(PluginRegistry& registry, Log& log,
                                        RenderSetup* setup) const {
  for (const ParameterOverride& set : options_.parameters)
    if (IsOfAnotherIntegrator(set, registry))
      log.Notice("--set " + set.directive + "." + set.parameter +
                 " does not apply to integrator \"" + integrator_.name + "\"");
  const ParamSet params =
      Overridden(kIntegratorDirective, integrator_, PluginKind::Integrator, registry);
  setup->integratorName = integrator_.name;
  setup->integratorParameters = params;
  setup->integrator = registry.Create<PluginKind::Integrator>(
      integrator_.name, params, Bind(PluginKind::Integrator, integrator_.name, log),
      IntegratorContext{log});
}

void RenderDirectives::CreateVolumeIntegrator(PluginRegistry& registry, Log& log, bool hasMedia,
                                              RenderSetup* setup) const {
  if (!hasMedia && !volumeIntegrator_.isGiven) return;
  const ParamSet params =
      Overridden("VolumeIntegrator", volumeIntegrator_, PluginKind::VolumeIntegrator, registry);
  auto integrator = registry.Create<PluginKind::VolumeIntegrator>(
      volumeIntegrator_.name, params,
      Bind(PluginKind::VolumeIntegrator, volumeIntegrator_.name, log), NoContext{});
  if (hasMedia) {
    setup->volumeIntegrator = std::move(integrator);
  } else {
    log.Notice("the scene has no Volume: volume integrator \"" + volumeIntegrator_.name +
                   "\" has nothing to do",
               volumeIntegrator_.params.where);
  }
}

void RenderDirectives::CreateCamera(PluginRegistry& registry, Log& log, RenderSetup* setup) const {
  ParamSet camera = Overridden("Camera", camera_, PluginKind::Camera, registry);
  if (options_.timeOffset != 0)
    ShiftExposure(registry.Find(PluginKind::Camera, camera_.name, camera_.params.where)
                      .parameters->Declarations(),
                  "camera \"" + camera_.name + '"', options_.timeOffset, &camera);
  setup->cameraName = camera_.name;
  setup->camera = registry.Create<PluginKind::Camera>(
      camera_.name, camera, Bind(PluginKind::Camera, camera_.name, log),
      CameraContext{MotionBetween(worldToCamera_.Inverted(), transformTimes_, "the camera",
                                  camera_.params.where, log),
                    setup->film.xResolution, setup->film.yResolution});
}

void RenderDirectives::CreateFilter(PluginRegistry& registry, Log& log, RenderSetup* setup) const {
  const ParamSet filter = Overridden("PixelFilter", filter_, PluginKind::Filter, registry);
  setup->filterName = filter_.name;
  setup->filterParameters = filter;
  setup->filter = registry.Create<PluginKind::Filter>(
      filter_.name, filter, Bind(PluginKind::Filter, filter_.name, log), NoContext{});
}

void RenderDirectives::ReplaceRenderer(Log& log) {
  for (const MissingRenderer& renderer : kMissingRenderers) {
    if (renderer_.name != renderer.name) continue;
    const std::string missing = "there is no renderer \"" + renderer_.name + '"';
    if (options_.isStrict) FailAt(renderer_.params.where, missing);
    const std::string by = renderer.integrator ? renderer.integrator : integrator_.name;
    log.Warning(missing + ": integrator \"" + by + "\" is used instead; " + renderer.loss,
                renderer_.params.where);
    if (!renderer.integrator || options_.integrator) return;
    const ParsedParam* const depth = renderer_.params.Find("maxdepth");
    integrator_ = {by, {}, true};
    integrator_.params.where = renderer_.params.where;
    if (depth) integrator_.params.Add(*depth);
    renderer_.params = {};
    return;
  }
}

void RenderDirectives::Create(PluginRegistry& registry, Log& log, bool hasMedia, RenderSetup* setup,
                              ErrorCollector* errors) {
  errors->Try([&] { ReplaceRenderer(log); });
  errors->Try([&] { CheckRenderer(log); });
  errors->Try([&] { CreateFilm(log, setup); });
  errors->Try([&] { CreateVolumeIntegrator(registry, log, hasMedia, setup); });
  errors->Try([&] { CreateCamera(registry, log, setup); });
  errors->Try([&] { CreateFilter(registry, log, setup); });
  errors->Try([&] { CreateSampler(registry, log, setup); });
  errors->Try([&] { KeepSharedParameters(registry, log); });
  errors->Try([&] { CreateIntegrator(registry, log, setup); });
  setup->acceleratorName = accelerator_.name;
}

}  // namespace exphoton
