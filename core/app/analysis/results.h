// SPDX-License-Identifier: BSD-2-Clause
// Results: the data of a study folder: what was planned, what each run took and where its picture
// is. results.json is the record, results.csv the same rows for spreadsheets.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "core/app/analysis/plan.h"
#include "core/imaging/metrics/metrics.h"

namespace exphoton::study {

using NamedValues = std::vector<std::pair<std::string, double>>;

// What one render says of itself, and what was measured from outside.
struct RunRow {
  std::string key;  // of everything that the run depends on: equal keys, equal runs
  std::size_t setting = 0;
  std::uint64_t seed = 0;
  int threads = 0;
  double wallSeconds = 0, cpuSeconds = 0;  // of the whole process
  double peakMemory = 0;                   // bytes
  double samplesPerPixel = 0;
  bool isComplete = true;  // false: stopped by time
  NamedValues phases;      // CPU seconds
  NamedValues phaseWall;   // wall seconds
  NamedValues rays, counters;
  std::string image, command;  // image: relative to the study's folder
  bool hasMetrics = false;     // there was a reference
  ImageDifference metrics;
  double flip = 0;

  double Counter(const std::string& name) const;  // 0 if absent
  double PhotonsStored() const;
  double PhotonPaths() const;
};

// Two independent halves of one reference; empty where there is none.
struct ReferenceRecord {
  std::string a, b;  // relative to the folder, or absolute; b empty: noise unknown
  std::string scene, sceneHash, integrator, command;
  double samplesPerPixel = 0;  // of both halves together
  double seconds = 0;          // CPU
};

// A picture that shows something else than light: cost, photon density ...
struct MapRecord {
  std::string image, channel, title, unit;
};

struct Results {
  std::string program, fingerprint;  // version; hash of the program's files
  std::string processor, system;
  int cores = 0;
  std::string title, scene, sceneHash, command;
  std::string clock = "cpu";  // the seconds of charts and ratios: cpu or wall
  int seeds = 0;
  std::vector<double> targets;               // errors of the price list
  std::vector<std::array<double, 4>> crops;  // x0 x1 y0 y1 in fractions, shown larger
  std::vector<Setting> settings;
  ReferenceRecord reference;
  std::vector<RunRow> runs;
  std::vector<MapRecord> maps;
};

// Where a file of the study is: names are relative to its folder, or absolute.
std::string PathOf(const std::string& folder, const std::string& name);

// JSON both ways. FromJson throws std::runtime_error that says what is wrong.
std::string ToJson(const Results& results);
Results FromJson(const std::string& text);
std::string ToCsv(const Results& results);
std::string CsvField(const std::string& text);  // quoted where it must be

// One row by itself, for the file beside its picture; without its setting and metrics, which depend
// on the study.
std::string RowToJson(const RunRow& row);
RunRow RowFromJson(const std::string& text);  // throws std::runtime_error

// Adds what --stats-json wrote (one line of JSON) to a row. Unknown members are left alone and
// missing ones stay 0. Throws std::runtime_error where it is no JSON object.
void AddRunStatistics(const std::string& json, RunRow* row);

}  // namespace exphoton::study
