// SPDX-License-Identifier: BSD-2-Clause
// NamedTests runs GoogleTest programs and selects their tests by GoogleTest's filter.
#include "tests/hardcases/named_tests.h"

#include <fnmatch.h>

#include <atomic>
#include <mutex>
#include <sstream>
#include <thread>

#include "tests/support/process.h"

namespace exphoton::hardcases {
namespace {

std::set<std::string> ListOf(const std::string& program) {
  const TestFolder folder;
  const ProcessResult outcome = RunProcess({{program, "--gtest_list_tests"}, folder.Path()});
  std::set<std::string> names;
  std::istringstream lines(outcome.out);
  std::string suite;
  for (std::string line; std::getline(lines, line);) {
    line = line.substr(0, line.find("  #"));
    if (line.empty()) continue;
    if (line[0] != ' ') {
      suite = line;
    } else {
      names.insert(suite + line.substr(line.find_first_not_of(' ')));
    }
  }
  return names;
}

}  // namespace

NamedTests::NamedTests(const std::string& folder, const std::vector<const Case*>& cases)
    : folder_(folder), cases_(cases) {
  for (const Case* each : cases)
    for (const auto& test : each->tests)
      if (!known_.contains(test.program))
        known_[test.program] = ListOf(folder + "/test_" + test.program);
}

std::set<std::string> NamedTests::Matching(const NamedTest& test) const {
  std::set<std::string> names;
  for (const auto& name : known_.at(test.program))
    if (fnmatch(test.pattern.c_str(), name.c_str(), 0) == 0) names.insert(name);
  return names;
}

void NamedTests::Run(int jobs) {
  areRun_ = true;
  std::set<std::pair<std::string, std::string>> wanted;  // program and test
  for (const Case* each : cases_)
    for (const auto& test : each->tests)
      for (const auto& name : Matching(test)) wanted.insert({test.program, name});
  const std::vector<std::pair<std::string, std::string>> list(wanted.begin(), wanted.end());
  std::atomic<std::size_t> next{0};
  std::mutex lock;
  const auto work = [&] {
    for (std::size_t i; (i = next++) < list.size();) {
      const TestFolder folder;
      ProcessCommand command{
          {folder_ + "/test_" + list[i].first, "--gtest_filter=" + list[i].second}, folder.Path()};
      command.timeLimit = 600;
      const ProcessResult outcome = RunProcess(command);
      const std::lock_guard guard(lock);
      if (outcome.status == 0) passed_.insert(list[i].first + ":" + list[i].second);
    }
  };
  std::vector<std::jthread> threads;
  for (int i = 0; i < jobs; ++i) threads.emplace_back(work);
}

NamedTests::Result NamedTests::Of(const Case& asked) const {
  Result result;
  for (const auto& test : asked.tests) {
    const auto names = Matching(test);
    if (names.empty()) result.missing.push_back(test.pattern);
    for (const auto& name : names) {
      ++result.count;
      if (areRun_ && !passed_.contains(test.program + ":" + name)) result.failed.push_back(name);
    }
  }
  return result;
}

}  // namespace exphoton::hardcases
