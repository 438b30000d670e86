// SPDX-License-Identifier: BSD-2-Clause
// FinishedRuns finds renders that exist already, in the study's folder or in the folders of its
// tasks. A finished run consists of a picture and a row (images/NAME.exr, NAME.json) with a key: a
// hash of everything that the run depends on.
#pragma once

#include <set>

#include "core/app/analysis/results.h"
#include "core/app/study/study_options.h"
#include "core/app/study/study_scene.h"

namespace exphoton::cli {

struct StudyRun {
  std::size_t setting;
  std::uint64_t seed;
};

// Returns all runs of a study, seed by seed, so that an interrupted study has about equally many
// runs of each setting.
std::vector<StudyRun> RunsOfStudy(std::size_t settings, int seeds);

// Returns images/NAME, without an ending.
std::string RunFileName(const study::Setting& setting, std::uint64_t seed);

class FinishedRuns {
 public:
  FinishedRuns(const StudyOptions& options, SceneFacts scene, ProgramFacts program)
      : options_(options), scene_(std::move(scene)), program_(std::move(program)) {}

  const std::string& Processor() const { return program_.processor; }
  // `arguments` are those of `exphoton render`.
  std::string Key(const std::vector<std::string>& arguments, const std::string& processor) const;
  // Returns false if the folder has no such run or its files cannot be read.
  bool Find(const std::string& folder, const std::string& name,
            const std::vector<std::string>& arguments, study::RunRow* row) const;
  // Returns the folder of the task that has the run, or "".
  std::string FindInTasks(const std::string& name, const std::vector<std::string>& arguments,
                          study::RunRow* row) const;
  // Returns the tasks, of `count`, whose renders are not all in the folders of tasks.
  std::set<int> MissingTasks(const std::vector<study::Setting>& settings, int count) const;

 private:
  const StudyOptions& options_;
  SceneFacts scene_;
  ProgramFacts program_;
};

}  // namespace exphoton::cli
