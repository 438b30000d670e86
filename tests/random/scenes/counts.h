// SPDX-License-Identifier: BSD-2-Clause
// SoakCounts adds up the scenes of several runs of the soak, so that a long run can be made in
// parts. It is kept as a text file with a line for each property: its name, the scenes and the
// failures. The first line is "next" and the first seed that was not checked.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "tests/random/scenes/run.h"

namespace exphoton::random_scenes {

struct SoakCounts {
  std::uint64_t next = 0;
  std::map<std::string, Tally> tallies;
};

// Throws std::runtime_error if the text is not of this form.
SoakCounts ParseCounts(const std::string& text);
std::string CountsText(const SoakCounts& counts);
// Returns the counts with those of a run added.
SoakCounts Sum(SoakCounts counts, const std::map<std::string, Tally>& run);

// Returns a line for each property: "energy: 200 scenes, 0 failures; rate at most 1.5 % (95 %)".
std::string TalliesText(const std::map<std::string, Tally>& tallies);

}  // namespace exphoton::random_scenes
