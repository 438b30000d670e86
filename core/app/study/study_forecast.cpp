// SPDX-License-Identifier: BSD-2-Clause
// The estimate renders a rectangle in the centre of the picture, a sixteenth of its pixels. The
// phase "render" is scaled to the whole picture; all other phases, such as shooting photons, are
// counted as they are.
#include "core/app/study/study_forecast.h"

#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "core/app/analysis/results.h"
#include "core/app/options/values.h"
#include "core/app/process/child_process.h"
#include "core/app/process/signals.h"
#include "core/app/study/study_runner.h"
#include "core/base/error.h"
#include "core/base/format.h"

namespace exphoton::cli {
namespace {

namespace fs = std::filesystem;

constexpr double kPart = 16;             // the probe renders 1/16 of the pixels
constexpr double kMaxProbeSeconds = 60;  // then the rest is estimated by the mean
constexpr std::uint64_t kProbeSeed = 1;

// A folder that is removed with its files.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::string name = (fs::temp_directory_path() / "exphoton-plan-XXXXXX").string();
    if (!mkdtemp(name.data())) throw Error(ExitStatus::File, "cannot make \"" + name + '"');
    path_ = name;
  }
  ~ScratchFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  std::string File(const char* name) const { return path_ + '/' + name; }

 private:
  std::string path_;
};

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

// Returns the estimated wall seconds of one render. Returns nullopt if the probe failed; the study
// itself will then explain the failure.
std::optional<double> Probe(const StudyOptions& options, const study::Setting& setting,
                            const ScratchFolder& folder) {
  if (const std::string* time = setting.Find("time")) return std::strtod(time->c_str(), nullptr);
  StudyOptions part = options;
  part.cropWindow = CentralPart(options);
  std::vector<std::string> arguments = RenderArguments(part, part.scene, setting, kProbeSeed);
  arguments.insert(arguments.end(), {"--quiet", "--no-progress", "--stats-json",
                                     folder.File("probe.json"), "-o", folder.File("probe.exr")});
  if (!options.limits.empty()) arguments.insert(arguments.end(), {"--limits", options.limits});
  const ChildResult child = RunSelf(arguments, folder.File("probe.log"), StopFlag());
  if (child.wasInterrupted || StopFlag()) throw StudyInterrupted();
  if (child.status != 0) return {};
  study::RunRow row;
  study::AddRunStatistics(ReadTextFile(folder.File("probe.json")), &row);
  double seconds = child.wallSeconds;
  for (const auto& [name, wall] : row.phaseWall)
    if (name == "render") seconds += wall * (kPart - 1);
  return seconds;
}

std::string About(double seconds) {
  if (seconds < 100) return Format("%.0f s", std::ceil(seconds));
  if (seconds < 6000) return Format("%.0f min", seconds / 60);
  return Format("%.1f h", seconds / 3600);
}

}  // namespace

std::string ForecastText(const StudyOptions& options, const SceneFacts& scene,
                         const std::vector<study::Setting>& settings) {
  const ScratchFolder folder;
  const auto start = std::chrono::steady_clock::now();
  const auto spent = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  double sum = 0;
  std::size_t known = 0;
  for (const study::Setting& setting : settings) {
    if (spent() > kMaxProbeSeconds && !setting.Find("time")) continue;
    const std::optional<double> seconds = Probe(options, setting, folder);
    if (!seconds) continue;
    sum += *seconds;
    ++known;
  }
  const std::size_t renders = settings.size() * std::size_t(options.seeds);
  std::string text = Format("%zu renders of %d x %d pixels (%zu settings, %d seeds each)", renders,
                            scene.width, scene.height, settings.size(), options.seeds);
  if (known == 0) return text + "\n";
  double all = sum / double(known) * double(renders);
  text += ", about " + About(all) + "\n";
  if (!options.makeReference.empty()) {
    all += options.referenceSeconds;
    text += "a reference in two halves, about " + About(options.referenceSeconds) + "\n" +
            "about " + About(all) + " in all\n";
  }
  return text;
}

}  // namespace exphoton::cli
