// SPDX-License-Identifier: BSD-2-Clause
// Measurement is the compact result of one scene: means of the picture in its quadrants, rays,
// counters, and a short hash of each text that the program writes about the render.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "tests/recorded/scene_list.h"

namespace exphoton::recorded {

struct Measurement {
  // By label. A channel of the picture ("R", "direct.R") has four numbers, the means over its
  // quadrants, from left to right and then down. "rays", "counters" and "cut" are the others.
  std::map<std::string, std::vector<double>> numbers;
  // By name: "explain", "messages", "output" (statistics and
  // attributes), "error". The first letters differ.
  std::map<std::string, std::string> texts;
};

// Renders the scene in this process. An error is a text of the result.
Measurement Measure(const RecordedScene& scene, int threads);

// Returns six hexadecimal digits.
std::string ShortHash(const std::string& text);

// Returns the lines of the texts with all numbers replaced by "#", for files that say which lines
// are known. Lines that differ from scene to scene by design are left out.
std::vector<std::string> LinesWithoutNumbers(const Measurement& measurement);

}  // namespace exphoton::recorded
