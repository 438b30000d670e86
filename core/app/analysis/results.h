// SPDX-License-Identifier: BSD-2-Clause
// Results is the data of a study: its plan, and the measurements and picture of each run. A study
// folder stores it as results.json; results.csv holds the same rows for spreadsheets.
#pragma once

#include <array>
#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/app/analysis/budget_record.h"
#include "core/app/analysis/plan.h"
#include "core/app/analysis/predictions.h"
#include "core/imaging/metrics/metrics.h"

namespace exphoton::study {

using NamedValues = std::vector<std::pair<std::string, double>>;
double ValueOf(const NamedValues& values, const std::string& name, double missing = 0);

// RunRow is one render: the statistics that it reported and the measurements of its process.
struct RunRow {
  std::string key;  // hash of everything the run depends on
  std::size_t setting = 0;
  std::uint64_t seed = 0;
  int threads = 0;
  double wallSeconds = 0, cpuSeconds = 0;  // of the whole process
  double peakMemory = 0;                   // bytes
  double samplesPerPixel = 0;
  bool isComplete = true;  // false: the render was interrupted
  // Of a render in a task of its own (study --task): the machine, and whether the render was alone
  // there. Empty and false otherwise.
  std::string node, processor;
  bool isAlone = false;
  NamedValues phases;     // CPU seconds
  NamedValues phaseWall;  // wall seconds
  NamedValues rays, counters;
  // The numbers of --certify: roots of parts of relMSE, block widths in pixels, and
  // blockBiasSquared. An infinite number is missing. Empty: the render has no certificate.
  NamedValues certificate;
  std::string image, command;         // image: relative to the study's folder
  std::vector<std::string> warnings;  // of the render, each with its source line and hint
  bool hasMetrics = false;            // true if there is a reference
  ImageDifference metrics;
  double flip = 0;

  double Counter(const std::string& name) const;  // 0 if missing
  double PhotonsStored() const;
  double PhotonPaths() const;
  bool IsOfTask() const { return !node.empty(); }
};

// WarningSet finds the warnings of several renders that are new. Warnings that differ in numbers
// alone are the same.
class WarningSet {
 public:
  // Adds the warnings of a render, and returns those that no render before it had.
  std::vector<std::string> Add(const std::vector<std::string>& warnings);

 private:
  std::set<std::string> known_;
};

// Returns the measurements against the reference, with their names in result files.
NamedValues MetricValues(const RunRow& row);

// ReferenceRecord describes two independent halves of a reference. All names are empty if there is
// no reference.
struct ReferenceRecord {
  std::string a, b;  // relative to the folder, or absolute; b empty: noise unknown
  std::string scene, sceneHash, integrator, command;
  double samplesPerPixel = 0;  // sum of both halves
  double seconds = 0;          // CPU seconds
};

// MapRecord is a picture of a quantity other than radiance, such as cost or photon density.
struct MapRecord {
  std::string image, channel, title, unit;
};

// LowerBound is the smallest time of a picture that gathers light from the photon maps of a
// setting: the time of the maps, one camera sample and one gather ray a pixel.
struct LowerBound {
  std::size_t setting = 0;                 // index of Results::settings
  double cpuSeconds = 0, wallSeconds = 0;  // of the whole process; the smallest over the seeds
  std::string command;                     // with the first seed

  double Seconds(const std::string& clock) const {
    return clock == "wall" ? wallSeconds : cpuSeconds;
  }
};

struct Results {
  std::string program, fingerprint;  // version; hash of the program's files
  std::string processor, system;
  int cores = 0;
  std::string title, scene, sceneHash, command;
  std::string photonFile;     // photons were read from here; "": each render shot its own
  std::string clock = "cpu";  // clock of charts and ratios: cpu or wall
  int seeds = 0;
  std::vector<double> targets;               // errors in the price list
  std::vector<std::array<double, 4>> crops;  // x0 x1 y0 y1 as fractions, shown enlarged
  std::vector<Setting> settings;
  ReferenceRecord reference;
  std::vector<Prediction> predictions;  // of each integrator, if the user asked for them
  std::vector<BudgetRecord> budgets;    // of each photon integrator, if the user asked for them
  std::vector<LowerBound> lowerBounds;  // of each photon integrator with gather rays
  std::vector<RunRow> runs;
  std::vector<MapRecord> maps;
};

// Returns the path of a study's file, whose name is absolute or relative to the study's folder.
std::string PathOf(const std::string& folder, const std::string& name);

// Convert to and from JSON. FromJson throws std::runtime_error with an explanation.
std::string ToJson(const Results& results);
Results FromJson(const std::string& text);
std::string ToCsv(const Results& results);
std::string CsvField(const std::string& text);  // quoted if necessary

// Returns one row as text for the JSON file next to its picture. The setting and the metrics are
// left out, since they depend on the study.
std::string RowToJson(const RunRow& row);
RunRow RowFromJson(const std::string& text);  // throws std::runtime_error

// Adds the output of --stats-json (one line of JSON) to a row. Ignores unknown members; missing
// ones stay 0. Throws std::runtime_error if the text is not a JSON object.
void AddRunStatistics(const std::string& json, RunRow* row);

}  // namespace exphoton::study
