// SPDX-License-Identifier: BSD-2-Clause
// Analysis holds the error and time of each setting of a study, and a headline that sums them up.
#pragma once

#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/app/analysis/curves.h"
#include "core/app/analysis/results.h"
#include "core/app/analysis/separation.h"

namespace exphoton::study {

// SettingResult summarises all runs of one setting.
struct SettingResult {
  std::size_t setting = 0;
  std::vector<std::size_t> runs;  // indices of Results::runs
  Separation separation;
  CostPoint cost;  // seconds by the study's clock; error: see Analysis::hasReference
  Measured cpu, wall;
  // Means over the runs.
  double mse = 0, trimmed = 0, meanError = 0, relativeMean = 0, p99 = 0, flip = 0;
  long long nonFinite = 0;  // pixels, summed over the runs
  double samplesPerPixel = 0, peakMemory = 0, photonsStored = 0, photonPaths = 0;
  // The squared bias of blocks, by the widths of blocks that the certificates of the runs have.
  // Empty without a reference.
  std::map<int, Measured> blockBias;
  NamedValues phases;  // mean seconds by the study's clock; "other": the rest
  double Efficiency() const { return 1 / (cost.error.value * cpu.value); }
};

// Settings with the same label form one line of the charts.
struct Line {
  std::string label;
  std::vector<std::size_t> settings;  // indices of Analysis::settings
  TimeToError toTarget;               // time to the headline's error
  std::string integrator;
};

// Contender is an integrator in the headline. An integrator may have several lines. The headline
// then compares the line that has the integrator's name, and the other lines are its variants. If
// all lines are of one integrator, each line is a contender.
struct Contender {
  std::string name;
  std::size_t line = 0;               // index of Analysis::lines
  std::vector<std::size_t> settings;  // indices of Analysis::settings
  std::vector<std::size_t> variants;  // indices of Analysis::lines
  TimeToError toTarget;
};

struct Analysis {
  bool hasReference = false;  // false: errors are the noise between seeds only
  Reference reference;
  std::vector<SettingResult> settings;
  std::vector<Line> lines;
  std::vector<Contender> contenders;
  // Only pictures with at most this error are useful: half the error of a black picture.
  double usefulError = std::numeric_limits<double>::infinity();
  // The headline's error; empty if no two contenders can be compared.
  std::optional<double> target;
  // True if the reference is too noisy to compare any error.
  bool targetIsTooFine = false;
  std::string headline;  // one sentence
  std::string details;   // the error of the headline, with the times and their ratios
  // The ratios of times to their lower bounds, in one sentence; empty if no bound was measured.
  std::string lowerBounds;

  std::vector<CostPoint> Points(const std::vector<std::size_t>& indices) const;
  // Returns the Pareto front of these settings, without pictures that are not useful, in order of
  // increasing seconds. The result holds indices of `settings`.
  std::vector<std::size_t> Front(const std::vector<std::size_t>& indices) const;
  std::vector<std::size_t> Front() const;  // of all settings
};

// Reads and analyses all pictures of the study in `folder`. Throws ImageError.
Analysis Analyse(const std::string& folder, const Results& results);

// Fills `metrics` and `flip` of every row if there is a reference.
void MeasureRuns(const std::string& folder, Results* results);

}  // namespace exphoton::study
