// SPDX-License-Identifier: BSD-2-Clause
// The estimate renders a rectangle in the centre of the picture, a sixteenth of its pixels, with
// one sample a pixel. The phase "render" is scaled to the whole picture and to the setting's
// samples; all other phases, such as shooting photons, are counted as they are. Settings that
// differ only in their samples share a probe. No probe starts after a few seconds.
#include "core/app/study/study_forecast.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <optional>

#include "core/app/analysis/headline/lower_bound.h"
#include "core/app/analysis/results.h"
#include "core/app/options/values.h"
#include "core/app/process/child_process.h"
#include "core/app/process/signals.h"
#include "core/app/process/temporary_folder.h"
#include "core/app/study/study_runner.h"
#include "core/base/error.h"
#include "core/base/format.h"

namespace exphoton::cli {
namespace {

constexpr double kPart = 16;            // the probe renders 1/16 of the pixels
constexpr double kMaxProbeSeconds = 4;  // then the rest is estimated by the mean
constexpr std::uint64_t kProbeSeed = 1;

// Returns the central quarter of the width and height, inside the study's crop window.
std::string CentralPart(const StudyOptions& options) {
  double x0 = 0, x1 = 1, y0 = 0, y1 = 1;
  if (!options.cropWindow.empty()) {
    const std::vector<Real> c = ParseCropWindow(options.cropWindow);
    x0 = double(c[0]), x1 = double(c[1]), y0 = double(c[2]), y1 = double(c[3]);
  }
  const double share = 1 / std::sqrt(kPart) / 2, x = (x0 + x1) / 2, y = (y0 + y1) / 2;
  return Format("%.6g,%.6g,%.6g,%.6g", x - share * (x1 - x0), x + share * (x1 - x0),
                y - share * (y1 - y0), y + share * (y1 - y0));
}

// Cost is the wall time of a render of the whole picture.
struct Cost {
  double fixed = 0;      // seconds that do not depend on the samples
  double perSample = 0;  // seconds for one sample a pixel, or for the scene's number of samples
};

double SamplesOf(const study::Setting& setting) {
  const std::string* spp = setting.Find("spp");
  return spp ? std::max(1., std::strtod(spp->c_str(), nullptr)) : 1;
}

// Returns the setting with one sample a pixel, or as it is if the scene gives the samples.
study::Setting WithOneSample(study::Setting setting) {
  for (auto& [name, value] : setting.parameters)
    if (name == "spp") value = "1";
  return setting;
}

// Returns nullopt if the probe failed; the study itself will then explain the failure.
std::optional<Cost> Probe(const StudyOptions& options, const study::Setting& setting,
                          const TemporaryFolder& folder) {
  StudyOptions part = options;
  part.cropWindow = CentralPart(options);
  const std::uint64_t seed = options.photonFile.empty() ? kProbeSeed : 1;
  std::vector<std::string> arguments = RunArguments(part, setting, seed);
  arguments.insert(arguments.end(), {"--quiet", "--no-progress", "--stats-json",
                                     folder.File("probe.json"), "-o", folder.File("probe.exr")});
  if (!options.limits.empty()) arguments.insert(arguments.end(), {"--limits", options.limits});
  const ChildResult child = RunSelf(arguments, folder.File("probe.log"), StopFlag());
  if (child.wasInterrupted || StopFlag()) throw StudyInterrupted();
  if (child.status != 0) return {};
  study::RunRow row;
  study::AddRunStatistics(ReadTextFile(folder.File("probe.json")), &row);
  // A probe with a certificate has one sample in each of two halves.
  const double samples = setting.Find("spp") ? std::max(row.samplesPerPixel, 1.) : 1;
  Cost cost{child.wallSeconds, 0};
  for (const auto& [name, wall] : row.phaseWall)
    if (name == "render") cost = {child.wallSeconds - wall, wall * kPart / samples};
  return cost;
}

// Probes holds the costs that are known, and estimates the others by their means.
class Probes {
 public:
  explicit Probes(const StudyOptions& options) : options_(options) {}

  // Integrators take turns, so that each has a probe before the time is up.
  void Run(const std::vector<study::Setting>& settings) {
    const auto start = std::chrono::steady_clock::now();
    std::map<std::string, std::size_t> turns;
    std::vector<std::pair<std::size_t, const study::Setting*>> order;
    for (const study::Setting& setting : settings)
      if (!setting.Find("time")) order.emplace_back(turns[setting.integrator]++, &setting);
    std::stable_sort(order.begin(), order.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    for (const auto& [turn, setting] : order) {
      const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
      if (spent.count() > kMaxProbeSeconds) return;
      const study::Setting probed = WithOneSample(*setting);
      const std::string name = study::RunName(probed, kProbeSeed);
      if (known_.contains(name)) continue;
      const std::optional<Cost> cost = Probe(options_, probed, folder_);
      if (!cost) continue;
      known_[name] = *cost;
      byIntegrator_[setting->integrator].push_back(*cost);
      all_.push_back(*cost);
    }
  }

  bool IsEmpty() const { return all_.empty(); }
  double SecondsOf(const study::Setting& setting) const {
    if (const std::string* time = setting.Find("time")) return std::strtod(time->c_str(), nullptr);
    const auto own = known_.find(study::RunName(WithOneSample(setting), kProbeSeed));
    const auto similar = byIntegrator_.find(setting.integrator);
    const Cost cost = own != known_.end()              ? own->second
                      : similar != byIntegrator_.end() ? Mean(similar->second)
                                                       : Mean(all_);
    return cost.fixed + SamplesOf(setting) * cost.perSample;
  }

 private:
  static Cost Mean(const std::vector<Cost>& costs) {
    Cost mean;
    for (const Cost& cost : costs) {
      mean.fixed += cost.fixed / double(costs.size());
      mean.perSample += cost.perSample / double(costs.size());
    }
    return mean;
  }

  const StudyOptions& options_;
  TemporaryFolder folder_{"plan"};
  std::map<std::string, Cost> known_;
  std::map<std::string, std::vector<Cost>> byIntegrator_;
  std::vector<Cost> all_;
};

// Returns ", 24 with certificates" if there are any.
std::string CertificatesText(const StudyOptions& options,
                             const std::vector<study::Setting>& settings) {
  const auto count = std::ranges::count_if(
      settings, [&](const study::Setting& s) { return HasCertificate(options, s); });
  return count > 0 ? Format(", %zu with certificates", std::size_t(count * options.seeds)) : "";
}

std::string About(double seconds) {
  if (seconds < 100) return Format("%.0f s", std::ceil(seconds));
  if (seconds < 6000) return Format("%.0f min", seconds / 60);
  return Format("%.1f h", seconds / 3600);
}

}  // namespace

std::string ForecastText(const StudyOptions& options, const SceneFacts& scene,
                         const std::vector<study::Setting>& settings) {
  Probes probes(options);
  probes.Run(settings);
  const std::size_t renders = settings.size() * std::size_t(options.seeds);
  std::string text = Counted(std::int64_t(renders), "render") +
                     Format(" of %d x %d pixels (", scene.width, scene.height) +
                     Counted(std::int64_t(settings.size()), "setting") + ", " +
                     Counted(options.seeds, "seed") + (settings.size() == 1 ? "" : " each") +
                     CertificatesText(options, settings) + ')';
  const bool allHaveLimits = std::all_of(settings.begin(), settings.end(),
                                         [](const auto& setting) { return setting.Find("time"); });
  if (probes.IsEmpty() && !allHaveLimits) return text + "\n";
  double all = 0;
  for (const study::Setting& setting : settings) all += options.seeds * probes.SecondsOf(setting);
  text += ", about " + About(all) + "\n";
  const std::vector<study::Setting> bounds = study::ExpectedLowerBounds(settings);
  if (!bounds.empty()) {
    const int seeds = std::min(options.seeds, kMostBoundSeeds);
    double more = 0;
    for (const study::Setting& bound : bounds) more += seeds * probes.SecondsOf(bound);
    all += more;
    text += "at most " + Counted(std::int64_t(bounds.size()) * seeds, "more render") +
            " for lower bounds of the time" + (probes.IsEmpty() ? "" : ", about " + About(more)) +
            "\n";
  }
  if (!options.makeReference.empty()) {
    all += options.referenceSeconds;
    text += "a reference in two halves, about " + About(options.referenceSeconds) + "\n";
  }
  if (!bounds.empty() || !options.makeReference.empty())
    text += "about " + About(all) + " in all\n";
  return text;
}

}  // namespace exphoton::cli
