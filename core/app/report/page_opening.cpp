// SPDX-License-Identifier: BSD-2-Clause
// This file makes the first screen of the report: the sentence, the chart, and pictures at equal
// time. Then come facts on the measurement.
#include <algorithm>
#include <filesystem>

#include "core/app/analysis/headline/lower_bound.h"
#include "core/app/analysis/numbers.h"
#include "core/app/report/chart/cost_chart.h"
#include "core/app/report/gallery.h"
#include "core/app/report/page_sections.h"
#include "core/base/format.h"

namespace exphoton::study {
namespace {

constexpr std::size_t kPosters = 3;  // more than three would be narrower than 400 pixels

Html Fact(const Value& value, const std::string& meaning) {
  return Fill("fact", {{"value", value}, {"meaning", meaning}});
}

Html ReferenceFacts(const Results& results, const Analysis& analysis) {
  if (!analysis.hasReference)
    return Fact("No reference", "only the noise between seeds is known; bias is not included");
  const ReferenceRecord& r = results.reference;
  const Measured& noise = analysis.reference.variance;
  std::string what = r.integrator.empty() ? "a given picture" : r.integrator;
  if (r.samplesPerPixel > 0) what += ", " + CountText(r.samplesPerPixel) + " samples a pixel";
  const std::string time = r.seconds > 0 ? ", in " + SecondsText(r.seconds) : "";
  return Fact(what, "the reference" + time) +
         (noise.IsKnown()
              ? Fact(ShortNumber(noise.value),
                     "relMSE of the reference's own noise, from its two halves; taken off all "
                     "errors")
              : Fact("unknown", "noise of the reference: it was given as one picture"));
}

// Returns the file name with its parent folder. The report's commands show the full path.
std::string FileInFolder(const std::string& path) {
  const std::filesystem::path file(path);
  return (file.parent_path().filename() / file.filename()).string();
}

// Explains a reference that was rendered from another scene file.
Html ReferenceNote(const Results& results) {
  const ReferenceRecord& r = results.reference;
  if (r.scene.empty() || r.scene == results.scene || r.sceneHash == results.sceneHash) return {};
  return Fill("reference-note",
              {{"reference", FileInFolder(r.scene)}, {"scene", FileInFolder(results.scene)}});
}

Html WarningSection(const Results& results) {
  Html warnings;
  WarningSet known;
  for (const RunRow& row : results.runs)
    for (const std::string& text : known.Add(row.warnings))
      warnings += Fill("warning", {{"text", text}});
  return warnings.IsEmpty() ? Html() : Fill("warning-section", {{"warnings", warnings}});
}

Html CertificateFact(const Results& results) {
  const auto count = std::ranges::count_if(
      results.runs, [](const RunRow& row) { return !row.certificate.empty(); });
  if (count == 0) return {};
  return Fact("with certificates", "are " + std::to_string(count) +
                                       " of the renders: they estimated their own errors, and "
                                       "their times include this work");
}

Html Facts(const Results& results, const Analysis& analysis) {
  long long nonFinite = 0;
  for (const SettingResult& setting : analysis.settings) nonFinite += setting.nonFinite;
  Html facts = ReferenceFacts(results, analysis);
  facts += Fact(Counted(std::int64_t(results.runs.size()), "render"),
                Counted(std::int64_t(results.settings.size()), "setting") + " with " +
                    Counted(results.seeds, "independent seed") +
                    (results.settings.size() == 1 ? "" : " each"));
  facts += CertificateFact(results);
  for (const LowerBound& bound : results.lowerBounds)
    facts += Fact(
        SecondsText(bound.Seconds(results.clock)),
        "lower bound of " + results.settings[bound.setting].integrator + ": " + kLowerBoundMeaning);
  facts += nonFinite == 0 ? Fact("0 pixels", "are NaN or infinite, in all pictures together")
                          : Fact(Fill("alarm", {{"text", std::to_string(nonFinite) + " pixels"}}),
                                 "are NaN or infinite and were left out of all errors");
  return Fill("facts-section",
              {{"measure", analysis.hasReference
                               ? "relMSE is the mean over pixels and colours of (x − r)² / (r² + "
                                 "0.01);"
                               : "Noise is measured between seeds, relative to their mean;"},
               {"clock", results.clock == "wall" ? "seconds" : "CPU seconds"},
               {"note", ReferenceNote(results)},
               {"facts", facts}});
}

// Returns the lines whose pictures the first screen shows, one of each contender. Of many, these
// are the fastest two and the slowest that reaches the headline's error.
std::vector<std::size_t> LinesOfPosters(const Analysis& analysis) {
  std::vector<std::pair<double, std::size_t>> order;  // time to the error and line
  std::size_t reached = 0;
  for (const Contender& contender : analysis.contenders) {
    const bool isReached = contender.toTarget.kind != TimeToError::Kind::Never;
    order.emplace_back(isReached ? contender.toTarget.seconds.value : 1e300, contender.line);
    reached += isReached;
  }
  std::stable_sort(order.begin(), order.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  if (order.size() > kPosters) {
    order[kPosters - 1] = order[std::max(reached, kPosters) - 1];
    order.resize(kPosters);
  }
  std::vector<std::size_t> lines;
  for (const auto& [time, line] : order) lines.push_back(line);
  return lines;
}

Html Charts(const Results& results, const Analysis& analysis, bool isFull) {
  return CostChart(results, analysis, isFull ? kFullChart : kWideChart) +
         CostChart(results, analysis, kNarrowChart);
}

}  // namespace

Html Opening(const std::string& folder, const Results& results, const Analysis& analysis) {
  Html posters, beside, time;
  std::vector<Shot> shots;
  const double common = analysis.settings.empty() ? 0 : CommonTime(analysis);
  for (const std::size_t line : LinesOfPosters(analysis))
    shots.push_back(NearestInTime(analysis, line, common));
  const bool isBeside = analysis.hasReference && shots.size() >= kPosters;
  if (!shots.empty()) {
    const Gallery gallery(folder, results, analysis, shots);
    for (const Shot& shot : shots) {
      const double seconds = analysis.settings[shot.setting].cost.seconds.value;
      posters += gallery.Poster(shot, OffText(seconds / common, "time", "time"));
    }
    if (analysis.hasReference) (isBeside ? beside : posters) += gallery.ReferencePoster();
  }
  const std::string& bounds = analysis.lowerBounds;
  return Fill("opening", {{"headline", analysis.headline},
                          {"details", analysis.details + (bounds.empty() ? "" : " " + bounds)},
                          {"chart", Charts(results, analysis, !isBeside)},
                          {"beside", beside},
                          {"kind", isBeside ? "beside" : "alone"},
                          {"time", SecondsText(common)},
                          {"posters", posters}}) +
         WarningSection(results) + Facts(results, analysis);
}

}  // namespace exphoton::study
