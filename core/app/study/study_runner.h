// SPDX-License-Identifier: BSD-2-Clause
// StudyRunner: renders of a study, each in a process of its own, so that none disturbs another. A
// picture and its row (images/NAME.exr, NAME.json) stand for a run that is done, under a name made
// from all that it depends on; such a run is not repeated.
#pragma once

#include "core/app/analysis/results.h"
#include "core/app/study/study_folder.h"
#include "core/app/study/study_options.h"
#include "core/app/study/study_scene.h"

namespace exphoton::cli {

// Thrown where the user stopped the study; everything that is done stays.
struct StudyInterrupted {};

// What one process did.
struct RenderedPicture {
  study::RunRow row;  // image and key empty
  std::string path;   // of the picture; the caller moves it
};

class StudyRunner {
 public:
  StudyRunner(const StudyOptions& options, StudyFolder& folder, SceneFacts scene,
              ProgramFacts program)
      : options_(options),
        folder_(folder),
        scene_(std::move(scene)),
        program_(std::move(program)) {}

  StudyFolder& Folder() { return folder_; }

  // All runs of all settings, seed by seed, so that an interrupted study is balanced.
  std::vector<study::RunRow> RunAll(const std::vector<study::Setting>& settings);

  // One run, done or found; its row's setting is 0.
  study::RunRow RunOne(const study::Setting& setting, std::uint64_t seed,
                       const std::vector<std::string>& extra = {});

  // Renders without looking for what is done. Throws StudyInterrupted, or Error with what the
  // process said.
  RenderedPicture Render(const std::vector<std::string>& arguments);

 private:
  struct Run {
    std::size_t setting;
    std::uint64_t seed;
  };
  std::string KeyOf(const std::vector<std::string>& arguments) const;
  // False where there is no such run, or its picture cannot be read.
  bool FindDone(const std::string& name, const std::string& key, study::RunRow* row) const;
  std::string NameOf(const study::Setting& setting, std::uint64_t seed,
                     const std::string& key) const;

  const StudyOptions& options_;
  StudyFolder& folder_;
  SceneFacts scene_;
  ProgramFacts program_;
  bool wasFound_ = false;  // the last run was not rendered
};

// The reference that the options ask for, rendered or named; empty where none is asked for.
study::ReferenceRecord PrepareReference(const StudyOptions& options, StudyRunner& runner);

void Say(const StudyOptions& options, const std::string& text);  // unless quiet

}  // namespace exphoton::cli
