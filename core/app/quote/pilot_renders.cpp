// SPDX-License-Identifier: BSD-2-Clause
// PilotRenders: the number of samples doubles until the time is used up. Samples fill the time, so
// that the last pilot is the most accurate one.
#include "core/app/quote/pilot_renders.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/app/process/child_process.h"
#include "core/app/process/signals.h"
#include "core/app/process/temporary_folder.h"
#include "core/base/error.h"
#include "core/imaging/files/exr.h"

namespace exphoton::cli {
namespace {

using Json = nlohmann::json;

constexpr double kPilotPixels = 3000;
constexpr int kMostPilots = 8;

struct PilotResult {
  Json statistics;
  MeanLight light;  // of two halves
  std::string failure;

  double Phase(std::initializer_list<const char*> names) const {
    double sum = 0;
    for (const Json& phase : statistics.at("phases"))
      for (const char* name : names)
        if (phase.at("name") == name) sum += phase.at("cpuSeconds").get<double>();
    return sum;
  }
  double Counter(const char* name) const {
    return statistics.value("counters", Json::object()).value(name, 0.);
  }
};

std::string LastLine(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  const std::size_t line = text.rfind('\n');
  return line == std::string::npos ? text : text.substr(line + 1);
}

// The pilots of one integrator at one size.
class PilotSeries {
 public:
  PilotSeries(const QuoteScene& scene, std::string integrator)
      : scene_(scene), integrator_(std::move(integrator)) {}

  // rule: --two-halves, or --certify to estimate the bias, which takes longer.
  PilotResult Render(int samples, double scale, const char* rule) const {
    const std::string size = std::to_string(std::max(4, int(scale * scene_.width + .5))) + "x" +
                             std::to_string(std::max(4, int(scale * scene_.height + .5)));
    const std::string statistics = folder_.File("pilot.json"), picture = folder_.File("pilot.exr");
    std::vector<std::string> arguments{"render", scene_.path, "--integrator", integrator_};
    arguments.insert(arguments.end(), scene_.options.begin(), scene_.options.end());
    arguments.insert(arguments.end(),
                     {"--resolution", size, "--spp", std::to_string(samples), rule, "--quiet",
                      "--no-progress", "--stats-json", statistics, "-o", picture});
    if (StopFlag()) throw QuoteInterrupted();
    const ChildResult child = RunSelf(arguments, folder_.File("pilot.log"), StopFlag());
    if (child.wasInterrupted || StopFlag()) throw QuoteInterrupted();
    PilotResult result;
    if (child.status != 0) {
      result.failure = LastLine(child.messages);
      return result;
    }
    result.statistics = Json::parse(ReadTextFile(statistics));
    result.light = MeanOf(ReadExr(picture));
    return result;
  }

 private:
  // Returns one value per pixel, the mean of three channels such as "half1.R".
  static std::vector<double> LightOf(const Image& image, const std::string& layer) {
    std::vector<double> light(std::size_t(image.Width()) * std::size_t(image.Height()));
    for (const char* name : {".R", ".G", ".B"}) {
      const int channel = image.FindChannel(layer + name);
      for (std::size_t i = 0; channel >= 0 && i < light.size(); ++i)
        light[i] += double(image.pixels[i * image.channels.size() + std::size_t(channel)]) / 3;
    }
    return light;
  }
  static MeanLight MeanOf(const Image& image) {
    return MeanOfHalves(LightOf(image, "half1"), LightOf(image, "half2"),
                        std::size_t(image.Width()));
  }

  const QuoteScene& scene_;
  std::string integrator_;
  TemporaryFolder folder_{"quote"};
};

double NumberOr(const Json& json, const char* name, double instead) {
  const auto found = json.find(name);
  return found != json.end() && found->is_number() ? found->get<double>() : instead;
}

void TakeBias(const PilotResult& pilot, Quote* quote) {
  if (!pilot.failure.empty()) return;
  const auto found = pilot.statistics.find("certificate");
  if (found == pilot.statistics.end()) return;
  quote->model.bias = NumberOr(*found, "bias", 0);
  quote->model.biasUpper = std::max(NumberOr(*found, "biasUpper", 0), quote->model.bias);
  quote->notCovered = found->value("notCovered", std::vector<std::string>());
}

// Pilots in two halves shoot photons twice.
void TakeCosts(const PilotResult& pilot, double pixelRatio, Quote* quote) {
  const double samples = pilot.statistics.at("samplesPerPixel").get<double>();
  PriceModel& model = quote->model;
  model.fixed = pilot.Phase({"parse", "accelerator"}) + pilot.Phase({"write"}) * pixelRatio;
  model.maps = pilot.Phase({"shoot", "photon maps", "radiance"}) / 2;
  model.sample = pilot.Phase({"render", "share"}) * pixelRatio / samples;
  quote->indirectPhotons = pilot.Counter("photons/indirect stored") / 2;
  quote->causticPhotons = pilot.Counter("photons/caustic stored") / 2;
}

}  // namespace

QuoteScene MakeQuoteScene(const StudyOptions& options, const SceneFacts& facts) {
  QuoteScene scene{options.scene, facts.width, facts.height, "", {}};
  const auto add = [&](const char* option, const std::string& value) {
    scene.options.insert(scene.options.end(), {option, value});
  };
  for (const std::string& set : options.sets) add("--set", set);
  for (const std::string& folder : options.pluginFolders) add("--plugin-dir", folder);
  if (options.allowsScenePlugins) scene.options.push_back("--allow-scene-plugins");
  if (options.threads > 0) add("--nthreads", std::to_string(options.threads));
  return scene;
}

Quote RunPilots(const QuoteScene& scene, const std::string& integrator, bool hasBias,
                double seconds) {
  Quote quote;
  quote.integrator = integrator;
  const PilotSeries series(scene, integrator);
  const double pixels = double(scene.width) * double(scene.height);
  const double scale = std::min(1., std::sqrt(kPilotPixels / pixels));
  std::vector<Pilot> pilots;
  double spent = 0;
  PilotResult last;
  for (int samples = 2; int(pilots.size()) < kMostPilots; samples *= 2) {
    PilotResult pilot = series.Render(samples, scale, "--two-halves");
    if (!pilot.failure.empty()) {
      quote.failure = pilot.failure;
      return quote;
    }
    last = std::move(pilot);
    pilots.push_back({last.statistics.at("samplesPerPixel").get<double>(),
                      NumberOr(last.statistics, "noise", 0),
                      NumberOr(last.statistics, "noiseError", 0)});
    const double cost = last.statistics.at("wallSeconds").get<double>();
    spent += cost;
    // The next pilot takes twice as long, and so does the one that estimates the bias.
    if (pilots.size() >= 2 && spent + (hasBias ? 4 : 2) * cost > seconds) break;
  }
  const auto& size = last.statistics.at("resolution");
  const double pilotPixels = size.at(0).get<double>() * size.at(1).get<double>();
  quote.model.hasPhotons = hasBias;  // photons of other integrators only guide
  TakeCosts(last, pixels / pilotPixels, &quote);
  if (hasBias) TakeBias(series.Render(int(pilots.back().samples), scale, "--certify"), &quote);
  quote.model.FitNoise(pilots);
  quote.light = last.light;
  quote.memory = last.statistics.at("peakMemoryBytes").get<double>() + 70 * (pixels - pilotPixels);
  return quote;
}

}  // namespace exphoton::cli
