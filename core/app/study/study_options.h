// SPDX-License-Identifier: BSD-2-Clause
// What the command line of `exphoton study`, or a study file, says. A study file (NAME.study) holds
// options, one a line, without the dashes: "seeds 4". Its paths count from its own folder. The
// command line comes after it and wins.
#pragma once

#include <string>
#include <vector>

#include "core/app/analysis/plan.h"

namespace exphoton::cli {

struct StudyOptions {
  std::string scene, folder, title;
  study::StudyPlan plan;
  int seeds = 4;
  int threads = 0;
  std::vector<std::string> sets, pluginFolders;
  bool allowsScenePlugins = false;
  std::string limits;                   // of every render
  std::vector<std::string> inputFiles;  // study files, scenes and references
  std::string cropWindow;               // of every render
  std::int64_t footprintSamples = 16;   // of every render, so that all show the same picture
  std::vector<std::string> crops;       // parts shown larger on the page: "x0,x1,y0,y1"
  std::vector<std::string> references;  // none, one, or two halves
  std::string makeReference;            // a setting, for example "path maxdepth=100"; "": none
  std::string referenceScene;           // another file that shows the same; "": the scene
  double referenceSeconds = 30 * 60;
  std::string clock = "cpu";
  std::vector<double> targets{.1, .03, .01, .003};
  bool makesMaps = true;
  bool isQuiet = false;
  bool onlyPlans = false;  // print the renders instead of doing them
  std::string commandLine;
};

// Throws Error(CommandLine), Error(File), TextRequest.
StudyOptions ParseStudyOptions(const std::vector<std::string>& arguments);

}  // namespace exphoton::cli
