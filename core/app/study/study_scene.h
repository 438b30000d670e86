// SPDX-License-Identifier: BSD-2-Clause
// SceneFacts and ProgramFacts hold the sizes and hashes that a study needs before rendering.
// PlanSettings checks the settings, and the one of the reference, against the parameters of each
// integrator.
#pragma once

#include <map>
#include <set>
#include <string>

#include "core/app/study/study_options.h"

namespace exphoton::cli {

struct SceneFacts {
  int width = 0, height = 0;            // of the rendered part
  std::string hash;                     // of the directives and all input files
  std::vector<std::string> inputFiles;  // files that the scene reads
  std::vector<std::string> sets;        // StudyOptions::sceneSets
};
// Loads the scene. Throws Error.
SceneFacts ExamineScene(const std::string& path, const StudyOptions& options);

struct ProgramFacts {
  std::string version, fingerprint, processor, system;
  int cores = 0;
};
// The fingerprint is a hash of the program, its library and its plugins.
ProgramFacts ExamineProgram(const StudyOptions& options);

std::string HashOfText(const std::string& text);    // 16 hexadecimal digits
std::string ReadTextFile(const std::string& path);  // empty if the file cannot be read

// Expands the plan. Throws Error for an unknown integrator or parameter.
std::vector<study::Setting> PlanSettings(const StudyOptions& options);

// Returns for each integrator, also of the reference, the --set options that apply only to others.
// Throws Error if one of them applies to none.
std::map<std::string, std::set<std::string>> FindForeignSets(
    const StudyOptions& options, const std::vector<study::Setting>& settings);

// Returns those integrators of the settings that can read photons from a file. Throws Error if
// there are none.
std::set<std::string> FindPhotonIntegrators(const StudyOptions& options,
                                            const std::vector<study::Setting>& settings);

// Returns whether the renders of a setting have certificates. With --certify, these are the renders
// of photon integrators with final gather, except progressive passes.
bool HasCertificate(const StudyOptions& options, const study::Setting& setting);
// Throws Error if the study asks for certificates and no setting has one.
void RequireCertificates(const StudyOptions& options, const std::vector<study::Setting>& settings);

// Returns the arguments of `exphoton render` for a scene, setting and seed, without output options.
// The word "passes" of a setting is the number of progressive passes.
std::vector<std::string> RenderArguments(const StudyOptions& options, const std::string& scene,
                                         const study::Setting& setting, std::uint64_t seed);
// Returns the arguments for one run of the study. They name the file of its photons, if there is
// one, and ask for a certificate, if the run has one.
std::vector<std::string> RunArguments(const StudyOptions& options, const study::Setting& setting,
                                      std::uint64_t seed);
// Loads the scene with each setting. Throws Error for a wrong value, before hours of rendering.
void CheckSettings(const StudyOptions& options, const std::vector<study::Setting>& settings);
// Returns "exphoton render ..." quoted for a shell.
std::string CommandText(const std::vector<std::string>& arguments);

}  // namespace exphoton::cli
