// SPDX-License-Identifier: BSD-2-Clause
// These tests read the progress bar from a pseudo-terminal, with a clock of their own.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <string>

#include "core/base/progress.h"
#include "core/base/terminal.h"

namespace exphoton {
namespace {

// BarTerminal replaces standard error by a terminal of this width until it is destroyed.
class BarTerminal {
 public:
  explicit BarTerminal(int columns) : saved_(dup(STDERR_FILENO)) {
    setenv("TERM", "xterm", 1);
    master_ = posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK);
    if (master_ < 0 || grantpt(master_) != 0 || unlockpt(master_) != 0) return;
    const int slave = open(ptsname(master_), O_RDWR | O_NOCTTY);
    winsize size{};
    size.ws_row = 24;
    size.ws_col = static_cast<unsigned short>(columns);
    ioctl(slave, TIOCSWINSZ, &size);
    dup2(slave, STDERR_FILENO);
    close(slave);
  }
  ~BarTerminal() {
    dup2(saved_, STDERR_FILENO);
    close(saved_);
    close(master_);
  }
  BarTerminal(const BarTerminal&) = delete;
  BarTerminal& operator=(const BarTerminal&) = delete;

  bool IsOpen() const { return master_ >= 0; }
  // Returns the text of the last bar since the last call; "" if none was drawn.
  std::string Bar() {
    std::string text;
    char buffer[4096];
    for (ssize_t n = 0; (n = read(master_, buffer, sizeof buffer)) > 0;)
      text.append(buffer, std::size_t(n));
    const std::string erase = "\r\x1b[K";
    const std::size_t last = text.rfind(erase);
    return last == std::string::npos ? "" : text.substr(last + erase.size());
  }

 private:
  int saved_, master_ = -1;
};

// Returns the bar after 38 s of 76 s on a terminal of this width.
std::string BarOf(int columns) {
  BarTerminal terminal(columns);
  if (!terminal.IsOpen()) return "";
  double now = 1000;
  ProgressReporter progress(ProgressReporter::Mode::Auto, [&now] { return now; });
  progress.Begin("Rendering", 100);
  progress.SetDetails({"12 samples a pixel", "noise \u00b11.8 %"});
  progress.CountRays(95'000'000);
  now += 38;
  progress.SetDone(50);
  return terminal.Bar();
}

TEST(ProgressBar, ShowsTimesDetailsAndRays) {
  const std::string bar = BarOf(140);
  if (bar.empty()) GTEST_SKIP() << "the system has no pseudo-terminals";
  EXPECT_EQ(bar, "Rendering: [" + std::string(20, '=') + std::string(20, ' ') +
                     "]  50 % 38.0 s, 38.0 s left, 12 samples a pixel, noise \u00b11.8 %, "
                     "2.5 M rays/s");
}

TEST(ProgressBar, LosesTheLeastImportantPartsInNarrowTerminals) {
  if (BarOf(140).empty()) GTEST_SKIP() << "the system has no pseudo-terminals";
  const std::string parts[] = {"50 %",  "left",  "Rendering: ", "[", "12 samples a pixel",
                               "noise", "rays/s"};
  std::size_t before = 0;
  for (int columns = 8; columns < 150; ++columns) {
    const std::string bar = BarOf(columns);
    EXPECT_LT(Characters(bar), columns) << bar;
    std::size_t shown = 0;
    while (shown < std::size(parts) && bar.find(parts[shown]) != std::string::npos) ++shown;
    for (std::size_t i = shown; i < std::size(parts); ++i)
      EXPECT_EQ(bar.find(parts[i]), std::string::npos) << parts[i] << " without another: " << bar;
    EXPECT_GE(shown, std::max<std::size_t>(before, 1)) << bar;
    before = shown;
  }
  EXPECT_EQ(before, std::size(parts));
}

TEST(ProgressBar, PreparationIsExpectedToTakeAFifth) {
  BarTerminal terminal(100);
  if (!terminal.IsOpen()) GTEST_SKIP() << "the system has no pseudo-terminals";
  double now = 0;
  ProgressReporter progress(ProgressReporter::Mode::Auto, [&now] { return now; });
  progress.Begin("Shooting photons", 100);
  now = 1;
  progress.SetDone(5);  // too little for an estimate
  EXPECT_EQ(terminal.Bar().find("left"), std::string::npos);
  now = 10;
  progress.SetDone(50);
  EXPECT_NE(terminal.Bar().find(" 10.0 s, about 2 min 12 s left"), std::string::npos);
  progress.End();
  progress.Begin("Rendering", 100);
  now = 11;
  progress.SetDone(1);
  EXPECT_NE(terminal.Bar().find(", 1 min 39 s left"), std::string::npos);
  progress.SetRough(true);
  now = 12;
  progress.SetDone(2);
  EXPECT_NE(terminal.Bar().find(", about 1 min 38 s left"), std::string::npos);
}

TEST(ProgressBar, IsSharedByPicturesOfTheSameTime) {
  BarTerminal terminal(100);
  if (!terminal.IsOpen()) GTEST_SKIP() << "the system has no pseudo-terminals";
  double now = 1000;
  ProgressReporter progress(ProgressReporter::Mode::Auto, [&now] { return now; });
  progress.BeginPicture(0, 2);
  progress.Begin("Shooting photons", 100);
  now += 10;
  progress.End();
  progress.Begin("Rendering", 100);
  now += 10;
  progress.SetDone(25);  // 30 s are left of the first picture, which takes 50 s
  EXPECT_NE(terminal.Bar().find(" 17 % 20.0 s, 1 min 20 s left"), std::string::npos);
  now += 30;
  progress.End();
  progress.BeginPicture(1, 2);
  progress.Begin("Rendering", 100);
  now += 25;
  progress.SetDone(50);
  EXPECT_NE(terminal.Bar().find(" 75 % 1 min 15 s, 25.0 s left"), std::string::npos);
}

TEST(ProgressBar, CountsTheRaysOfAnotherReporter) {
  ProgressReporter passes(ProgressReporter::Mode::Quiet);
  passes.Begin("Rendering", 10);
  passes.CountRays(7);
  EXPECT_EQ(passes.TakeRays(), 7u);
  EXPECT_EQ(passes.TakeRays(), 0u);
  passes.SetDone(4);
  EXPECT_TRUE(passes.Done().isRendering);
  EXPECT_NEAR(passes.Done().ofPhase, .4, 1e-12);
}

}  // namespace
}  // namespace exphoton
