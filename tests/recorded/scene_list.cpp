// SPDX-License-Identifier: BSD-2-Clause
// The table of groups, and the scenes that are written by hand.
#include "tests/recorded/scene_list.h"

#include <fstream>
#include <functional>
#include <stdexcept>

namespace exphoton::recorded {
namespace {

struct Group {
  std::string name;
  std::function<std::vector<RecordedScene>()> scenes;
};

// The groups take about the same time, so that tests can run side by side.
const std::vector<Group>& Groups() {
  static const std::vector<Group> groups{
      {"random_1", [] { return RandomScenes(1, 80); }},
      {"random_2", [] { return RandomScenes(81, 160); }},
      {"random_3", [] { return RandomScenes(161, 240); }},
      {"random_4", [] { return RandomScenes(241, 320); }},
      {"integrators", [] { return ParameterScenes("integrator"); }},
      {"shapes", [] { return ParameterScenes("shape"); }},
      {"lights", [] { return ParameterScenes("light, area light, volume, volume integrator"); }},
      {"materials", [] { return ParameterScenes("material"); }},
      {"textures", [] { return ParameterScenes("float texture, color texture"); }},
      {"sampling", [] { return ParameterScenes("sampler, filter, camera, accelerator"); }},
      {"motion", [] { return MotionScenes(); }},
      {"combined_1",
       [] { return ParameterScenes("integrator, sampler, camera, volume, material", 5); }},
      {"combined_2",
       [] {
         return ParameterScenes(
             "shape, light, area light, volume integrator, float texture, color texture, filter, "
             "accelerator",
             5);
       }},
      {"state", [] { return StateScenes(1, 300); }},
      {"window", [] { return WindowScenes(1, 210); }},
      {"mixed_1", [] { return MixedScenes(1, 170); }},
      {"mixed_2", [] { return MixedScenes(171, 340); }},
      {"mixed_3", [] { return MixedScenes(341, 510); }},
      {"chosen", [] { return ChosenScenes(); }},
  };
  return groups;
}

}  // namespace

const std::vector<std::string>& GroupNames() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const Group& group : Groups()) list.push_back(group.name);
    return list;
  }();
  return names;
}

std::vector<RecordedScene> ScenesOf(const std::string& name) {
  for (const Group& group : Groups())
    if (group.name == name) return group.scenes();
  throw std::runtime_error("there is no group \"" + name + "\"");
}

void ReplaceLine(const std::string& directive, const std::string& line, std::string* text) {
  const std::size_t begin = text->find(directive + " ");
  if (begin == std::string::npos) throw std::runtime_error("no line begins with " + directive);
  text->replace(begin, text->find('\n', begin) - begin, line);
}

std::vector<std::string> LinesOf(const std::string& file) {
  std::ifstream stream(std::string(EXPHOTON_SOURCE_DIR) + "/tests/recorded/" + file);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);)
    if (!line.empty() && line[0] != '#') lines.push_back(line);
  return lines;
}

// A scene begins with a line "== NAME", or "== NAME with AOVS".
std::vector<RecordedScene> ChosenScenes() {
  std::vector<RecordedScene> scenes;
  for (const std::string& line : LinesOf("chosen_scenes.txt")) {
    if (!line.starts_with("== ")) {
      scenes.at(scenes.size() - 1).text += line + "\n";
      continue;
    }
    const std::size_t with = line.find(" with ");
    RecordedScene scene{"chosen/" + line.substr(3, with - 3), "", {}};
    std::string unknown;
    if (with != std::string::npos) scene.aovs = ParseAovs(line.substr(with + 6), &unknown).value();
    scenes.push_back(scene);
  }
  return scenes;
}

}  // namespace exphoton::recorded
