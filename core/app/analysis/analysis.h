// SPDX-License-Identifier: BSD-2-Clause
// Analysis holds the error and time of each setting of a study, and a headline that sums them up.
#pragma once

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
  NamedValues phases;  // mean seconds by the study's clock; "other": the rest
  double Efficiency() const { return 1 / (cost.error.value * cpu.value); }
};

// Settings with the same label form one line of the charts.
struct Line {
  std::string label;
  std::vector<std::size_t> settings;  // indices of Analysis::settings
  TimeToError toTarget;               // time to the headline's error
};

struct Analysis {
  bool hasReference = false;  // false: errors are the noise between seeds only
  Reference reference;
  std::vector<SettingResult> settings;
  std::vector<Line> lines;
  // The headline's error; empty if no two lines can be compared.
  std::optional<double> target;
  // True if the reference is too noisy to compare any error.
  bool targetIsTooFine = false;
  std::string headline;  // one or a few sentences

  std::vector<CostPoint> Points(const Line& line) const;
  std::vector<CostPoint> Points() const;  // of all settings
};

// Reads and analyses all pictures of the study in `folder`. Throws ImageError.
Analysis Analyse(const std::string& folder, const Results& results);

// Fills `metrics` and `flip` of every row if there is a reference.
void MeasureRuns(const std::string& folder, Results* results);

// Format numbers for people: "9.8 s", "1.3 min"; "0.012".
std::string SecondsText(double seconds);
std::string ShortNumber(double value, int digits = 2);

// Returns round errors in descending order: 1, 0.5, 0.3, 0.2, 0.1 and so on.
std::vector<double> RoundErrors();

}  // namespace exphoton::study
