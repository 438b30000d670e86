// SPDX-License-Identifier: BSD-2-Clause
// These tests check diagnostics, the log, progress lines and statistics.
#include "core/base/log.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <thread>

#include "core/base/progress.h"
#include "core/base/statistics.h"
#include "core/base/terminal.h"

namespace exphoton {
namespace {

SourceLocation At(int line, int column, const std::string& text) {
  SourceLocation where;
  where.file = "a.pbrt";
  where.line = line;
  where.column = column;
  where.lineText = text;
  return where;
}

TEST(Diagnostic, PutsACaretUnderTheColumn) {
  EXPECT_EQ(FormatDiagnostic("error", "unknown camera", At(3, 8, "Camera \"perspectiv\""),
                             "did you mean \"perspective\"?"),
            "a.pbrt:3:8: error: unknown camera\n"
            "    Camera \"perspectiv\"\n"
            "           ^\n"
            "    hint: did you mean \"perspective\"?\n");
}

TEST(Diagnostic, NamesTheFilesThatInclude) {
  SourceLocation where = At(1, 1, "x");
  SourceLocation outer = At(9, 2, "");
  outer.file = "main.pbrt";
  SourceLocation middle = At(4, 5, "");
  middle.file = "b.pbrt";
  middle.includedFrom = std::make_shared<SourceLocation>(outer);
  where.includedFrom = std::make_shared<SourceLocation>(middle);
  EXPECT_EQ(FormatDiagnostic("warning", "odd", where, ""),
            "a.pbrt:1:1: warning: odd\n"
            "    x\n"
            "    ^\n"
            "    included from b.pbrt:4:5\n"
            "    included from main.pbrt:9:2\n");
}

TEST(Diagnostic, WithoutAPlaceNamesTheProgram) {
  EXPECT_EQ(FormatDiagnostic("error", "no", {}, ""), "exphoton: error: no\n");
}

TEST(Diagnostic, KeepsTabsAndCountsCharactersNotBytes) {
  EXPECT_EQ(FormatDiagnostic("error", "no", At(1, 6, "\t\xC3\xA4\xC3\xB6x"), ""),
            "a.pbrt:1:6: error: no\n    \t\xC3\xA4\xC3\xB6x\n    \t  ^\n");
}

TEST(Diagnostic, HidesControlBytesAndLineEnds) {
  EXPECT_EQ(FormatDiagnostic("error", "no", At(1, 1, "a\x1b[31m\r"), ""),
            "a.pbrt:1:1: error: no\n    a?[31m\n    ^\n");
}

TEST(Diagnostic, KeepsQuestionMarksAndSpacesAtTheEndOfALine) {
  EXPECT_EQ(FormatDiagnostic("error", "no", At(1, 1, "Shape \"what\" ??"), ""),
            "a.pbrt:1:1: error: no\n    Shape \"what\" ??\n    ^\n");
  EXPECT_EQ(FormatDiagnostic("error", "no", At(1, 3, "a  \r"), ""),
            "a.pbrt:1:3: error: no\n    a  \n      ^\n");
}

TEST(Diagnostic, CutsALongLineRoundTheColumn) {
  std::string line(10000, '.');
  line[5000] = 'X';
  const std::string text = FormatDiagnostic("error", "no", At(1, 5001, line), "");
  EXPECT_LT(text.size(), 300u);
  const std::size_t shown = text.find('\n') + 1, caret = text.find('\n', shown) + 1;
  EXPECT_EQ(text.find('X') - shown, text.find('^') - caret);
}

TEST(Diagnostic, SurvivesAColumnBeyondTheLine) {
  EXPECT_EQ(FormatDiagnostic("error", "no", At(1, 99, "ab"), ""),
            "a.pbrt:1:99: error: no\n    ab\n      ^\n");
}

TEST(Log, SaysTheSameOnceAndCountsIt) {
  Log log(Log::Level::Normal, Log::Sink::Memory);
  log.Warning("dim");
  log.Warning("dim", At(1, 1, "x"));
  log.Notice("dim");
  log.Summarize();
  EXPECT_EQ(log.Messages(),
            (std::vector<std::string>{"exphoton: warning: dim\n", "exphoton: note: dim\n",
                                      "exphoton: warning: dim (2 times in all)\n"}));
  EXPECT_EQ(log.WarningCount(), 2);
}

TEST(Log, LevelsDecideWhatIsSaid) {
  Log quiet(Log::Level::Quiet, Log::Sink::Memory);
  quiet.Notice("a");
  quiet.Verbose("b");
  quiet.Warning("c");
  EXPECT_EQ(quiet.Messages(), std::vector<std::string>{"exphoton: warning: c\n"});
  Log verbose(Log::Level::Verbose, Log::Sink::Memory);
  verbose.Verbose("b");
  EXPECT_EQ(verbose.Messages(), std::vector<std::string>{"exphoton: note: b\n"});
}

TEST(Log, TakesMessagesFromManyThreads) {
  Log log(Log::Level::Normal, Log::Sink::Memory);
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&] {
      for (int i = 0; i < 500; ++i) log.Warning("number " + std::to_string(i % 10));
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(log.Messages().size(), 10u);
  EXPECT_EQ(log.WarningCount(), 2000);
}

TEST(Terminal, ColorsFollowTheEnvironment) {
  unsetenv("NO_COLOR");
  setenv("CLICOLOR_FORCE", "1", 1);
  EXPECT_EQ(Colored("a.pbrt: error: x\n", "error"), "a.pbrt: \x1b[1;31merror:\x1b[0m x\n");
  setenv("NO_COLOR", "1", 1);
  EXPECT_EQ(Colored("a.pbrt: error: x\n", "error"), "a.pbrt: error: x\n");
  unsetenv("NO_COLOR");
  unsetenv("CLICOLOR_FORCE");
  setenv("TERM", "dumb", 1);
  EXPECT_FALSE(UsesColor());
  EXPECT_FALSE(IsRedrawable());
}

TEST(Progress, WritesALineForEveryTenthWhereNothingCanBeRedrawn) {
  setenv("TERM", "dumb", 1);
  ::testing::internal::CaptureStderr();
  ProgressReporter progress;
  progress.Begin("Rendering", 1000);
  for (int i = 0; i < 1000; ++i) progress.Advance();
  progress.End();
  const std::string text = ::testing::internal::GetCapturedStderr();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 10);
  EXPECT_EQ(text.find("Rendering:  10 %, "), 0u);
  EXPECT_NE(text.find(" elapsed, "), std::string::npos);
  EXPECT_NE(text.find("Rendering: 100 %, "), std::string::npos);
  EXPECT_EQ(text.find('\r'), std::string::npos);
}

TEST(Progress, SaysNothingWhenQuiet) {
  ::testing::internal::CaptureStderr();
  ProgressReporter progress(ProgressReporter::Mode::Quiet);
  progress.Begin("Rendering", 10);
  progress.SetDone(5);
  progress.End();
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST(Statistics, AddUpByName) {
  Statistics statistics;
  RayCounters rays;
  rays.Count(RayKind::Shadow);
  statistics.AddRays(rays);
  statistics.AddRays(rays);
  statistics.AddPhase("shoot", 1, 2);
  statistics.AddPhase("render", 5, 5);
  statistics.AddPhase("shoot", 1, 2);
  statistics.SetCounter("photons", 3, "stored");
  statistics.SetCounter("photons", 4, "stored");
  EXPECT_EQ(statistics.Rays().counts[std::size_t(RayKind::Shadow)], 2u);
  ASSERT_EQ(statistics.Phases().size(), 2u);
  EXPECT_EQ(statistics.Phases()[0].name, "shoot");
  EXPECT_EQ(statistics.Phases()[0].cpuSeconds, 4);
  ASSERT_EQ(statistics.Counters().size(), 1u);
  EXPECT_EQ(statistics.Counters()[0].value, 4);
  statistics.AddToCounter("photons", 5, "stored");
  statistics.AddToCounter("photons", 6, "stored");
  EXPECT_EQ(statistics.Counters()[0].value, 15);
}

TEST(Statistics, AddUpEveryCounterOfRays) {
  RayCounters rays;
  for (std::size_t kind = 0; kind < kRayKindCount; ++kind) rays.counts[kind] = kind + 1;
  rays.cutThroughput = .5, rays.cutGatherThroughput = .25;
  Statistics statistics;
  for (int i = 0; i < 3; ++i) statistics.AddRays(rays);
  for (std::size_t kind = 0; kind < kRayKindCount; ++kind)
    EXPECT_EQ(statistics.Rays().counts[kind], 3 * (kind + 1)) << RayKindName(RayKind(kind));
  EXPECT_EQ(statistics.Rays().cutThroughput, 1.5);
  EXPECT_EQ(statistics.Rays().cutGatherThroughput, .75);
}

}  // namespace
}  // namespace exphoton
