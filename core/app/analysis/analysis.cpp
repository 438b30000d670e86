// SPDX-License-Identifier: BSD-2-Clause
// Analyse turns the rows and pictures of a study into points, lines and a headline (headline.cpp).
#include "core/app/analysis/analysis.h"

#include <algorithm>
#include <filesystem>
#include <numeric>

#include "core/app/analysis/certificate_checks.h"
#include "core/app/analysis/headline/headline.h"
#include "core/imaging/files/exr.h"
#include "core/imaging/metrics/flip.h"

namespace exphoton::study {
namespace {

namespace fs = std::filesystem;

Reference ReadReference(const std::string& folder, const ReferenceRecord& record) {
  Image a = ReadImage(PathOf(folder, record.a));
  return record.b.empty() ? MakeReference(std::move(a))
                          : MakeReference(a, ReadImage(PathOf(folder, record.b)));
}

// Without a reference, uses the mean of the pictures, so that their noise can still be measured.
Reference MeanPicture(const std::vector<Image>& pictures) {
  Image mean(pictures.front().data, pictures.front().display, {"R", "G", "B"});
  std::vector<double> sums(mean.pixels.size());
  for (const Image& picture : pictures) {
    const auto from = FindColors(picture, "the picture");
    std::size_t i = 0;
    for (int y = 0; y < picture.Height(); ++y)
      for (int x = 0; x < picture.Width(); ++x)
        for (const int channel : from) sums[i++] += double(picture.At(x, y, channel));
  }
  for (std::size_t i = 0; i < sums.size(); ++i)
    mean.pixels[i] = float(sums[i] / double(pictures.size()));
  return MakeReference(std::move(mean));
}

template <class Get>
Measured MeanOfRuns(const Results& results, const std::vector<std::size_t>& runs, Get&& get) {
  std::vector<double> values;
  for (const std::size_t run : runs) values.push_back(get(results.runs[run]));
  return MeanOf(values);
}

// Returns the mean seconds of every phase. "other" is the rest of the process's time.
NamedValues MeanPhases(const Results& results, const SettingResult& setting) {
  NamedValues phases;
  const bool isWall = results.clock == "wall";
  double rest = setting.cost.seconds.value;
  for (const std::size_t run : setting.runs) {
    const RunRow& row = results.runs[run];
    for (const auto& [name, seconds] : isWall ? row.phaseWall : row.phases) {
      const double share = seconds / double(setting.runs.size());
      rest -= share;
      const auto found = std::find_if(phases.begin(), phases.end(),
                                      [&name = name](const auto& p) { return p.first == name; });
      if (found == phases.end())
        phases.emplace_back(name, share);
      else
        found->second += share;
    }
  }
  phases.emplace_back("other", std::max(0., rest));
  return phases;
}

void TakeMetrics(const Results& results, SettingResult* result) {
  const auto mean = [&](auto&& get) { return MeanOfRuns(results, result->runs, get).value; };
  result->mse = mean([](const RunRow& r) { return r.metrics.mse; });
  result->trimmed = mean([](const RunRow& r) { return r.metrics.trimmedRelMse; });
  result->meanError = mean([](const RunRow& r) { return r.metrics.meanError; });
  result->relativeMean = mean([](const RunRow& r) { return r.metrics.relativeMeanError; });
  result->p99 = mean([](const RunRow& r) { return r.metrics.p99; });
  result->flip = mean([](const RunRow& r) { return r.flip; });
  result->samplesPerPixel = mean([](const RunRow& r) { return r.samplesPerPixel; });
  result->peakMemory = mean([](const RunRow& r) { return r.peakMemory; });
  result->photonsStored = mean([](const RunRow& r) { return r.PhotonsStored(); });
  result->photonPaths = mean([](const RunRow& r) { return r.PhotonPaths(); });
}

// Returns the squared bias of blocks for each width that a certificate of the runs has.
std::map<int, Measured> BlockBiases(const Results& results, const std::vector<std::size_t>& runs,
                                    const std::vector<Image>& pictures,
                                    const Reference& reference) {
  std::map<int, Measured> biases;
  for (const std::size_t run : runs) {
    const int width = BlockWidth(results.runs[run]);
    if (width > 0 && !biases.contains(width))
      biases[width] = SeparateBlocks(pictures, reference, width);
  }
  return biases;
}

SettingResult MeasureSetting(const std::string& folder, const Results& results, std::size_t setting,
                             const Analysis& analysis) {
  SettingResult result;
  result.setting = setting;
  std::vector<Image> pictures;
  for (std::size_t i = 0; i < results.runs.size(); ++i) {
    if (results.runs[i].setting != setting) continue;
    result.runs.push_back(i);
    pictures.push_back(ReadExr(PathOf(folder, results.runs[i].image)));
  }
  if (pictures.empty()) return result;
  result.cpu = MeanOfRuns(results, result.runs, [](const RunRow& r) { return r.cpuSeconds; });
  result.wall = MeanOfRuns(results, result.runs, [](const RunRow& r) { return r.wallSeconds; });
  result.cost.seconds = results.clock == "wall" ? result.wall : result.cpu;
  result.separation =
      Separate(pictures, analysis.hasReference ? analysis.reference : MeanPicture(pictures));
  result.cost.error = analysis.hasReference ? result.separation.error : result.separation.variance;
  if (!analysis.hasReference) result.separation.bias2 = {};
  if (analysis.hasReference)
    result.blockBias = BlockBiases(results, result.runs, pictures, analysis.reference);
  for (const Image& picture : pictures)
    result.nonFinite += CompareImages(picture, picture).nonFinitePixels;
  TakeMetrics(results, &result);
  result.phases = MeanPhases(results, result);
  return result;
}

std::vector<Line> MakeLines(const Results& results, const std::vector<SettingResult>& settings) {
  std::vector<Line> lines;
  for (std::size_t i = 0; i < settings.size(); ++i) {
    const std::string& label = results.settings[settings[i].setting].label;
    auto found = std::find_if(lines.begin(), lines.end(),
                              [&](const Line& line) { return line.label == label; });
    if (found == lines.end())
      found = lines.insert(lines.end(),
                           Line{label, {}, {}, results.settings[settings[i].setting].integrator});
    found->settings.push_back(i);
  }
  return lines;
}

}  // namespace

std::vector<CostPoint> Analysis::Points(const std::vector<std::size_t>& indices) const {
  std::vector<CostPoint> points;
  for (const std::size_t i : indices) points.push_back(settings[i].cost);
  return points;
}

std::vector<std::size_t> Analysis::Front(const std::vector<std::size_t>& indices) const {
  std::vector<std::size_t> front;
  for (const std::size_t i : ParetoFront(Points(indices)))
    if (settings[indices[i]].cost.error.value <= usefulError) front.push_back(indices[i]);
  return front;
}

std::vector<std::size_t> Analysis::Front() const {
  std::vector<std::size_t> all(settings.size());
  std::iota(all.begin(), all.end(), std::size_t(0));
  return Front(all);
}

void MeasureRuns(const std::string& folder, Results* results) {
  if (results->reference.a.empty()) return;
  const Reference reference = ReadReference(folder, results->reference);
  for (RunRow& row : results->runs) {
    const Image picture = ReadExr(PathOf(folder, row.image));
    row.metrics = CompareImages(reference.mean, picture);
    row.flip = FlipError(reference.mean, picture);
    row.hasMetrics = true;
  }
}

Analysis Analyse(const std::string& folder, const Results& results) {
  Analysis analysis;
  analysis.hasReference = !results.reference.a.empty();
  if (analysis.hasReference) analysis.reference = ReadReference(folder, results.reference);
  for (std::size_t i = 0; i < results.settings.size(); ++i) {
    SettingResult setting = MeasureSetting(folder, results, i, analysis);
    if (!setting.runs.empty()) analysis.settings.push_back(std::move(setting));
  }
  analysis.lines = MakeLines(results, analysis.settings);
  constexpr double kUsefulShare = .5;
  if (analysis.hasReference) analysis.usefulError = kUsefulShare * BlackError(analysis.reference);
  WriteHeadline(results, &analysis);
  return analysis;
}

}  // namespace exphoton::study
