// SPDX-License-Identifier: BSD-2-Clause
// Analysis: what the pictures and times of a study say, setting by setting, and its headline.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/app/analysis/curves.h"
#include "core/app/analysis/results.h"
#include "core/app/analysis/separation.h"

namespace exphoton::study {

// The runs of one setting together.
struct SettingResult {
  std::size_t setting = 0;
  std::vector<std::size_t> runs;  // indices of rows
  Separation separation;
  CostPoint cost;  // seconds by the study's clock; error: see Analysis::hasReference
  Measured cpu, wall;
  double mse = 0, trimmed = 0, meanError = 0, relativeMean = 0, p99 = 0, flip = 0;  // means of runs
  long long nonFinite = 0;  // pixels, of all runs
  double samplesPerPixel = 0, peakMemory = 0, photonsStored = 0, photonPaths = 0;
  NamedValues phases;  // mean seconds by the study's clock; "other": the rest of the process
  double Efficiency() const { return 1 / (cost.error.value * cpu.value); }
};

// Settings with one label: one line of the charts.
struct Line {
  std::string label;
  std::vector<std::size_t> settings;  // indices of Analysis::settings
  TimeToError toTarget;               // of the headline's error
};

struct Analysis {
  bool hasReference = false;  // false: errors are the noise between seeds alone
  Reference reference;
  std::vector<SettingResult> settings;
  std::vector<Line> lines;
  std::optional<double> target;  // error of the headline; none where no two lines can be compared
  bool targetIsTooFine = false;  // the reference's noise does not allow any error to be compared
  std::string headline;          // one sentence or a few

  std::vector<CostPoint> Points(const Line& line) const;
  std::vector<CostPoint> Points() const;  // of all settings
};

// Reads all pictures of the study in `folder`. Throws ImageError.
Analysis Analyse(const std::string& folder, const Results& results);

// Fills metrics and flip of every row, if there is a reference.
void MeasureRuns(const std::string& folder, Results* results);

// "9.8 s", "1.3 min"; "0.012"
std::string SecondsText(double seconds);
std::string ShortNumber(double value, int digits = 2);

// The greatest of 1, 0.5, 0.3, 0.2, 0.1 ... : an error that is pleasant to name.
std::vector<double> RoundErrors();

}  // namespace exphoton::study
