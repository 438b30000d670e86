// SPDX-License-Identifier: BSD-2-Clause
// What a study must know of a scene and of this program before it renders: sizes, hashes, and which
// integrator has which parameter.
#pragma once

#include <string>

#include "core/app/study/study_options.h"

namespace exphoton::cli {

struct SceneFacts {
  int width = 0, height = 0;            // of the part that is rendered
  std::string hash;                     // of everything that the scene's files say
  std::vector<std::string> inputFiles;  // that it reads
};
// Reads the scene. Throws Error.
SceneFacts ExamineScene(const std::string& path, const StudyOptions& options);

struct ProgramFacts {
  std::string version, fingerprint, processor, system;
  int cores = 0;
};
// The fingerprint is that of the program's file, its library and its plugins.
ProgramFacts ExamineProgram(const StudyOptions& options);

std::string HashOfText(const std::string& text);    // 16 hexadecimal digits
std::string ReadTextFile(const std::string& path);  // empty where it cannot be read

// The settings of the plan, checked: integrators exist, numbers of --setting too. Throws Error.
std::vector<study::Setting> PlanSettings(const StudyOptions& options);

// The arguments of `exphoton render` that render this scene with this setting and seed, without
// those that say where to.
std::vector<std::string> RenderArguments(const StudyOptions& options, const std::string& scene,
                                         const study::Setting& setting, std::uint64_t seed);
// "exphoton render ..." as a shell takes it.
std::string CommandText(const std::vector<std::string>& arguments);

}  // namespace exphoton::cli
