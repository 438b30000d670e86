// SPDX-License-Identifier: BSD-2-Clause
// NamedTests checks that the tests that cases name exist and, on request, that they pass.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "tests/hardcases/case_file.h"

namespace exphoton::hardcases {

class NamedTests {
 public:
  // Lists the tests of every program that a case names. `folder` holds the programs.
  NamedTests(const std::string& folder, const std::vector<const Case*>& cases);

  // Runs each named test once, with `jobs` programs at a time.
  void Run(int jobs);

  struct Result {
    int count = 0;
    std::vector<std::string> failed, missing;  // names of tests; patterns that match no test
  };
  Result Of(const Case& asked) const;

 private:
  std::set<std::string> Matching(const NamedTest& test) const;

  std::string folder_;
  std::vector<const Case*> cases_;
  std::map<std::string, std::set<std::string>> known_;  // names of the tests of each program
  std::set<std::string> passed_;
  bool areRun_ = false;
};

}  // namespace exphoton::hardcases
