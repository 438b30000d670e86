// SPDX-License-Identifier: BSD-2-Clause
// The tests that cases name: whether they exist, and where asked, whether they pass.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "tests/hardcases/case_file.h"

namespace exphoton::hardcases {

class NamedTests {
 public:
  // Lists the tests of every program that a case names, in the folder of the programs.
  NamedTests(const std::string& folder, const std::vector<const Case*>& cases);

  // Runs those that are named, each once; `jobs` programs at a time.
  void Run(int jobs);

  struct Result {
    int count = 0;
    std::vector<std::string> failed, missing;  // names; patterns that match nothing
  };
  Result Of(const Case& asked) const;

 private:
  std::set<std::string> Matching(const NamedTest& test) const;

  std::string folder_;
  std::vector<const Case*> cases_;
  std::map<std::string, std::set<std::string>> known_;  // of each program
  std::set<std::string> passed_;
  bool areRun_ = false;
};

}  // namespace exphoton::hardcases
