// SPDX-License-Identifier: BSD-2-Clause
// This file formats statistics as a table and the text of `exphoton explain`. The file run_json.cpp
// writes JSON.
#include "core/app/output/run_record.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "core/base/format.h"
#include "core/base/terminal.h"
#include "core/render/sharing/sharing_plan.h"

namespace exphoton::cli {
namespace {

// The widths of the first two columns of a table of --stats.
struct TableColumns {
  int name, value;
};
constexpr TableColumns kPhaseColumns{14, 29}, kRayColumns{10, 24}, kCounterColumns{25, 14};

// Prints integers without decimals and other values with six significant digits.
std::string Number(double value) {
  return value == std::floor(value) && std::abs(value) < 1e15 ? Format("%.0f", value)
                                                              : Format("%.6g", value);
}

std::string Resolution(const PixelBounds& full, const PixelBounds& crop) {
  std::string text = Format("%d x %d", full.Width(), full.Height());
  if (!(crop == full))
    text += Format(", of which x %d to %d, y %d to %d", crop.x0, crop.x1 - 1, crop.y0, crop.y1 - 1);
  return text;
}

std::string Row(const std::string& label, const std::string& text) {
  return Format("%-13s ", label.c_str()) + text + "\n";
}

// Returns "" if sharing was not asked for.
std::string SharingRow(const RenderSetup& setup) {
  const SharingPlan plan = PlanSharing(*setup.integrator, *setup.scene, *setup.camera);
  if (plan.reason.empty()) return "";
  return Row("shared gather", (plan.isOn ? "on   " : "off  ") + plan.reason);
}

// Returns "" if no pixel has more samples than the others.
std::string EdgeRow(const RenderSetup& setup) {
  const int samples = setup.integrator->EdgeSamples();
  if (samples == 1) return "";
  return Row("edges", Format("%d camera samples for one where a pixel shows several surfaces, each "
                             "with 1/%d of the gather rays, at least 2",
                             samples, samples));
}

// Describes a phase of Statistics; "" for phases of plugins, which have descriptive names.
const char* PhaseMeaning(const std::string& name) {
  const std::pair<const char*, const char*> meanings[] = {
      {"pilots", "small renders that choose the settings of an accuracy"},
      {"given up", "attempts before the picture began again"},
      {"parse", "reading the scene: files, plugins, textures, meshes"},
      {"accelerator", "building the acceleration structure"},
      {"shoot", "tracing photons from the lights"},
      {"photon maps", "sorting photons for searching, and choosing radii"},
      {"radiance", "computing the radiance at radiance photons"},
      {"render", "camera rays and all rays that follow from them"},
      {"share", "sharing gathered light between neighbouring pixels"},
      {"write", "writing the picture"}};
  for (const auto& [known, meaning] : meanings)
    if (name == known) return meaning;
  return "";
}

const char* RayMeaning(RayKind kind) {
  switch (kind) {
    case RayKind::Camera:
      return "from the camera";
    case RayKind::Shadow:
      return "from a surface to a point on a light";
    case RayKind::Bsdf:
      return "from a surface, in a direction sampled from its BSDF";
    case RayKind::Specular:
      return "over mirrors and through glass, on the camera's side";
    case RayKind::Gather:
      return "of the final gather, over the hemisphere of a surface";
    case RayKind::Photon:
      return "that carried a photon";
  }
  return "";
}

// Inserts a comma after each group of three digits before the decimal point: "1,234,567".
std::string Grouped(std::string digits) {
  const std::size_t begin = digits.starts_with('-') ? 1 : 0;
  const std::size_t end = std::min(digits.find_first_of(".e"), digits.size());
  for (std::size_t at = end; at > begin + 3;) digits.insert(at -= 3, ",");
  return digits;
}

// Scales bytes to "13.2 MB" and similar.
std::string Bytes(double bytes) {
  const char* const units[] = {"B", "kB", "MB", "GB", "TB"};
  std::size_t unit = 0;
  for (; bytes >= 1000 && unit + 1 < std::size(units); ++unit) bytes /= 1000;
  return Format(unit == 0 ? "%.0f %s" : "%.1f %s", bytes, units[unit]);
}

// The meaning wraps to the terminal, under itself.
std::string TableRow(const TableColumns& columns, const std::string& name, const std::string& value,
                     const std::string& meaning) {
  std::string line = name;
  line.resize(std::max(std::size_t(columns.name), name.size() + 1), ' ');
  line +=
      Format("%*s  ", std::max(0, columns.name + columns.value - int(line.size())), value.c_str());
  const std::string lines = WrappedText(meaning, int(line.size()), OutputColumns());
  return lines.empty() ? line + '\n' : line + lines.substr(line.size());
}

std::string PhaseTable(const RunRecord& run) {
  std::string text = '\n' + TableRow(kPhaseColumns, "phase", "time    CPU time   share", "meaning");
  const auto row = [&](const char* name, double wall, double cpu, const char* meaning) {
    const double share = run.wallSeconds > 0 ? 100 * wall / run.wallSeconds : 0;
    text += TableRow(kPhaseColumns, name, Format("%.3f s  %8.3f s  %4.1f %%", wall, cpu, share),
                     meaning);
  };
  for (const Statistics::Phase& phase : run.statistics.Phases())
    row(phase.name.c_str(), phase.wallSeconds, phase.cpuSeconds, PhaseMeaning(phase.name));
  row("all", run.wallSeconds, run.cpuSeconds, "from reading the scene to writing the picture");
  return text;
}

std::string RayTable(const RunRecord& run) {
  const RayCounters rays = run.statistics.Rays();
  const double total = double(std::max<std::uint64_t>(rays.Total(), 1));
  std::string text = '\n' + TableRow(kRayColumns, "rays", "count   share", "meaning");
  const auto row = [&](const char* name, std::uint64_t count, const std::string& meaning) {
    text +=
        TableRow(kRayColumns, name,
                 Grouped(std::to_string(count)) + Format("  %5.1f %%", 100 * double(count) / total),
                 meaning);
  };
  for (int i = 0; i < kRayKindCount; ++i)
    row(RayKindName(RayKind(i)), rays.counts[std::size_t(i)], RayMeaning(RayKind(i)));
  const double rate = run.renderSeconds > 0 ? double(rays.Total()) / run.renderSeconds : 0;
  row("all", rays.Total(),
      "rays that were traced, " + Grouped(Format("%.0f", rate)) + " per second");
  return text;
}

std::string CounterTable(const std::vector<Statistics::Counter>& counters) {
  std::string text;
  if (!counters.empty()) text = '\n' + TableRow(kCounterColumns, "counter", "value", "meaning");
  for (const Statistics::Counter& counter : counters) {
    const bool isMemory = counter.name.find("memory") != std::string::npos;
    text +=
        TableRow(kCounterColumns, counter.name,
                 isMemory ? Bytes(counter.value) : Grouped(Number(counter.value)), counter.meaning);
  }
  return text;
}

// The error at the end of a render with --accuracy.
std::string AccuracyText(const RunRecord& run) {
  if (!run.upperError)
    return "one group of passes cannot show whether the accuracy of " +
           Plain(100 * *run.accuracy, 3) + " % is reached" +
           (run.stoppedBy == "time-limit" ? ", and the time limit leaves no time for another" : "");
  const double percent = 100 * std::sqrt(*run.upperError);
  const std::string digits = Plain(percent, 3);
  std::string text = digits == "0" ? "the estimated error is 0"
                                   : "the error lies below " + digits + " % (at a level of 95 %)";
  if (!run.omitted.empty())
    text +=
        ", of which effects left out are at most " + Plain(100 * BoundOf(run.omitted), 2) + " %";
  if (run.stoppedBy == "accuracy") return text;
  text += ", which is not the accuracy of " + Plain(100 * *run.accuracy, 3) + " %: ";
  if (run.stoppedBy == "bias") return text + "the bias is larger; more photons reduce it";
  if (run.stoppedBy == "time-limit") return text + "the time limit came first";
  return text + "the limit of samples or passes came first";
}

}  // namespace

std::string StatisticsTable(const RunRecord& run) {
  std::string text =
      Row("scene", run.scene.name) + Row("integrator", run.scene.integrator) +
      Row("picture", Resolution(run.scene.full, run.scene.crop)) +
      Row("samples", std::to_string(run.samplesPerPixel) + " a pixel in " +
                         std::to_string(run.passes) + (run.passes == 1 ? " pass" : " passes")) +
      Row("threads", std::to_string(run.threads));
  if (run.noise)
    text += Row("noise", Format("%.3g", *run.noise) +
                             " of relMSE, estimated between passes (bias not included)");
  if (run.sharingBias)
    text += Row("sharing bias",
                Format("%.2g \u00b1 %.2g of relMSE, estimated between groups of samples",
                       run.sharingBias->squared, run.sharingBias->standardError));
  if (run.certificate) text += Row("certificate", ErrorText(*run.certificate));
  return text + PhaseTable(run) + RayTable(run) + CounterTable(run.statistics.Counters());
}

void RecordPasses(const PassesResult& result, RunRecord* run) {
  run->isComplete = result.render.isComplete;
  run->nonFiniteSamples = result.render.nonFiniteSamples;
  run->samplesPerPixel = result.samplesPerPixel;
  run->passes = result.passes;
  run->stoppedBy = StopReasonName(result.reason);
  run->noise = result.noise;
  run->noiseError = result.noiseError;
  run->upperError = result.upperError;
  run->choice += result.changes;
  run->sharingBias = result.render.sharingBias;
  run->lastDiskArea = result.lastDiskArea;
}

std::string RenderTimes(const RunRecord& run) {
  std::string text = Format("%.2f s", run.renderSeconds);
  if (run.givenUp > 0)
    text += Format(", after %.2f s for ", run.givenUpSeconds) +
            Counted(run.givenUp, "given-up attempt");
  return text;
}

std::string StoppingText(const RunRecord& run) {
  std::string text;
  if (run.accuracy)
    text = AccuracyText(run);
  else if (run.stoppedBy == "target-error")
    text = Format("reached the target error %.3g", *run.targetError);
  else if (run.stoppedBy == "time-limit")
    text = Format("stopped at the last whole pass within %.6g s", *run.timeLimit);
  else if (run.lastDiskArea)
    text = "rendered all progressive passes";
  else if (run.targetError || run.timeLimit)
    text = "stopped at the limit of samples";
  else
    text = "two independent halves";
  if (!run.isComplete) text = "stopped by a signal";
  text += ": " + Counted(run.samplesPerPixel, "sample") +
          Format(" a pixel in %d %s", run.passes, run.passes == 1 ? "pass" : "passes");
  if (run.lastDiskArea)
    text += Format(", the last one with %.3g %% of the radii", 100 * std::sqrt(*run.lastDiskArea));
  if (!run.noise) return run.accuracy ? text : text + ", which give no estimate of the noise";
  text += "; noise \u00b1" + Plain(100 * std::sqrt(*run.noise), 2) +
          Format(" %% (bias not included), relMSE of the noise %.3g", *run.noise);
  if (!run.sharingBias) return text;
  return text + Format(", of the bias of shared gathers %.2g \u00b1 %.2g", run.sharingBias->squared,
                       run.sharingBias->standardError);
}

std::string ExplainText(const RenderSetup& setup) {
  std::string plugins = std::to_string(setup.plugins.size()) + " loaded";
  for (std::size_t i = 0; i < setup.plugins.size(); ++i)
    plugins += (i ? ", " : ": ") + setup.plugins[i];
  std::string computed;
  for (const std::string& line : setup.integrator->Explain(*setup.scene)) computed += line + "\n";
  for (const std::string& light : setup.integrator->UnseenLight(*setup.scene))
    computed += Row("unseen", light + ", which this integrator never finds");
  return Row("scene", setup.sceneName) + Row("hash", HashText(setup.sceneHash)) +
         Row("integrator", setup.integratorName) + Row("sampler", setup.samplerName) +
         Row("samples", std::to_string(setup.sampler->SamplesPerPixel()) + " a pixel") +
         Row("filter", setup.filterName) + Row("camera", setup.cameraName) +
         Row("accelerator", setup.acceleratorName) +
         Row("picture", Resolution(setup.film.Full(), setup.crop)) +
         Row("primitives", std::to_string(setup.scene->Primitives().Count())) +
         setup.scene->Features().Describe() + computed + SharingRow(setup) + EdgeRow(setup) +
         Row("plugins", plugins);
}

}  // namespace exphoton::cli
