// SPDX-License-Identifier: BSD-2-Clause
// FirstHour types the commands of "A first hour" in docs/guide/getting-started.md on a terminal of
// 100 columns. The page must show the output of the program. Times, shares and the digits of the
// study's answer may differ.
#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <regex>
#include <sstream>
#include <thread>

#include "core/base/terminal.h"
#include "tests/cli/program.h"

namespace exphoton {
namespace {

const std::string kPage = EXPHOTON_SOURCE_DIR "/docs/guide/getting-started.md";

// Returns the text between two marks that follow a heading.
std::string Between(const std::string& text, const std::string& heading, const std::string& from,
                    const std::string& to) {
  const std::size_t section = text.find(heading);
  const std::size_t begin = text.find(from, section);
  const std::size_t end = text.find(to, begin + from.size());
  if (section == std::string::npos || begin == std::string::npos || end == std::string::npos)
    return "";
  return text.substr(begin + from.size(), end - begin - from.size());
}

// One command of the page and the lines below it.
struct Step {
  std::string command, output;
  bool isInterrupted = false;  // the lines have a ^C
};

std::vector<Step> Steps(const std::string& transcript) {
  std::vector<Step> steps;
  std::istringstream lines(transcript);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("$ "))
      steps.push_back({line.substr(2), "", false});
    else if (line == "^C")
      steps.back().isInterrupted = true;
    else if (!steps.empty())
      steps.back().output += line + '\n';
  }
  return steps;
}

// Returns what stays on the terminal: a bar is erased, and its phase may leave a line with its
// time, which depends on the machine.
std::string Visible(const std::string& output) {
  std::string text;
  std::istringstream lines(output);
  const std::string erase = "\r\x1b[K";
  for (std::string line; std::getline(lines, line);) {
    while (!line.empty() && line.back() == '\r') line.pop_back();
    const std::size_t last = line.rfind(erase);
    if (last != std::string::npos) line = line.substr(last + erase.size());
    static const std::regex phase("^(Rendering|Shooting|Building|Computing)[^:]*: .*");
    if (!std::regex_match(line, phase)) text += line + '\n';
  }
  return text;
}

// A value and its error have the same decimals, and the error has one digit that is not 0.
constexpr const char* kTimesAsEfficient =
    "([0-9]+ ± [1-9]0*|[0-9]+\\.[0-9] ± 0\\.[1-9]|[0-9]+\\.[0-9]{2} ± 0\\.0[1-9]|"
    "[0-9]+\\.[0-9]{3} ± 0\\.00[1-9]) times as efficient";

// Replaces numbers that differ from run to run. The line of times below a study's answer goes.
std::string Normalized(std::string text) {
  for (const auto& [pattern, instead] :
       {std::pair("[0-9]+(\\.[0-9]+)? (s|min|h)\\b", "T s"), std::pair("[0-9]+ %", "N %"),
        std::pair(", about T s left", ""), std::pair(kTimesAsEfficient, "N times as efficient"),
        std::pair("\n(At noise|At relMSE|Least errors)[^\n]*", "")})
    text = std::regex_replace(text, std::regex(pattern), instead);
  while (text.ends_with("\n\n")) text.pop_back();
  return text;
}

class FirstHour : public ProgramTest {
 protected:
  std::string Type(const Step& step) {
    ProcessCommand command;
    const std::string line =
        "stty cols 100; echo $$ > pid; exec " EXPHOTON_BINARY_DIR "/bin/" + step.command;
    command.words = {"script", "-qec", line, "/dev/null"};
    command.environment = {"TERM=xterm", "NO_COLOR=1"};
    command.folder = Path("");
    unlink(Path(".stdout").c_str());  // of the step before
    const pid_t process = StartProcess(command);
    if (step.isInterrupted) Interrupt();
    return WaitForProcess(process, Path(""), 300).out;
  }

 private:
  // Sends what Ctrl-C sends, as soon as pixels are rendered.
  void Interrupt() const {
    for (int i = 0; i < 3000; ++i) {
      if (Read(".stdout").find("Rendering: [") != std::string::npos) break;
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    kill(pid_t(std::atoi(Read("pid").c_str())), SIGINT);
  }
};

TEST_F(FirstHour, ThePageShowsWhatTheProgramPrints) {
  const std::string page = ReadFile(kPage);
  Write("ball.pbrt", Between(page, "## Write a scene", "```\n", "```"));
  const std::vector<Step> steps = Steps(Between(page, "## A first hour", "```console\n", "```"));
  ASSERT_GE(steps.size(), 8u);
  std::string printed;
  for (const Step& step : steps) {
    const std::string output = Visible(Type(step));
    EXPECT_EQ(Normalized(output), Normalized(step.output)) << step.command;
    printed += "$ " + step.command + '\n' + output;
    std::istringstream lines(output);
    for (std::string line; std::getline(lines, line);) EXPECT_LE(Characters(line), 100) << line;
  }
  if (HasFailure()) std::printf("The program prints:\n%s", printed.c_str());
  for (const char* name : {"ball.exr", "ball.png", "study/report.html"})
    EXPECT_TRUE(Exists(name)) << name;
  for (const char* name : {"ball.exr.state", "ball.partial.exr"})
    EXPECT_FALSE(Exists(name)) << name;
}

}  // namespace
}  // namespace exphoton
