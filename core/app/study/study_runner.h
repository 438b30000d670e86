// SPDX-License-Identifier: BSD-2-Clause
// StudyRunner renders the runs of a study, each in a separate process for independent measurements.
// A finished run is not repeated.
#pragma once

#include "core/app/analysis/analysis.h"
#include "core/app/study/finished_runs.h"
#include "core/app/study/study_folder.h"
#include "core/app/study/study_options.h"
#include "core/app/study/study_scene.h"

namespace exphoton::cli {

// Thrown if the user stopped the study. Finished runs are kept.
struct StudyInterrupted {};

// RenderedPicture is the result of one child process.
struct RenderedPicture {
  study::RunRow row;  // without image and key
  std::string path;   // of the picture; the caller moves it
};

class StudyRunner {
 public:
  StudyRunner(const StudyOptions& options, StudyFolder& folder, SceneFacts scene,
              ProgramFacts program)
      : options_(options),
        folder_(folder),
        finished_(options, std::move(scene), std::move(program)) {}

  StudyFolder& Folder() { return folder_; }

  // Runs all settings, seed by seed, so that an interrupted study has about equally many runs of
  // each. A task runs its share only.
  std::vector<study::RunRow> RunAll(const std::vector<study::Setting>& settings);

  // Returns a run, rendered or found in the folder. The row's setting is 0.
  study::RunRow RunOne(const study::Setting& setting, std::uint64_t seed,
                       const std::vector<std::string>& extra = {});
  // The same for other files than images/. `name` has no ending, `arguments` are those of a render.
  study::RunRow RunAs(const std::string& name, const std::vector<std::string>& arguments,
                      std::uint64_t seed);

  // Renders even if the folder has the run. Throws StudyInterrupted, or Error with the messages of
  // the child process.
  RenderedPicture Render(const std::vector<std::string>& arguments);

 private:
  // Prints the warnings of a render that earlier renders did not have.
  void ShowWarnings(const study::RunRow& row);

  const StudyOptions& options_;
  StudyFolder& folder_;
  FinishedRuns finished_;
  study::WarningSet warnings_;
  bool wasFound_ = false;  // the last run was found, not rendered
};

// Returns the reference that the options request, rendered or given, or an empty record if there is
// none.
study::ReferenceRecord PrepareReference(const StudyOptions& options, StudyRunner& runner);

// Lower bounds are the smallest times of at most this number of seeds.
inline constexpr int kMostBoundSeeds = 3;

// Returns the lower bounds of the photon integrators, rendered or found in the folder. Returns none
// if tasks made the runs on other processors. Throws Error and StudyInterrupted.
std::vector<study::LowerBound> MeasureLowerBounds(const StudyOptions& options,
                                                  const study::Results& results,
                                                  const study::Analysis& analysis,
                                                  StudyRunner& runner);

void Say(const StudyOptions& options, const std::string& text);  // to standard error, unless quiet

}  // namespace exphoton::cli
