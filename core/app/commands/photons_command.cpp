// SPDX-License-Identifier: BSD-2-Clause
// PrintPhotonsAt loads a scene, shoots its photons and traces one camera ray through the centre of
// a pixel. It prints the photons nearest to the hit point as a table and can plot their directions
// on the hemisphere.
#include "core/app/commands/photons_command.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/app/options/limits.h"
#include "core/app/options/option_parser.h"
#include "core/app/options/values.h"
#include "core/app/output/output_files.h"
#include "core/app/output/run_files.h"
#include "core/app/process/interrupt_watch.h"
#include "core/app/process/signals.h"
#include "core/app/report/template.h"
#include "core/base/log.h"
#include "core/base/parallel.h"
#include "core/base/progress.h"
#include "core/params/suggestions.h"
#include "core/parser/render_setup.h"
#include "core/plugins/registry.h"

namespace exphoton::cli {
namespace {

struct Options {
  std::string scene, pixel, map, plotFile, integrator;  // map: "" for the first one
  std::vector<std::string> sets, pluginFolders;
  int count = 50, threads = 0;
  std::uint64_t seed = 0;
  bool allowsScenePlugins = false;
  std::string limits;
};

Options ParsePhotonsOptions(const std::vector<std::string>& arguments) {
  Options options;
  OptionParser app("Prints the photons nearest to what a pixel shows.",
                   "exphoton info --photons-at");
  app.Add("--photons-at", options.pixel, "the pixel").Required().TypeName("x,y");
  app.Add("scene", options.scene, "the scene").Required();
  app.Add("--map", options.map, "the photon map to search; default: the integrator's first");
  app.Add("--count", options.count, "number of photons (default 50)").Between(1, 1000000);
  app.Add("--plot", options.plotFile, "also plot their directions to this file")
      .TypeName("FILE.svg");
  app.Add("--integrator", options.integrator, "as in exphoton render");
  app.Add("--set", options.sets, "as in exphoton render").OnePerUse();
  app.Add("--seed", options.seed, "seed of the random numbers");
  app.Add("--nthreads,--ncores", options.threads, "threads; 0: all cores").Between(0, 4096);
  app.Add("--plugin-dir", options.pluginFolders, "look for plugins in this folder first")
      .OnePerUse();
  AddScenePluginsOption(app, &options.allowsScenePlugins);
  AddLimitsOption(app, &options.limits);
  app.Parse(arguments);
  return options;
}

LoadOptions SceneOptions(const Options& options) {
  LoadOptions load;
  load.pluginFolders = PluginRegistry::DefaultFolders(options.pluginFolders);
  load.allowsScenePlugins = options.allowsScenePlugins;
  load.limits = ParseLimits(options.limits).scene;
  load.stop = &StopFlag();
  load.threads = options.threads;
  if (!options.integrator.empty()) load.integrator = options.integrator;
  for (const std::string& set : options.sets) load.parameters.push_back(ParseOverride(set));
  return load;
}

// Place is a surface point with its frame: n points towards the viewer, s and t are tangential.
// Photon maps hold a moving surface as it is at the start of its motion; toRest leads there.
struct Place {
  Point3 p;
  Normal3 n;
  Vector3 s, t;
  std::optional<Transform> toRest;  // only where the surface moves

  // Polar angle from the normal and azimuth about it, in degrees.
  double Polar(const Vector3& w) const {
    return std::acos(std::clamp(double(Dot(w, n)), -1., 1.)) * 180 / 3.14159265358979;
  }
  double Azimuth(const Vector3& w) const {
    return std::atan2(double(Dot(w, t)), double(Dot(w, s))) * 180 / 3.14159265358979;
  }
};

Place FindPlace(const RenderSetup& setup, const PixelBounds& pixel) {
  if (pixel.x1 > setup.film.xResolution || pixel.y1 > setup.film.yResolution)
    FailUsage("--photons-at lies outside the picture");
  CameraSample sample;
  sample.film = {Real(pixel.x0) + Real(.5), Real(pixel.y0) + Real(.5)};
  sample.lens = {Real(.5), Real(.5)};
  const RayDifferential ray = setup.camera->GenerateRay(sample, false);
  const auto hit = setup.scene->Intersect(ray);
  if (!hit) FailUsage("no surface is visible at this pixel");
  Place place{hit->p, FaceForward(hit->ng, -ray.d), {}, {}, {}};
  // s lies along the world's x axis, or along its z axis if the normal is nearly parallel to x.
  const Vector3 n(place.n);
  const Vector3 axis = std::abs(n.x) < Real(.9) ? Vector3(1, 0, 0) : Vector3(0, 0, 1);
  place.s = Normalize(axis - n * Dot(axis, n));
  place.t = Cross(n, place.s);
  if (hit->motion) place.toRest = hit->motion->ToStart(hit->time);
  return place;
}

std::string TableText(const Place& place, const std::vector<StoredPhoton>& photons) {
  char line[256];
  std::snprintf(line, sizeof line, "# point %.6g %.6g %.6g, normal %.4f %.4f %.4f\n",
                double(place.p.x), double(place.p.y), double(place.p.z), double(place.n.x),
                double(place.n.y), double(place.n.z));
  std::string text = line;
  text +=
      "# distance; direction to where it came from: x y z, degrees from the normal, degrees about "
      "it; power R G B\n";
  for (const StoredPhoton& photon : photons) {
    std::snprintf(line, sizeof line, "%-12.6g %8.4f %8.4f %8.4f %7.2f %8.2f  %.5g %.5g %.5g\n",
                  double(photon.distance), double(photon.wi.x), double(photon.wi.y),
                  double(photon.wi.z), place.Polar(photon.wi), place.Azimuth(photon.wi),
                  double(photon.power[0]), double(photon.power[1]), double(photon.power[2]));
    text += line;
  }
  return text;
}

// Plots directions by Lambert's azimuthal equal-area projection, so that areas in the plot are
// proportional to solid angles. The area of a dot is proportional to the photon's power.
std::string PlotText(const Place& place, const std::vector<StoredPhoton>& photons) {
  using study::Fill;
  constexpr double kCentre = 180, kRadius = 150, kDegree = 3.14159265358979 / 180;
  const auto radius = [](double polar) {
    return kRadius * std::sqrt(2.) * std::sin(polar * kDegree / 2);
  };
  study::Html rings, dots;
  for (const double polar : {30., 60., 90.}) {
    const double r = radius(polar);
    rings += Fill("photon-ring", {{"radius", r}, {"textY", kCentre - r - 3}, {"degrees", polar}});
  }
  double mean = 0;
  for (const StoredPhoton& photon : photons)
    mean += double(photon.power.Y()) / double(photons.size());
  for (const StoredPhoton& photon : photons) {
    const double r = radius(place.Polar(photon.wi)), angle = place.Azimuth(photon.wi) * kDegree;
    dots += Fill("photon-dot",
                 {{"x", kCentre + r * std::cos(angle)},
                  {"y", kCentre - r * std::sin(angle)},
                  {"radius", 4 * std::sqrt(std::max(0., double(photon.power.Y()) / mean))}});
  }
  return Fill("photon-plot", {{"rings", rings}, {"dots", dots}}).Markup() + "\n";
}

// Returns the index of the map with this name, or 0 for the name "" and where there are no maps.
std::size_t FindMap(const std::string& name, const std::vector<std::string>& maps) {
  if (name.empty() || maps.empty()) return 0;
  const auto found = std::find(maps.begin(), maps.end(), name);
  if (found != maps.end()) return std::size_t(found - maps.begin());
  std::string list;
  for (const std::string& map : maps) list += (list.empty() ? "" : ", ") + map;
  FailUsage("--map: there is no photon map \"" + name + "\"; available: " + list,
            DidYouMean(name, maps));
}

// Returns the photons nearest to the place in the map that the user chose, as the surface is seen.
// Preprocess must have run.
std::vector<StoredPhoton> PhotonsAt(const Place& place, std::size_t map, int count,
                                    const RenderSetup& setup, Log& log) {
  const std::vector<std::string> maps = setup.integrator->PhotonMapNames();
  const Point3 p = place.toRest ? place.toRest->ApplyPoint(place.p) : place.p;
  std::vector<StoredPhoton> photons;
  if (!maps.empty()) photons = setup.integrator->PhotonsNear(p, map, count);
  if (place.toRest) {
    const Transform fromRest = place.toRest->Inverted();
    for (StoredPhoton& photon : photons)
      photon.wi = NormalizeOr(fromRest.ApplyVector(photon.wi), photon.wi);
  }
  if (photons.empty())
    log.Warning("integrator \"" + setup.integratorName + "\" has no " +
                (maps.empty() ? "photon maps" : maps[map] + " photons in this scene"));
  return photons;
}

void CheckFiles(const Options& options, const RenderSetup& setup, Log& log) {
  if (options.plotFile.empty()) return;
  RunFiles files;
  files.AddPluginFolders(PluginRegistry::DefaultFolders(options.pluginFolders));
  files.AddScene(setup);
  files.AddOutput("plot", {options.plotFile, "the plot", "--plot FILE.svg names another file"});
  files.Check(log);
}

}  // namespace

void PrintPhotonsAt(const std::vector<std::string>& arguments) {
  const Options options = ParsePhotonsOptions(arguments);
  const PixelBounds pixel = ParsePixel(options.pixel, "--photons-at");
  Log log(Log::Level::Quiet);
  FileSource source;
  const Limits limits = ParseLimits(options.limits);
  LimitMemory(limits);
  const InterruptWatch watch(limits.seconds);
  const auto setups = LoadScenes(source, options.scene, SceneOptions(options), log);
  const RenderSetup& setup = *setups.front();
  CheckFiles(options, setup, log);
  const std::size_t map = FindMap(options.map, setup.integrator->PhotonMapNames());
  const Place place = FindPlace(setup, pixel);
  ThreadPool threads(options.threads);
  ProgressReporter progress(ProgressReporter::Mode::Quiet);
  Statistics statistics;
  SampleLayout layout;
  setup.integrator->RequestSamples(*setup.scene, *setup.sampler, &layout);
  PreprocessContext context{threads,
                            options.seed,
                            log,
                            progress,
                            statistics,
                            false,
                            setup.camera.get(),
                            {setup.film.xResolution, setup.film.yResolution},
                            setup.volumeIntegrator.get()};
  setup.integrator->Preprocess(*setup.scene, context);
  const auto photons = PhotonsAt(place, map, options.count, setup, log);
  PrintOut(TableText(place, photons));
  if (!options.plotFile.empty()) WriteTextFile(options.plotFile, PlotText(place, photons));
}

}  // namespace exphoton::cli
