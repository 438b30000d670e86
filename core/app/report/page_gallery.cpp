// SPDX-License-Identifier: BSD-2-Clause
// This file makes the sections with pictures at equal time and equal error, and with maps.
#include "core/app/analysis/numbers.h"
#include "core/app/report/gallery.h"
#include "core/app/report/page_pictures.h"
#include "core/app/report/page_sections.h"
#include "core/imaging/files/exr.h"

namespace exphoton::study {
namespace {

constexpr double kTooFar = 10;  // a picture with an error this many times off is left out

// Returns the number of columns for which no picture is alone in the last row. Few columns make
// large pictures.
std::size_t ColumnsFor(std::size_t pictures) {
  for (const std::size_t columns : {3u, 4u, 2u, 5u})
    if (pictures >= columns && pictures % columns != 1) return columns;
  return 1;
}

Html Grid(const Html& figures, std::size_t count) {
  return Fill("pictures", {{"columns", ColumnsFor(count)}, {"figures", figures}});
}

Html EqualTime(const Gallery& gallery, const Analysis& analysis, const std::vector<Shot>& shots,
               double time) {
  Html figures = gallery.ReferenceComparison();
  for (const Shot& shot : shots) {
    const double seconds = analysis.settings[shot.setting].cost.seconds.value;
    figures += gallery.Comparison(shot, OffText(seconds / time, "time", "time"));
  }
  return Grid(figures, shots.size() + (analysis.hasReference ? 1 : 0));
}

Html EqualError(const Gallery& gallery, const Analysis& analysis, double target) {
  Html figures = gallery.ReferenceComparison();
  std::size_t count = analysis.hasReference ? 1 : 0;
  std::string missing;
  for (std::size_t i = 0; i < analysis.lines.size(); ++i) {
    const Shot shot = NearestInError(analysis, i, target);
    const double error = analysis.settings[shot.setting].cost.error.value;
    const bool isFar = !(error < kTooFar * target && error > target / kTooFar);
    if (isFar) {
      missing += (missing.empty() ? "" : ", ") + analysis.lines[i].label + " (closest " +
                 ShortNumber(error) + ")";
      continue;
    }
    figures += gallery.Comparison(shot, OffText(error / target, "error", "error"));
    ++count;
  }
  return Fill("equal-error",
              {{"error", ShortNumber(target)},
               {"grid", Grid(figures, count)},
               {"missing", missing.empty() ? Html() : Fill("left-out", {{"lines", missing}})}});
}

}  // namespace

Html PictureSection(const std::string& folder, const Results& results, const Analysis& analysis) {
  if (analysis.settings.empty()) return {};
  const double time = CommonTime(analysis);
  std::vector<Shot> shots;
  for (std::size_t i = 0; i < analysis.lines.size(); ++i)
    shots.push_back(NearestInTime(analysis, i, time));
  const Gallery gallery(folder, results, analysis, shots);
  return Fill(
      "picture-section",
      {{"legends", analysis.hasReference ? ErrorLegends() : Html()},
       {"time", SecondsText(time)},
       {"grid", EqualTime(gallery, analysis, shots, time)},
       {"equalError", analysis.target ? EqualError(gallery, analysis, *analysis.target) : Html()}});
}

Html MapSection(const std::string& folder, const Results& results) {
  Html maps;
  std::size_t count = 0;
  for (const MapRecord& map : results.maps) {
    const Html figure = MapFigure(ReadExr(PathOf(folder, map.image)), map);
    count += !figure.IsEmpty();
    maps += figure;
  }
  return maps.IsEmpty() ? Html() : Fill("map-section", {{"maps", Grid(maps, count)}});
}

}  // namespace exphoton::study
