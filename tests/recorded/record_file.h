// SPDX-License-Identifier: BSD-2-Clause
// RecordFile reads, writes and compares the files in tests/recorded/records. A scene is some lines:
//   random/17
//    R .12 .13 .11 .09         the quadrants of a channel; one number if they are equal
//    rays 192 40 0 0 0 0
//    texts e1a2b3c o0c1d2e     hashes, each after the first letter of its name
#pragma once

#include <map>
#include <string>
#include <vector>

#include "tests/recorded/measurement.h"

namespace exphoton::recorded {

struct Record {
  std::map<std::string, std::vector<double>> numbers;
  std::map<std::string, std::string> texts;  // short hashes, by the first letter of the name
};
using Records = std::map<std::string, Record>;  // by scene

std::string RecordPath(const std::string& group);
// Returns no records if there is no file.
Records ReadRecords(const std::string& group);

// Returns the lines of a scene.
std::string RecordText(const std::string& scene, const Measurement& measurement);

// Returns what differs, a sentence each: "picture R, upper left: .35 was recorded, .36 is measured
// (+2.9 %)".
std::vector<std::string> Differences(const Record& record, const Measurement& measurement);

}  // namespace exphoton::recorded
