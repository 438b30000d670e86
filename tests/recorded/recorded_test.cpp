// SPDX-License-Identifier: BSD-2-Clause
// These tests compare the results of tiny scenes and the outputs of commands with those that were
// recorded. A failure says that something changed, not that it is wrong. The same program records:
//   test_recorded --record              writes the records anew and lists what changed
//   test_recorded --record GROUP        the same for the scenes of one group ("random_3")
//   test_recorded --record-outputs      the same for figures and the outputs of commands alone
//   test_recorded --print SCENE         prints a scene
//   test_recorded --list                lists the scenes and the CPU seconds of each
//   test_recorded --check FILE          compares what the lines of the file name until something
//                                       differs: scenes, "outputs" or "figures"
//   test_recorded --apart               renders each scene in its own process, where the variable
//                                       EXPHOTON_REACHED_BY is the scene's name
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>

#include "core/base/statistics.h"
#include "tests/recorded/command_outputs.h"
#include "tests/recorded/figures.h"
#include "tests/recorded/record_file.h"

namespace exphoton::recorded {
namespace {

constexpr const char* kLinesFile = "records/lines.txt";
constexpr const char* kFiguresFile = "records/figures.txt";

// Every fourth scene is rendered by three threads. No result depends on their number.
int ThreadCount(std::size_t scene) {
  const char* threads = std::getenv("EXPHOTON_RECORDED_THREADS");
  return threads ? std::atoi(threads) : scene % 4 == 3 ? 3 : 1;
}

std::string Advice(const RecordedScene& scene) {
  return "To render it: build/bin/test_recorded --print '" + scene.name +
         "' >scene.pbrt; build/bin/exphoton scene.pbrt --seed " + std::to_string(kSeed) +
         " -o scene.exr (both in the folder of the sources)\nIf the change is meant, record it: "
         "./dev test --record";
}

std::string Joined(const std::vector<std::string>& lines, std::size_t most) {
  std::string text;
  for (std::size_t i = 0; i < std::min(most, lines.size()); ++i) text += "\n  " + lines[i];
  if (lines.size() > most) text += "\n  and " + std::to_string(lines.size() - most) + " more";
  return text;
}

// Returns lines of the texts that no record knows, if the texts changed.
std::vector<std::string> NewLines(const Measurement& measurement) {
  static const std::vector<std::string> list = LinesOf(kLinesFile);
  static const std::set<std::string> known(list.begin(), list.end());
  std::vector<std::string> lines;
  for (const std::string& line : LinesWithoutNumbers(measurement))
    if (!line.empty() && !known.contains(line)) lines.push_back("new line: " + line);
  return lines;
}

std::vector<std::string> Compare(const Records& records, const RecordedScene& scene,
                                 const Measurement& measurement) {
  const auto record = records.find(scene.name);
  if (record == records.end()) return {"was not recorded"};
  std::vector<std::string> differences = Differences(record->second, measurement);
  if (!differences.empty()) {
    const std::vector<std::string> lines = NewLines(measurement);
    differences.insert(differences.end(), lines.begin(), lines.end());
  }
  return differences;
}

bool IsComparable() {
#if defined(EXPHOTON_DOUBLE) || defined(EXPHOTON_TRAPS) || defined(RECORDED_ELSEWHERE) || \
    !defined(__x86_64__)
  return false;
#else
  return true;
#endif
}

// Whether one difference is enough: --gtest_fail_fast.
bool StopsAtTheFirst() { return GTEST_FLAG_GET(fail_fast); }

class RecordedResults : public ::testing::TestWithParam<std::string> {};

TEST_P(RecordedResults, AreAsRecorded) {
  if (!IsComparable()) GTEST_SKIP() << "recorded by a build for x86-64 without sanitizers";
  const Records records = ReadRecords(GetParam());
  std::set<std::string> names;
  int changed = 0;
  for (const RecordedScene& scene : ScenesOf(GetParam())) {
    names.insert(scene.name);
    const std::vector<std::string> differences =
        Compare(records, scene, Measure(scene, ThreadCount(names.size())));
    if (differences.empty()) continue;
    if (++changed <= 5)
      ADD_FAILURE() << scene.name << Joined(differences, 8) << "\n" << Advice(scene);
    if (StopsAtTheFirst()) return;
  }
  if (changed > 5) ADD_FAILURE() << changed << " scenes changed in all";
  for (const auto& [name, record] : records)
    EXPECT_TRUE(names.contains(name)) << "\"" << name << "\" was recorded and is no scene any more";
}

INSTANTIATE_TEST_SUITE_P(Groups, RecordedResults, ::testing::ValuesIn(GroupNames()),
                         [](const auto& info) { return info.param; });

// Returns the differences between two lists, as lines that are missing and lines that are new.
std::vector<std::string> Compare(const CommandOutput& before, const CommandOutput& now) {
  std::vector<std::string> differences;
  const std::size_t count = std::max(before.lines.size(), now.lines.size());
  for (std::size_t i = 0; i < count; ++i) {
    const bool isOld = i < before.lines.size(), isNew = i < now.lines.size();
    if (isOld && isNew && before.lines[i] == now.lines[i]) continue;
    if (isOld) differences.push_back("recorded: " + before.lines[i]);
    if (isNew) differences.push_back("now:      " + now.lines[i]);
  }
  return differences;
}

// Returns the first difference of the outputs of commands, without the commands after it.
std::vector<std::string> FirstDifferenceOfOutputs() {
  const std::vector<CommandOutput> before = ReadOutputs();
  std::size_t count = 0;
  std::vector<std::string> differences;
  CommandOutputs([&](const CommandOutput& now) {
    differences = count < before.size() ? Compare(before[count], now) : std::vector{now.command};
    ++count;
    return differences.empty();
  });
  if (differences.empty() && count < before.size())
    differences = {"was recorded and is no command any more: " + before[count].command};
  return differences;
}

TEST(RecordedOutputs, AreAsRecorded) {
  if (!IsComparable()) GTEST_SKIP() << "recorded by a build for x86-64 without sanitizers";
  if (StopsAtTheFirst()) {
    const std::vector<std::string> differences = FirstDifferenceOfOutputs();
    ASSERT_TRUE(differences.empty()) << Joined(differences, 8);
    return;
  }
  const std::vector<CommandOutput> before = ReadOutputs(), now = CommandOutputs();
  ASSERT_EQ(before.size(), now.size()) << "the commands are not those that were recorded";
  for (std::size_t i = 0; i < now.size(); ++i) {
    ASSERT_EQ(before[i].command, now[i].command);
    const std::vector<std::string> differences = Compare(before[i], now[i]);
    if (!differences.empty())
      ADD_FAILURE() << now[i].command << Joined(differences, 8)
                    << "\nIf the change is meant, record it: ./dev test --record";
  }
}

TEST(RecordedFigures, AreAsRecorded) {
  if (!IsComparable()) GTEST_SKIP() << "recorded by a build for x86-64 without sanitizers";
  const std::vector<std::string> differences =
      Compare({"", LinesOf(kFiguresFile)}, {"", Figures()});
  EXPECT_TRUE(differences.empty())
      << Joined(differences, 12) << "\nIf the change is meant, record it: ./dev test --record";
}

std::ofstream FileOf(const char* name) {
  return std::ofstream(std::string(EXPHOTON_SOURCE_DIR) + "/tests/recorded/" + name);
}

void RecordFigures() {
  const std::vector<std::string> before = LinesOf(kFiguresFile), now = Figures();
  std::printf("%zu lines of figures changed\n", Compare({"", before}, {"", now}).size());
  std::ofstream file = FileOf(kFiguresFile);
  file << "# Written by ./dev test --record; see docs/development/testing.md.\n";
  for (const std::string& line : now) file << line << "\n";
}

// Writes the outputs of the commands and prints what changed.
void RecordOutputs() {
  const std::vector<CommandOutput> before = ReadOutputs(), now = CommandOutputs();
  std::ofstream(OutputsPath()) << OutputsText(now);
  for (const CommandOutput& output : now) {
    const auto same = std::find_if(before.begin(), before.end(), [&](const CommandOutput& old) {
      return old.command == output.command && old.lines == output.lines;
    });
    if (same == before.end()) std::printf("%s: changed\n", output.command.c_str());
  }
}

// Writes the records of a group and prints what changed. Returns the number of changed scenes.
int RecordGroup(const std::string& group, std::set<std::string>* lines) {
  const Records before = ReadRecords(group);
  int changed = 0;
  std::string text = "# Written by ./dev test --record; see docs/development/testing.md.\n";
  for (const RecordedScene& scene : ScenesOf(group)) {
    const Measurement measurement = Measure(scene, ThreadCount(0));
    text += RecordText(scene.name, measurement);
    for (const std::string& line : LinesWithoutNumbers(measurement)) lines->insert(line);
    const std::vector<std::string> differences = Compare(before, scene, measurement);
    if (differences.empty()) continue;
    ++changed;
    std::printf("%s%s\n", scene.name.c_str(), Joined(differences, 4).c_str());
  }
  std::ofstream(RecordPath(group)) << text;
  return changed;
}

int RecordAll() {
  if (!IsComparable()) {
    std::fprintf(stderr, "only a build for x86-64 without sanitizers records results\n");
    return 1;
  }
  std::set<std::string> lines;
  int changed = 0;
  for (const std::string& group : GroupNames()) changed += RecordGroup(group, &lines);
  RecordOutputs();
  RecordFigures();
  lines.erase("");
  std::ofstream file = FileOf(kLinesFile);
  file << "# The lines of explanations, messages and errors of all scenes; # is a number.\n";
  for (const std::string& line : lines) file << (line[0] == '#' ? " " : "") << line << "\n";
  std::printf("%d scenes changed; see the difference of tests/recorded/records\n", changed);
  return file.good() ? 0 : 1;
}

// Without lines.txt, which only says which lines of a failure are new.
int RecordOne(const std::string& group) {
  const std::vector<std::string> groups = GroupNames();
  if (!IsComparable() || std::find(groups.begin(), groups.end(), group) == groups.end()) {
    std::fprintf(stderr, "\"%s\" cannot be recorded\n", group.c_str());
    return 1;
  }
  std::set<std::string> lines;
  std::printf("%d scenes changed\n", RecordGroup(group, &lines));
  return 0;
}

int ListAll() {
  for (const std::string& group : GroupNames()) {
    for (const RecordedScene& scene : ScenesOf(group)) {
      const double start = ProcessCpuSeconds();
      const Measurement measurement = Measure(scene, ThreadCount(0));
      const auto error = measurement.texts.find("error");
      std::printf("%.3f %s: %s%s\n", ProcessCpuSeconds() - start, group.c_str(), scene.name.c_str(),
                  error == measurement.texts.end() ? "" : ("\n  error: " + error->second).c_str());
    }
  }
  return 0;
}

// Prints the first of the named scenes that differs from its record and returns 1, or 0 if none
// does.
int Check(const std::string& file) {
  std::map<std::string, std::pair<RecordedScene, std::string>> scenes;
  for (const std::string& group : GroupNames())
    for (const RecordedScene& scene : ScenesOf(group)) scenes[scene.name] = {scene, group};
  std::map<std::string, Records> records;
  std::ifstream names(file);
  for (std::string name; std::getline(names, name);) {
    std::vector<std::string> differences;
    if (name == "outputs") {
      differences = FirstDifferenceOfOutputs();
    } else if (name == "figures") {
      differences = Compare({"", LinesOf(kFiguresFile)}, {"", Figures()});
    } else {
      const auto& [scene, group] = scenes.at(name);
      if (!records.contains(group)) records[group] = ReadRecords(group);
      differences = Compare(records[group], scene, Measure(scene, 1));
    }
    if (differences.empty()) continue;
    std::printf("%s%s\n", name.c_str(), Joined(differences, 4).c_str());
    return 1;
  }
  return 0;
}

int MeasureApart() {
  for (const std::string& group : GroupNames()) {
    for (const RecordedScene& scene : ScenesOf(group)) {
      std::fflush(stdout);
      const pid_t child = fork();
      if (child == 0) {
        setenv("EXPHOTON_REACHED_BY", scene.name.c_str(), 1);
        const double start = ProcessCpuSeconds();
        Measure(scene, 1);
        std::printf("%.4f %s\n", ProcessCpuSeconds() - start, scene.name.c_str());
        std::exit(0);
      }
      int status = 0;
      waitpid(child, &status, 0);
    }
  }
  return 0;
}

int Print(const std::string& name) {
  for (const std::string& group : GroupNames())
    for (const RecordedScene& scene : ScenesOf(group))
      if (scene.name == name) return std::printf("%s", scene.text.c_str()) < 0;
  std::fprintf(stderr, "no scene is named \"%s\"\n", name.c_str());
  return 1;
}

}  // namespace
}  // namespace exphoton::recorded

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  std::filesystem::current_path(EXPHOTON_SOURCE_DIR);  // scenes name files from there
  const std::string command = argc > 1 ? argv[1] : "";
  if (command == "--record" && argc > 2) return exphoton::recorded::RecordOne(argv[2]);
  if (command == "--record") return exphoton::recorded::RecordAll();
  if (command == "--record-outputs") {
    exphoton::recorded::RecordOutputs();
    exphoton::recorded::RecordFigures();
    return 0;
  }
  if (command == "--list") return exphoton::recorded::ListAll();
  if (command == "--apart") return exphoton::recorded::MeasureApart();
  if (command == "--check" && argc > 2) return exphoton::recorded::Check(argv[2]);
  if (command == "--print" && argc > 2) return exphoton::recorded::Print(argv[2]);
  return RUN_ALL_TESTS();
}
