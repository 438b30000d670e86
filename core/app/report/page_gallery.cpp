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

  std::string Figures(const std::vector<std::size_t>& settings) const {
    std::string text = "<div class=\"pictures\">";
    if (analysis_.hasReference) {
      text += "<figure>" + PictureElement(reference_, scale_, "reference", false);
      for (const auto& crop : crops_)
        text += PictureElement(CropOf(reference_, crop), scale_, "part of the reference", true);
      text += "<figcaption><b>reference</b><small>" + Escape(results_.reference.integrator) +
              "</small></figcaption></figure>";
    }
    for (std::size_t line = 0; line < settings.size(); ++line) text += Figure(line, settings[line]);
    return text + "</div>\n";
  }

 private:
  Image Read(std::size_t setting) const {
    const std::size_t run = analysis_.settings[setting].runs.front();
    return ReadExr(PathOf(folder_, results_.runs[run].image));
  }

  std::string Figure(std::size_t line, std::size_t setting) const {
    const SettingResult& result = analysis_.settings[setting];
    const std::string& label = analysis_.lines[line].label;
    const Image image = Read(setting);
    std::string text = "<figure>" + PictureElement(image, scale_, label, false);
    for (const auto& crop : crops_)
      text += PictureElement(CropOf(image, crop), scale_, "part of " + label, true);
    if (analysis_.hasReference)
      text += PictureElement(SignedErrorImage(reference_, image, kErrorScale), 1,
                             "signed error of " + label, true);
    return text + "<figcaption>" + ColorDot(line) + "<b>" + Escape(label) + "</b><small>" +
           Escape(results_.settings[result.setting].Text()) + "</small>" +
           SecondsText(result.cost.seconds.value) + ", error " +
           ShortNumber(result.cost.error.value) + "</figcaption></figure>";
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

std::string EverySetting(const Results& results, const Analysis& analysis) {
  std::string rows;
  const auto cell = [](const std::string& text) { return "<td>" + text + "</td>"; };
  for (std::size_t i = 0; i < analysis.lines.size(); ++i) {
    for (const std::size_t index : analysis.lines[i].settings) {
      const SettingResult& s = analysis.settings[index];
      rows += "<tr><td>" + ColorDot(i) + Escape(analysis.lines[i].label) + "<br><small>" +
              Escape(results.settings[s.setting].Text()) + "</small></td>";
      rows += cell(MeasuredText(s.cpu)) + cell(MeasuredText(s.wall)) +
              cell(MeasuredText(s.separation.relMse)) + cell(ShortNumber(s.trimmed)) +
              cell(MeasuredText(s.separation.variance)) + cell(MeasuredText(s.separation.bias2)) +
              cell(ShortNumber(s.mse)) +
              cell((s.relativeMean > 0 ? "+" : "") + ShortNumber(100 * s.relativeMean) + " %") +
              cell(ShortNumber(s.p99)) + cell(ShortNumber(s.flip)) +
              cell(std::to_string(s.nonFinite)) + cell(ShortNumber(s.Efficiency())) +
              cell(ShortNumber(s.samplesPerPixel, 6)) + cell(CountText(s.photonPaths)) +
              cell(CountText(s.photonsStored)) + cell(ShortNumber(s.peakMemory / (1 << 20), 3)) +
              "</tr>\n";
    }
  }
  return Table(
      "<th>setting</th><th>CPU s</th><th>wall s</th><th>relMSE</th><th>trimmed</th><th>noise</th>"
      "<th>bias²</th><th>MSE</th><th>mean error</th><th>p99</th><th>FLIP</th><th>NaN/Inf</th>"
      "<th>efficiency</th><th>spp</th><th>paths shot</th><th>photons</th><th>MiB</th>",
      rows);
}

std::string Commands(const Results& results) {
  std::string text = Escape(results.command) + "\n";
  if (!results.reference.command.empty())
    text +=
        "\n# the reference: the mean of renders like this, two halves with seeds of their own\n" +
        Escape(results.reference.command) + "\n";
  text += "\n# each setting, here with its first seed\n";
  std::set<std::size_t> seen;
  for (const RunRow& row : results.runs)
    if (seen.insert(row.setting).second) text += Escape(row.command) + "\n";
  return "<pre>" + text + "</pre>\n";
}

}  // namespace

std::string PictureSection(const std::string& folder, const Results& results,
                           const Analysis& analysis) {
  if (analysis.settings.empty()) return "";
  const Gallery gallery(folder, results, analysis);
  const double time = CommonTime(analysis);
  std::vector<std::size_t> equalTime, equalError;
  for (const Line& line : analysis.lines) {
    equalTime.push_back(Nearest(analysis, line, time, &CostPoint::seconds));
    if (analysis.target)
      equalError.push_back(Nearest(analysis, line, *analysis.target, &CostPoint::error));
  }
  std::string text =
      "<p>From top to bottom: the picture, a part of it enlarged" +
      std::string(analysis.hasReference
                      ? ", and the signed error: red too bright, blue too dark, full colour at a "
                        "relative error of " +
                            ShortNumber(kErrorScale)
                      : "") +
      ". Each line shows its setting nearest to the time or error named, with its first seed.</p>\n"
      "<h3>Equal time: about " +
      SecondsText(time) + "</h3>\n" + gallery.Figures(equalTime);
  if (analysis.target)
    text += "<h3>Equal error: about " + ShortNumber(*analysis.target) + "</h3>\n" +
            gallery.Figures(equalError);
  return SectionOf("At equal time, at equal error", text);
}

std::string MapSection(const std::string& folder, const Results& results) {
  std::string maps;
  for (const MapRecord& map : results.maps) {
    const std::string element =
        MapElement(ReadExr(PathOf(folder, map.image)), map.channel, map.unit);
    if (!element.empty())
      maps += "<figure>" + element + "<figcaption>" + Escape(map.title) + "</figcaption></figure>";
  }
  if (maps.empty()) return "";
  return SectionOf("Where the work goes",
                   "<p>Scales are logarithmic; grey where there is nothing.</p><div "
                   "class=\"maps\">" +
                       maps + "</div>\n");
}

std::string DataSection(const Results& results, const Analysis& analysis) {
  const int threads = results.runs.empty() ? 0 : results.runs.front().threads;
  const std::string machine = Escape(results.processor) + ", " + std::to_string(results.cores) +
                              " cores, " + Escape(results.system) + "; " + Escape(results.program) +
                              " (build " + Escape(results.fingerprint) + "), " +
                              std::to_string(threads) + " threads a render";
  return SectionOf("Machine, commands, data",
                   "<p>" + machine + "</p>\n<details><summary>Commands</summary>" +
                       Commands(results) + "</details>\n<details><summary>Every setting</summary>" +
                       "<p>Efficiency is 1 / (error × CPU seconds). Rows of every render are in "
                       "results.csv and results.json, pictures in images/.</p>" +
                       EverySetting(results, analysis) + "</details>\n");
}

}  // namespace exphoton::study
