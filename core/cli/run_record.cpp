// SPDX-License-Identifier: BSD-2-Clause
// Statistics as a table, and the text of `exphoton explain`. JSON is in run_json.cpp.
#include "core/cli/run_record.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace exphoton::cli {
namespace {

template <class... Args>
std::string Print(const char* format, Args... args) {
  char text[512];
  std::snprintf(text, sizeof text, format, args...);
  return text;
}

// Counts without decimals, others with what they need.
std::string Number(double value) {
  return value == std::floor(value) && std::abs(value) < 1e15 ? Print("%.0f", value)
                                                              : Print("%.6g", value);
}

std::string Resolution(const RenderSetup& setup) {
  const PixelBounds &full = setup.film.Full(), &crop = setup.crop;
  std::string text = Print("%d x %d", full.Width(), full.Height());
  if (!(crop == full))
    text += Print(", of which x %d to %d, y %d to %d", crop.x0, crop.x1 - 1, crop.y0, crop.y1 - 1);
  return text;
}

std::string Row(const std::string& label, const std::string& text) {
  return Print("%-13s ", label.c_str()) + text + "\n";
}

}  // namespace

std::string HashText(std::uint64_t hash) {
  return Print("%016llx", static_cast<unsigned long long>(hash));
}

std::string StatisticsTable(const RunRecord& run) {
  std::string text =
      Row("scene", run.setup.sceneName) + Row("integrator", run.setup.integratorName) +
      Row("picture", Resolution(run.setup)) +
      Row("samples", std::to_string(run.setup.sampler->SamplesPerPixel()) + " a pixel") +
      Row("threads", std::to_string(run.threads)) +
      Print("\n%-30s %12s %12s\n", "phase", "seconds", "CPU seconds");
  for (const Statistics::Phase& phase : run.statistics.Phases())
    text += Print("%-30s %12.3f %12.3f\n", phase.name.c_str(), phase.wallSeconds, phase.cpuSeconds);
  text += Print("\n%-30s %12s\n", "rays", "count");
  const RayCounters rays = run.statistics.Rays();
  std::uint64_t total = 0;
  for (int i = 0; i < kRayKindCount; ++i) {
    const std::uint64_t count = rays.counts[std::size_t(i)];
    total += count;
    text +=
        Print("%-30s %12llu\n", RayKindName(RayKind(i)), static_cast<unsigned long long>(count));
  }
  text += Print("%-30s %12llu\n", "all", static_cast<unsigned long long>(total));
  const std::vector<Statistics::Counter> counters = run.statistics.Counters();
  if (!counters.empty()) text += Print("\n%-30s %12s  meaning\n", "counter", "value");
  for (const Statistics::Counter& counter : counters)
    text += Print("%-30s %12s  ", counter.name.c_str(), Number(counter.value).c_str()) +
            counter.meaning + "\n";
  return text;
}

std::string ExplainText(const RenderSetup& setup) {
  std::string plugins = std::to_string(setup.plugins.size()) + " loaded";
  for (std::size_t i = 0; i < setup.plugins.size(); ++i)
    plugins += (i ? ", " : ": ") + setup.plugins[i];
  std::string computed;
  for (const std::string& line : setup.integrator->Explain(*setup.scene)) computed += line + "\n";
  return Row("scene", setup.sceneName) + Row("hash", HashText(setup.sceneHash)) +
         Row("integrator", setup.integratorName) + Row("sampler", setup.samplerName) +
         Row("samples", std::to_string(setup.sampler->SamplesPerPixel()) + " a pixel") +
         Row("filter", setup.filterName) + Row("camera", setup.cameraName) +
         Row("accelerator", setup.acceleratorName) + Row("picture", Resolution(setup)) +
         Row("primitives", std::to_string(setup.scene->Primitives().Count())) +
         setup.scene->Effects().Describe() + computed + Row("plugins", plugins);
}

}  // namespace exphoton::cli
