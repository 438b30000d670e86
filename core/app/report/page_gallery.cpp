// SPDX-License-Identifier: BSD-2-Clause
// This file makes the sections with pictures at equal time and equal error, maps, and the data.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "core/app/report/markup.h"
#include "core/app/report/page_pictures.h"
#include "core/app/report/page_sections.h"
#include "core/imaging/files/exr.h"
#include "core/imaging/metrics/flip.h"
#include "core/imaging/metrics/metrics.h"

namespace exphoton::study {
namespace {

constexpr double kErrorScale = .5;  // relative error shown as full red or blue

// Returns the setting on a line's Pareto front whose `member` is nearest to `value` (log ratio).
std::size_t Nearest(const Analysis& analysis, const Line& line, double value,
                    Measured CostPoint::*member) {
  std::size_t nearest = line.settings.front();
  double least = 1e300;
  for (const std::size_t i : ParetoFront(analysis.Points(line))) {
    const std::size_t s = line.settings[i];
    const double v = (analysis.settings[s].cost.*member).value;
    const double distance = v > 0 ? std::abs(std::log(v / value)) : 1e299;
    if (distance < least) least = distance, nearest = s;
  }
  return nearest;
}

// Gallery shows settings, each by the picture of its first seed.
class Gallery {
 public:
  Gallery(const std::string& folder, const Results& results, const Analysis& analysis)
      : folder_(folder), results_(results), analysis_(analysis) {
    const Image first = Read(0);
    reference_ = analysis.hasReference ? analysis.reference.mean : first;
    scale_ = DisplayScale(reference_);
    crops_ = results.crops;
    if (crops_.empty()) crops_.push_back(WorstWindow(first, reference_));
  }

  Html Figures(const std::vector<std::size_t>& settings) const {
    Html figures;
    if (analysis_.hasReference)
      figures += Fill("reference-figure",
                      {{"pictures", PictureAndCrops(reference_, "reference", "the reference")},
                       {"integrator", results_.reference.integrator}});
    for (std::size_t line = 0; line < settings.size(); ++line)
      figures += Figure(line, settings[line]);
    return figures;
  }

 private:
  Image Read(std::size_t setting) const {
    const std::size_t run = analysis_.settings[setting].runs.front();
    return ReadExr(PathOf(folder_, results_.runs[run].image));
  }

  Html PictureAndCrops(const Image& image, const std::string& alt, const std::string& whole) const {
    Html pictures = PictureElement(image, scale_, alt, false);
    for (const auto& crop : crops_)
      pictures += PictureElement(CropOf(image, crop), scale_, "part of " + whole, true);
    return pictures;
  }

  Html Figure(std::size_t line, std::size_t setting) const {
    const SettingResult& result = analysis_.settings[setting];
    const std::string& label = analysis_.lines[line].label;
    const Image image = Read(setting);
    Html pictures = PictureAndCrops(image, label, label);
    if (analysis_.hasReference)
      pictures += PictureElement(SignedErrorImage(reference_, image, kErrorScale), 1,
                                 "signed error of " + label, true);
    return Fill("figure", {{"pictures", pictures},
                           {"marker", LineMarker(line)},
                           {"label", label},
                           {"setting", results_.settings[result.setting].Text()},
                           {"seconds", SecondsText(result.cost.seconds.value)},
                           {"error", ShortNumber(result.cost.error.value)}});
  }

  const std::string& folder_;
  const Results& results_;
  const Analysis& analysis_;
  Image reference_;
  double scale_ = 1;
  std::vector<std::array<double, 4>> crops_;
};

// Returns the shortest time in which a line reaches the headline's error, or else the median time.
double CommonTime(const Analysis& analysis) {
  double time = 1e300;
  for (const Line& line : analysis.lines)
    if (line.toTarget.kind != TimeToError::Kind::Never)
      time = std::min(time, line.toTarget.seconds.value);
  if (time < 1e300) return time;
  std::vector<double> times;
  for (const SettingResult& s : analysis.settings) times.push_back(s.cost.seconds.value);
  std::nth_element(times.begin(), times.begin() + std::ptrdiff_t(times.size() / 2), times.end());
  return times[times.size() / 2];
}

Html SettingRow(const std::string& label, const std::string& setting, std::size_t line,
                const SettingResult& s) {
  return Fill("setting-row", {{"marker", LineMarker(line)},
                              {"label", label},
                              {"setting", setting},
                              {"cpu", MeasuredText(s.cpu)},
                              {"wall", MeasuredText(s.wall)},
                              {"relMse", MeasuredText(s.separation.relMse)},
                              {"trimmed", ShortNumber(s.trimmed)},
                              {"noise", MeasuredText(s.separation.variance)},
                              {"bias", MeasuredText(s.separation.bias2)},
                              {"mse", ShortNumber(s.mse)},
                              {"meanError", (s.relativeMean > 0 ? "+" : "") +
                                                ShortNumber(100 * s.relativeMean) + " %"},
                              {"p99", ShortNumber(s.p99)},
                              {"flip", ShortNumber(s.flip)},
                              {"nonFinite", s.nonFinite},
                              {"efficiency", ShortNumber(s.Efficiency())},
                              {"spp", ShortNumber(s.samplesPerPixel, 6)},
                              {"paths", CountText(s.photonPaths)},
                              {"photons", CountText(s.photonsStored)},
                              {"memory", ShortNumber(s.peakMemory / (1 << 20), 3)}});
}

Html SettingRows(const Results& results, const Analysis& analysis) {
  Html rows;
  for (std::size_t i = 0; i < analysis.lines.size(); ++i) {
    for (const std::size_t index : analysis.lines[i].settings) {
      const SettingResult& s = analysis.settings[index];
      rows += SettingRow(analysis.lines[i].label, results.settings[s.setting].Text(), i, s);
    }
  }
  return rows;
}

// Returns the command of each setting's first render, one a line.
std::string SettingCommands(const Results& results) {
  std::string text;
  std::set<std::size_t> seen;
  for (const RunRow& row : results.runs)
    if (seen.insert(row.setting).second) text += row.command + "\n";
  return text;
}

}  // namespace

Html PictureSection(const std::string& folder, const Results& results, const Analysis& analysis) {
  if (analysis.settings.empty()) return {};
  const Gallery gallery(folder, results, analysis);
  const double time = CommonTime(analysis);
  std::vector<std::size_t> equalTime, equalError;
  for (const Line& line : analysis.lines) {
    equalTime.push_back(Nearest(analysis, line, time, &CostPoint::seconds));
    if (analysis.target)
      equalError.push_back(Nearest(analysis, line, *analysis.target, &CostPoint::error));
  }
  Html scale, equalErrorPart;
  if (analysis.hasReference) scale = Fill("error-scale", {{"error", ShortNumber(kErrorScale)}});
  if (analysis.target)
    equalErrorPart = Fill("equal-error", {{"error", ShortNumber(*analysis.target)},
                                          {"figures", gallery.Figures(equalError)}});
  return Fill("picture-section", {{"scale", scale},
                                  {"time", SecondsText(time)},
                                  {"figures", gallery.Figures(equalTime)},
                                  {"equalError", equalErrorPart}});
}

Html MapSection(const std::string& folder, const Results& results) {
  Html maps;
  for (const MapRecord& map : results.maps)
    maps += MapFigure(ReadExr(PathOf(folder, map.image)), map);
  return maps.IsEmpty() ? Html() : Fill("map-section", {{"maps", maps}});
}

Html DataSection(const Results& results, const Analysis& analysis) {
  const std::string& reference = results.reference.command;
  return Fill("data-section",
              {{"processor", results.processor},
               {"cores", results.cores},
               {"system", results.system},
               {"program", results.program},
               {"fingerprint", results.fingerprint},
               {"threads", results.runs.empty() ? 0 : results.runs.front().threads},
               {"command", results.command},
               {"referenceCommand",
                reference.empty() ? Html() : Fill("reference-command", {{"command", reference}})},
               {"settingCommands", SettingCommands(results)},
               {"rows", SettingRows(results, analysis)}});
}

}  // namespace exphoton::study
