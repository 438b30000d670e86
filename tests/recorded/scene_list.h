// SPDX-License-Identifier: BSD-2-Clause
// SceneList names the tiny scenes whose results are recorded. Their sources are the
// generator of random scenes, the parameter tables of the plugins, all combinations of motions with
// what can move, random directives, random film windows, and chosen_scenes.txt. A group of scenes
// has one file of records and is one test.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/imaging/film/aovs.h"

namespace exphoton::recorded {

inline constexpr int kWidth = 12, kHeight = 8;  // pixels
inline constexpr std::uint64_t kSeed = 7;       // of the renders

struct RecordedScene {
  std::string name;  // "random/17", "sphere.radius=.6" or the name in chosen_scenes.txt
  std::string text;  // paths are relative to the folder of the sources
  AovSet aovs;
};

// The names of the groups, which are also those of the files in records/ without ".txt".
const std::vector<std::string>& GroupNames();

// Returns the scenes of a group, in the same order each time.
std::vector<RecordedScene> ScenesOf(const std::string& group);

// The sources.
std::vector<RecordedScene> RandomScenes(std::uint64_t firstSeed, std::uint64_t lastSeed);
// Of kinds of plugins, such as "camera, filter". With combinations above 0, each plugin has as
// many scenes with several parameters at once, and none with one alone.
std::vector<RecordedScene> ParameterScenes(const std::string& kinds, int combinations = 0);
std::vector<RecordedScene> MotionScenes();
std::vector<RecordedScene> StateScenes(std::uint64_t firstSeed, std::uint64_t lastSeed);
std::vector<RecordedScene> WindowScenes(std::uint64_t firstSeed, std::uint64_t lastSeed);
std::vector<RecordedScene> MixedScenes(std::uint64_t firstSeed, std::uint64_t lastSeed);
std::vector<RecordedScene> ChosenScenes();

// Returns make(seed) for each seed.
template <class Make>
std::vector<RecordedScene> OfSeeds(std::uint64_t first, std::uint64_t last, const Make& make) {
  std::vector<RecordedScene> scenes;
  for (std::uint64_t seed = first; seed <= last; ++seed) scenes.push_back(make(seed));
  return scenes;
}

// Replaces the line of a directive. Each directive of the text is one line.
void ReplaceLine(const std::string& directive, const std::string& line, std::string* text);

// Returns the lines of a file of tests/recorded that are neither empty nor comments.
std::vector<std::string> LinesOf(const std::string& file);

}  // namespace exphoton::recorded
