// SPDX-License-Identifier: BSD-2-Clause
// Judge runs a case's scenes and scripts and compares the outcome with the case's requirements.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/imaging/image.h"
#include "tests/hardcases/case_file.h"
#include "tests/support/process.h"

namespace exphoton::hardcases {

struct Verdict {
  std::vector<std::string> seen;      // short texts for the table
  std::vector<std::string> failures;  // none: passed, or left out
  bool isLeftOut = false;             // a script lacks something that it needs
  std::vector<double> falseAlarms;    // of its means (PictureResult::falseAlarm)
  double seconds = 0, megabytes = 0;  // the sum; the maximum over processes
};

struct Programs {
  std::string folder;      // holds test_*
  std::string exphoton;    // the program under test
  double patience = 1;     // multiplies time and memory limits (sanitizers)
  std::uint64_t seed = 1;  // first seed
  bool isFull = false;     // includes slow runs
};

class Judge {
 public:
  Judge(const Case& asked, const Programs& programs) : asked_(asked), programs_(programs) {}
  Verdict Run();

 private:
  struct Pictures {
    std::vector<Image> images;  // one per seed
    ProcessResult last;
  };

  void RunScene(const hardcases::Run& run);
  ProcessResult RunSeed(const hardcases::Run& run, int seed, Pictures* pictures);
  void CheckFiles(const hardcases::Run& run, const ProcessResult& outcome, const TestFolder& folder,
                  Pictures* pictures);
  void CheckFailure(const hardcases::Run& run, const ProcessResult& outcome,
                    const TestFolder& folder);
  void CheckMessages(const hardcases::Run& run, const ProcessResult& outcome);
  void CheckPictures(const hardcases::Run& run);
  void RunScript(const Script& script);
  void Count(const ProcessResult& outcome);
  void Fail(const std::string& where, const std::string& what);
  // Returns the pictures of an earlier run of the case. If there are none, records a failure and
  // returns null.
  const Pictures* Of(const std::string& where, const std::string& name);

  const Case& asked_;
  const Programs& programs_;
  std::map<std::string, Pictures> pictures_;
  std::map<int, int> statuses_;  // number of runs by status
  Verdict verdict_;
};

}  // namespace exphoton::hardcases
