// SPDX-License-Identifier: BSD-2-Clause
// hardcases runs the catalogue of hard cases and prints the expected and the actual results.
// Exit status: 0 all passed or are known to be open, 1 some failed, 2 wrong usage or catalogue.
#include <algorithm>
#include <atomic>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <set>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "tests/hardcases/case_file.h"
#include "tests/hardcases/judge.h"
#include "tests/hardcases/named_tests.h"
#include "tests/hardcases/report.h"

namespace exphoton::hardcases {
namespace {

struct Options {
  std::string cases = std::string(EXPHOTON_SOURCE_DIR) + "/tests/hardcases/cases";
  Programs programs{std::string(EXPHOTON_BINARY_DIR) + "/bin",
                    std::string(EXPHOTON_BINARY_DIR) + "/bin/exphoton"};
  std::set<std::string> only;
  std::string page;
  int jobs = 2;
  bool isFull = false, runsTests = false, isQuiet = false;
};

constexpr const char* kUsage =
    "usage: hardcases [--full] [--tests] [--only 12,70,T1] [--page FILE.md] [--jobs N]\n"
    "                 [--patience FACTOR] [--seed N] [--program PATH] [--cases FOLDER] [--quiet]\n"
    "  --full      the slow cases too\n"
    "  --tests     run the named tests as well (default: only look whether they exist)\n"
    "  --patience  multiplies limits of time and memory, for sanitizers\n"
    "  --program   the exphoton to test, if not the one of this build\n";

Options OptionsFrom(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const auto value = [&]() -> std::string {
      if (i + 1 >= argc) throw std::runtime_error(word + " needs a value");
      return argv[++i];
    };
    if (word == "--full") {
      options.isFull = options.programs.isFull = true;
    } else if (word == "--tests") {
      options.runsTests = true;
    } else if (word == "--quiet") {
      options.isQuiet = true;
    } else if (word == "--only") {
      std::istringstream list(value());
      for (std::string id; std::getline(list, id, ',');) options.only.insert(id);
    } else if (word == "--cases") {
      options.cases = value();
    } else if (word == "--page") {
      options.page = value();
    } else if (word == "--jobs") {
      options.jobs = std::stoi(value());
    } else if (word == "--patience") {
      options.programs.patience = std::stod(value());
    } else if (word == "--program") {
      options.programs.exphoton = std::filesystem::absolute(value()).string();
    } else if (word == "--seed") {
      options.programs.seed = std::stoull(value());
    } else {
      throw std::runtime_error("unknown option " + word + "\n" + kUsage);
    }
  }
  return options;
}

void Fill(const Verdict& verdict, const NamedTests::Result& tests, bool areRun, Line* line) {
  line->failures = verdict.failures;
  line->falseAlarms = verdict.falseAlarms;
  line->seconds = verdict.seconds;
  line->megabytes = verdict.megabytes;
  constexpr std::size_t kMaxSeen = 6;
  for (std::size_t i = 0; i < verdict.seen.size() && i < kMaxSeen; ++i)
    line->seen += (i > 0 ? "; " : "") + verdict.seen[i];
  if (verdict.seen.size() > kMaxSeen) line->seen += "; ...";
  if (tests.count > 0) {
    line->seen += (line->seen.empty() ? "" : "; ") + std::to_string(tests.count) +
                  (tests.count == 1 ? " test" : " tests") + (areRun ? "" : " (by name)");
  }
  for (const auto& name : tests.failed) line->failures.push_back("test " + name + " failed");
  for (const auto& name : tests.missing) line->failures.push_back("no test " + name);
  const Case& asked = *line->asked;
  const bool asksNothing = asked.runs.empty() && asked.scripts.empty() && asked.tests.empty();
  if (!asked.open.empty()) {
    line->state = State::Open;
  } else if (asksNothing) {
    line->state = State::Failed;
    line->failures.push_back("nothing is asked");
  } else if (!line->failures.empty()) {
    line->state = State::Failed;
  } else {
    line->state = verdict.isLeftOut ? State::LeftOut : State::Passed;
  }
}

int RunCatalogue(const Options& options) {
  const std::vector<Group> groups = ReadCatalogue(options.cases);
  std::vector<Line> lines;
  std::vector<const Case*> chosen;
  for (const Group& group : groups) {
    for (const Case& each : group.cases) {
      if (!options.only.empty() && !options.only.contains(each.id)) continue;
      Line line;
      line.group = &group;
      line.asked = &each;
      lines.push_back(line);
      if (!each.isSlow || options.isFull || !options.only.empty()) chosen.push_back(&each);
    }
  }
  NamedTests tests(options.programs.folder, chosen);
  if (options.runsTests) tests.Run(options.jobs);

  std::atomic<std::size_t> next{0};
  std::mutex lock;
  const auto work = [&] {
    for (std::size_t i; (i = next++) < lines.size();) {
      Line& line = lines[i];
      if (std::find(chosen.begin(), chosen.end(), line.asked) == chosen.end()) continue;
      Verdict verdict;
      try {
        verdict = Judge(*line.asked, options.programs).Run();
      } catch (const std::exception& error) {
        verdict.failures.push_back(error.what());
      }
      Fill(verdict, tests.Of(*line.asked), options.runsTests, &line);
      const std::lock_guard guard(lock);
      if (!options.isQuiet || line.state == State::Failed) {
        std::fputs(TerminalLine(line).c_str(), stdout);
        std::fflush(stdout);
      }
    }
  };
  {
    std::vector<std::jthread> threads;
    for (int i = 0; i < options.jobs; ++i) threads.emplace_back(work);
  }
  const std::string summary = Summary(lines) + "\n" + FalseAlarmText(lines);
  std::printf("\n%s", summary.c_str());
  if (!options.page.empty()) std::ofstream(options.page) << summary << Page(lines);
  for (const Line& line : lines)
    if (line.state == State::Failed) return 1;
  return 0;
}

}  // namespace
}  // namespace exphoton::hardcases

int main(int argc, char** argv) {
  try {
    return exphoton::hardcases::RunCatalogue(exphoton::hardcases::OptionsFrom(argc, argv));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "hardcases: %s\n", error.what());
    return 2;
  }
}
