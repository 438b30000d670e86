// SPDX-License-Identifier: BSD-2-Clause
// StudyOptions holds the options of `exphoton study`, from the command line or a study file. A
// study file (NAME.study) has one option per line, without dashes: "seeds 4". Its paths are
// relative to its own folder. An option of the command line replaces the file's.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/app/analysis/plan.h"
#include "core/app/shards/slurm_scripts.h"
#include "core/app/study/study_tasks.h"

namespace exphoton::cli {

struct StudyOptions {
  std::string scene, folder, title;
  study::StudyPlan plan;
  int seeds = 4;
  int threads = 0;
  std::vector<std::string> sets, pluginFolders;
  std::map<std::string, std::set<std::string>> foreignSets;  // those of `sets`, by integrator
  bool allowsScenePlugins = false;
  std::string limits;                   // of every render
  std::vector<std::string> inputFiles;  // study files, scenes and references
  std::string cropWindow;               // of every render
  std::int64_t footprintSamples = 16;   // equal in every render, so that all show the same picture
  std::vector<std::string> crops;       // parts enlarged in the report: "x0,x1,y0,y1"
  std::vector<std::string> references;  // none, one, or two halves
  std::string makeReference;            // a setting, for example "path maxdepth=100"; "": none
  std::string referenceScene;           // another file with the same picture; "": the scene
  double referenceSeconds = 30 * 60;
  std::string photonFile;  // "": renders shoot their photons; %d in the name is the seed
  std::set<std::string> photonIntegrators;  // those that read photonFile
  std::string clock = "cpu";
  std::vector<double> targets{.1, .03, .01, .003};
  bool makesMaps = true;
  bool isQuiet = false;
  bool onlyPlans = false;     // print the planned renders and stop
  bool predicts = false;      // quote each integrator before the renders
  bool makesBudgets = false;  // make the error budgets of photon integrators
  bool certifies = false;     // render photon integrators with certificates
  // The parameters of the scene's integrator that decide about certificates, as --set takes them.
  std::vector<std::string> sceneSets;
  std::string commandLine;

  // Studies as arrays of jobs
  int taskCount = 0;              // --tasks: write scripts for N tasks; 0: run the study
  std::optional<StudyTask> task;  // --task: run the renders of one task
  bool isAlone = false;           // --alone: no other work runs on this machine
  bool sharesNodes = false;       // --share-nodes: tasks may share machines
  std::string tasksFolder;        // --from: the folder with the folders of tasks; "": none
  int missingOf = 0;              // --missing: print which of N tasks have to run
  ArrayOptions array;
  std::vector<std::string> arguments;  // as given
};

// Throws Error(CommandLine), Error(File) and TextRequest.
StudyOptions ParseStudyOptions(const std::vector<std::string>& arguments);

}  // namespace exphoton::cli
