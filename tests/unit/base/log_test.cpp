// SPDX-License-Identifier: BSD-2-Clause
// These tests check diagnostics, the log, progress lines and statistics.
#include "core/base/log.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <thread>
#include <utility>

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

// A render of 100 s, of which photons take 10 s, with an advance in each tenth of a second.
std::string LinesOf(double seconds) {
  setenv("TERM", "dumb", 1);
  double now = 1000;
  ::testing::internal::CaptureStderr();
  ProgressReporter progress(ProgressReporter::Mode::Auto, [&now] { return now; });
  for (const auto& [phase, share] : {std::pair{"Shooting photons", .1}, {"Rendering", .9}}) {
    progress.Begin(phase, 1000);
    for (int i = 0; i < 1000; ++i) {
      now += seconds * share / 1000;
      progress.CountRays(1000);
      progress.Advance();
    }
    progress.End();
  }
  return ::testing::internal::GetCapturedStderr();
}

TEST(Progress, WritesLinesByTimeWhereNothingCanBeRedrawn) {
  const std::string text = LinesOf(100);
  EXPECT_EQ(
      text.find("Shooting photons:   7 %, 5.0 s elapsed, about 1 min 06 s left, 100 k rays/s\n"),
      0u)
      << text;
  EXPECT_NE(text.find("\nRendering:  "), std::string::npos) << text;
  EXPECT_NE(text.find(" left, 11 k rays/s\n"), std::string::npos) << text;
  EXPECT_EQ(text.find('\r'), std::string::npos);
  const auto lines = std::count(text.begin(), text.end(), '\n');
  EXPECT_GE(lines, 8) << text;
  EXPECT_LE(lines, 10) << text;
}

TEST(Progress, WritesNothingForShortRenders) {
  EXPECT_EQ(LinesOf(4.9), "");
  const std::string text = LinesOf(12);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1) << text;
}

TEST(Progress, EstimatesTheTimeLeft) {
  const std::string text = LinesOf(1000);
  int checked = 0;
  for (std::size_t at = 0; (at = text.find("Rendering:", at)) != std::string::npos; ++at) {
    double minutes = 0, seconds = 0, minutesLeft = 0, secondsLeft = 0;
    int percent = 0;
    if (std::sscanf(text.c_str() + at,
                    "Rendering: %d %%, %lf min %lf s elapsed, %lf min %lf s left", &percent,
                    &minutes, &seconds, &minutesLeft, &secondsLeft) != 5)
      continue;
    ++checked;
    EXPECT_NEAR(60 * (minutes + minutesLeft) + seconds + secondsLeft, 1000, 3) << text.substr(at);
  }
  EXPECT_GT(checked, 3) << text;
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

// The kernel's own report is the oracle.
TEST(Statistics, ThePeakOfMemoryIsInBytes) {
  double kibibytes = 0;
  std::ifstream file("/proc/self/status");
  for (std::string word; file >> word;)
    if (word == "VmHWM:") file >> kibibytes;
  if (kibibytes == 0) GTEST_SKIP() << "the system does not report its peak of memory";
  EXPECT_NEAR(PeakMemoryBytes() / (1024 * kibibytes), 1, .1);
}

TEST(Statistics, AddUpEveryCounterOfRays) {
  RayCounters rays;
  for (std::size_t kind = 0; kind < kRayKindCount; ++kind) rays.counts[kind] = kind + 1;
  rays.cutThroughput = .5, rays.cutGatherThroughput = .25, rays.cutLightSamples = 2;
  Statistics statistics;
  for (int i = 0; i < 3; ++i) statistics.AddRays(rays);
  for (std::size_t kind = 0; kind < kRayKindCount; ++kind)
    EXPECT_EQ(statistics.Rays().counts[kind], 3 * (kind + 1)) << RayKindName(RayKind(kind));
  EXPECT_EQ(statistics.Rays().cutThroughput, 1.5);
  EXPECT_EQ(statistics.Rays().cutGatherThroughput, .75);
  EXPECT_EQ(statistics.Rays().cutLightSamples, 6u);
}

}  // namespace
}  // namespace exphoton
