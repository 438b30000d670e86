// SPDX-License-Identifier: BSD-2-Clause
// CommandOutputs: a line of commands.txt that begins with "$ " is a command. One with "% " is a
// command for which time is a count (clock/counted_clock.cpp), so its times are compared, too; its
// option --nthreads 1 makes the count the same in each run. Its first word may be "^n": Ctrl-C at
// the n-th reading of the clock. One with "> " names a file that holds the following lines (one
// with "= ": their hexadecimal digits as bytes), and one with "? " names a text file to print. The
// line "@ FOLDER" gives the runs of a study fixed times, so that its page can be made again and
// compared. Words of a command that contain blanks are in quotes.
#include "tests/recorded/command_outputs.h"

#include <filesystem>
#include <iomanip>
#include <regex>
#include <sstream>

#include "core/app/analysis/results.h"
#include "tests/recorded/scene_list.h"
#include "tests/support/process.h"

namespace exphoton::recorded {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> Lines(const std::string& text, const std::string& prefix) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    while (!line.empty() && (line.back() == ' ' || line.back() == '\r')) line.pop_back();
    lines.push_back(prefix + line);
  }
  return lines;
}

// Replaces each part that begins with `begin` and ends before `end`.
std::string WithoutParts(std::string text, const std::string& begin, const std::string& end) {
  for (std::size_t at = 0; (at = text.find(begin, at)) != std::string::npos;) {
    at += begin.size();
    text.erase(at, text.find(end, at) - at);
  }
  return text;
}

// Leaves out numbers of a table or a record of statistics that differ from run to run.
std::string WithoutMeasuredNumbers(std::string line) {
  if (line.find("econds\":") != std::string::npos) {
    static const std::regex json(
        R"re("(\w*[sS]econds|threads|peakMemoryBytes|memory/peak)":[0-9.e+-]+)re");
    line = std::regex_replace(line, json, "\"$1\":#");
  }
  static const std::regex phase(R"( *TIME +TIME +[0-9.]+ %)"), rate(R"([0-9][0-9,.]* per second)"),
      memory(R"(^(memory/peak|threads) +[0-9].*)");
  if (line.find("TIME ") != std::string::npos) line = std::regex_replace(line, phase, " TIME");
  if (line.find(" per second") != std::string::npos)
    line = std::regex_replace(line, rate, "# per second");
  return std::regex_replace(line, memory, "$1 #");
}

// Measured times are left out, fixed and counted ones are compared.
enum class Times { Measured, Fixed, Counted };

// Some commands use all cores.
std::string WithoutThreads(const std::string& line) {
  return line.starts_with("threads ") ? "threads #" : line;
}

// Leaves out what differs from build to build and from run to run, embedded pictures and style
// sheets. Times are fixed in what "report" prints, and in nothing else.
std::string Normalized(std::string text, const std::string& folder, Times times) {
  const bool hasTimes = times == Times::Measured;
  for (const std::string& path : {folder + "/", std::string(EXPHOTON_BINARY_DIR "/bin/"),
                                  std::string(EXPHOTON_BINARY_DIR "/")})
    for (std::size_t at; (at = text.find(path)) != std::string::npos;) text.erase(at, path.size());
  text = WithoutParts(std::move(text), "data:image/png;base64,", "\"");
  text = WithoutParts(std::move(text), "<style>", "</style>");
  static const std::regex version(R"(exphoton \d+\.\d+\.\d+)"),
      seconds(R"(\b[0-9.e+-]+ (s|min|h)\b)"),
      headline(R"(^(On [^,]+,|At relMSE |At noise |Least errors:).*)");  // compares times
  std::istringstream lines(text);
  std::string normalized;
  for (std::string line; std::getline(lines, line);) {
    line = std::regex_replace(line, version, "exphoton VERSION");
    if (hasTimes && std::regex_match(line, headline)) continue;
    if (hasTimes) line = std::regex_replace(line, seconds, "TIME");
    normalized +=
        (times == Times::Counted ? WithoutThreads(line) : WithoutMeasuredNumbers(line)) + "\n";
  }
  return normalized;
}

void FixTimes(study::NamedValues* values, double from) {
  for (auto& value : *values) value.second = from += .125;
}

// Replaces times, memory, keys and names of files in the results of a study.
void FixStudy(const std::string& folder) {
  const std::string path = folder + "/results.json";
  study::Results results = study::FromJson(ReadFile(path));
  results.program = "exphoton VERSION";
  results.fingerprint = results.processor = results.system = "";
  results.command = "exphoton study";
  results.cores = 1;
  results.reference.seconds = 10;
  double number = 0;
  for (study::RunRow& row : results.runs) {
    ++number;
    const std::string name = "images/run" + std::to_string(int(number)) + ".exr";
    fs::copy_file(study::PathOf(folder, row.image), folder + "/" + name);
    row.key = "run" + std::to_string(int(number));
    row.image = name;
    row.wallSeconds = 2 + number / 4 + double(row.setting);
    row.cpuSeconds = 1 + number / 8 + 2 * double(row.setting);
    row.peakMemory = 1e6 * number;
    FixTimes(&row.phases, number);
    FixTimes(&row.phaseWall, number + .5);
    std::erase_if(row.counters, [](const auto& counter) {
      return counter.first.find("memory") != std::string::npos;
    });
  }
  for (study::LowerBound& bound : results.lowerBounds) {
    ++number;
    const std::string integrator = results.settings[bound.setting].integrator;
    bound.setting = 0;  // the measured choice depends on times
    while (results.settings[bound.setting].integrator != integrator) ++bound.setting;
    bound.cpuSeconds = number / 16, bound.wallSeconds = number / 8;
    bound.command = "";
  }
  WriteFile(path, study::ToJson(results));
}

// Returns the bytes of pairs of hexadecimal digits, without the ends of lines.
std::string Bytes(std::string digits) {
  std::erase(digits, '\n');
  std::string bytes;
  for (std::size_t i = 0; i + 1 < digits.size(); i += 2)
    bytes += char(std::stoi(digits.substr(i, 2), nullptr, 16));
  return bytes;
}

class CommandRunner {
 public:
  explicit CommandRunner(std::function<bool(const CommandOutput&)> goesOn)
      : goesOn_(std::move(goesOn)) {}

  std::vector<CommandOutput> Run() {
    std::string file, content;
    bool isBinary = false;
    for (const std::string& line : LinesOf("commands.txt")) {
      if (isStopped_) break;
      const std::string rest = line.size() > 2 ? line.substr(2) : "";
      if (line.size() > 2 && line[1] == ' ' && std::string(">=$%?@").find(line[0]) < 6) {
        if (!file.empty()) WriteInFolder(file, isBinary ? Bytes(content) : content);
        file.clear();
        content.clear();
      }
      isBinary = line.starts_with("= ") || (isBinary && !file.empty());
      if (line.starts_with("> ") || line.starts_with("= "))
        file = rest;
      else if (line.starts_with("$ ") || line.starts_with("% "))
        RunCommand(rest, line[0] == '%');
      else if (line.starts_with("? "))
        Add(line,
            Lines(Normalized(ReadFile(folder_.File(rest)), folder_.Path(), Times::Fixed), ""));
      else if (line.starts_with("@ "))
        FixStudy(folder_.File(rest));
      else
        content += line + "\n";
    }
    return std::move(outputs_);
  }

 private:
  void WriteInFolder(const std::string& name, const std::string& content) const {
    const std::string path = folder_.File(name);
    fs::create_directories(fs::path(path).parent_path());
    WriteFile(path, content);
  }
  void RunCommand(const std::string& command, bool countsTime) {
    ProcessCommand process;
#ifdef COUNTED_CLOCK
    if (countsTime) process.environment = {"LD_PRELOAD=" COUNTED_CLOCK};
#endif
    process.words = {EXPHOTON_BINARY_DIR "/bin/exphoton"};
    std::istringstream words(command);
    for (std::string word; words >> std::quoted(word);) {
      if (countsTime && word[0] == '^')
        process.environment.push_back("COUNTED_INTERRUPT=" + word.substr(1));
      else
        process.words.push_back(word);
    }
    process.folder = folder_.Path();
    const ProcessResult result = RunProcess(process);
    std::vector<std::string> lines;
    const Times times = countsTime                       ? Times::Counted
                        : command.starts_with("report ") ? Times::Fixed
                                                         : Times::Measured;
    const auto add = [&](const std::string& text, const std::string& prefix) {
      for (const std::string& line : Lines(Normalized(text, folder_.Path(), times), prefix))
        lines.push_back(line);
    };
    add(result.out, "");
    add(result.err, "! ");
    if (result.status != 0) lines.push_back("status " + std::to_string(result.status));
    Add((countsTime ? "% " : "$ ") + command, std::move(lines));
  }
  void Add(const std::string& command, std::vector<std::string> lines) {
    outputs_.push_back({command, std::move(lines)});
    isStopped_ = goesOn_ && !goesOn_(outputs_.back());
  }

  TestFolder folder_;
  std::function<bool(const CommandOutput&)> goesOn_;
  std::vector<CommandOutput> outputs_;
  bool isStopped_ = false;
};

}  // namespace

std::vector<CommandOutput> CommandOutputs(const std::function<bool(const CommandOutput&)>& goesOn) {
  return CommandRunner(goesOn).Run();
}

std::string OutputsPath() {
  return std::string(EXPHOTON_SOURCE_DIR) + "/tests/recorded/records/outputs.txt";
}

// A line of output begins with a blank, a command does not.
std::string OutputsText(const std::vector<CommandOutput>& outputs) {
  std::string text = "# Written by ./dev test --record; see docs/development/testing.md.\n";
  for (const CommandOutput& output : outputs) {
    text += output.command + "\n";
    for (const std::string& line : output.lines) text += " " + line + "\n";
  }
  return text;
}

std::vector<CommandOutput> ReadOutputs() {
  std::vector<CommandOutput> outputs;
  std::istringstream file(ReadFile(OutputsPath()));
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("#")) continue;
    if (!line.starts_with(" "))
      outputs.push_back({line, {}});
    else if (!outputs.empty())
      outputs.back().lines.push_back(line.substr(1));
  }
  return outputs;
}

}  // namespace exphoton::recorded
