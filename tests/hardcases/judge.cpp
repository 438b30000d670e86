// SPDX-License-Identifier: BSD-2-Clause
// Judge checks every run for its status and for a picture without negative or non-finite values. A
// run that should fail must report an error with its place and keep the older picture.
#include "tests/hardcases/judge.h"

#include <algorithm>
#include <cmath>
#include <regex>

#include "core/imaging/files/exr.h"
#include "tests/hardcases/picture_checks.h"

namespace exphoton::hardcases {
namespace {

#ifndef FAILING_ALLOCATIONS
#define FAILING_ALLOCATIONS ""  // no library to preload in this build
#endif

constexpr const char* kOlder = "older picture";
constexpr int kLeavesOut = 77;  // status of a script, as for CMake's SKIP_RETURN_CODE

std::string LastLine(const std::string& text) {
  std::size_t end = text.find_last_not_of('\n');
  if (end == std::string::npos) return "";
  const std::size_t start = text.rfind('\n', end);
  return text.substr(start == std::string::npos ? 0 : start + 1, end - start);
}

int CountOf(const std::string& text, const std::string& part) {
  int count = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += part.size())
    ++count;
  return count;
}

std::string BadPixel(const Image& image) {
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    if (std::isfinite(image.pixels[i]) && image.pixels[i] >= 0) continue;
    return "value " + std::to_string(image.pixels[i]) + " in pixel " +
           std::to_string(i / std::size_t(image.ChannelCount()));
  }
  return "";
}

}  // namespace

void Judge::Fail(const std::string& where, const std::string& what) {
  verdict_.failures.push_back(where + ": " + what);
}

void Judge::Count(const ProcessResult& outcome) {
  verdict_.seconds += outcome.seconds;
  verdict_.megabytes = std::max(verdict_.megabytes, outcome.megabytes);
}

Verdict Judge::Run() {
  for (const auto& run : asked_.runs)
    if (!run.isSlow || programs_.isFull) RunScene(run);
  for (const auto& script : asked_.scripts) RunScript(script);
  std::string statuses;
  for (const auto& [status, count] : statuses_) {
    statuses += (statuses.empty() ? "status " : ", ") + std::to_string(status);
    if (count > 1) statuses += " x" + std::to_string(count);
  }
  if (!statuses.empty()) verdict_.seen.insert(verdict_.seen.begin(), statuses);
  return verdict_;
}

void Judge::RunScene(const hardcases::Run& run) {
  Pictures& pictures = pictures_[run.name];
  const std::size_t failures = verdict_.failures.size();
  for (int seed = 0; seed < run.seeds; ++seed) {
    const ProcessResult outcome = RunSeed(run, seed, &pictures);
    if (verdict_.failures.size() > failures) return;
    if (seed == 0) CheckMessages(run, outcome);
    pictures.last = outcome;
  }
  ++statuses_[run.status];
  if (run.status == 0) CheckPictures(run);
}

ProcessResult Judge::RunSeed(const hardcases::Run& run, int seed, Pictures* pictures) {
  const TestFolder folder;
  WriteFile(folder.File("scene.pbrt"), run.scene);
  WriteFile(folder.File("out.exr"), kOlder);
  ProcessCommand command;
  command.folder = folder.Path();
  command.timeLimit = run.timeLimit * programs_.patience;
  command.environment = run.environment;
  command.words = {programs_.exphoton,
                   "--float",
                   "--no-progress",
                   "-o",
                   "out.exr",
                   "--seed",
                   std::to_string(programs_.seed + 1000 * std::uint64_t(seed))};
  if (std::find(run.arguments.begin(), run.arguments.end(), "--nthreads") == run.arguments.end())
    command.words.insert(command.words.end(), {"--nthreads", "1"});
  if (run.isStrict) command.words.push_back("--strict");
  command.words.insert(command.words.end(), run.arguments.begin(), run.arguments.end());
  command.words.push_back("scene.pbrt");
  const ProcessResult outcome = RunProcess(command);
  Count(outcome);
  if (outcome.isLate) {
    Fail(run.name, "not done after " + std::to_string(int(command.timeLimit)) + " s");
  } else if (outcome.status != run.status) {
    Fail(run.name, "status " + std::to_string(outcome.status) + " instead of " +
                       std::to_string(run.status) + ": " + LastLine(outcome.err));
  } else if (outcome.megabytes > run.memoryLimit * programs_.patience) {
    Fail(run.name, "took " + std::to_string(int(outcome.megabytes)) + " MB");
  } else {
    CheckFiles(run, outcome, folder, pictures);
  }
  return outcome;
}

void Judge::CheckFiles(const hardcases::Run& run, const ProcessResult& outcome,
                       const TestFolder& folder, Pictures* pictures) {
  if (folder.Names() != std::vector<std::string>{"out.exr", "scene.pbrt"})
    Fail(run.name, "left other files behind");
  if (run.status != 0) return CheckFailure(run, outcome, folder);
  if (ReadFile(folder.File("out.exr")) == kOlder) {  // --check, --explain
    pictures->images.emplace_back();
    return;
  }
  try {
    pictures->images.push_back(ReadExr(folder.File("out.exr")));
    const std::string bad = BadPixel(pictures->images.back());
    if (!bad.empty()) Fail(run.name, bad);
  } catch (const ImageError& error) {
    Fail(run.name, error.what());
  }
}

void Judge::CheckFailure(const hardcases::Run& run, const ProcessResult& outcome,
                         const TestFolder& folder) {
  if (ReadFile(folder.File("out.exr")) != kOlder) Fail(run.name, "the older picture is gone");
  static const std::regex place("(^|\n)[^\n]*scene.pbrt:[0-9]+:[0-9]+: error: ");
  const bool hasError = run.status == 2 ? std::regex_search(outcome.err, place)
                                        : outcome.err.find("error: ") != std::string::npos;
  if (!hasError) Fail(run.name, "no error with its place: " + LastLine(outcome.err));
}

void Judge::CheckMessages(const hardcases::Run& run, const ProcessResult& outcome) {
  for (const Check& check : run.checks) {
    const std::string text = check.arguments.empty() ? "" : check.arguments[0];
    if (check.kind == "says" && outcome.err.find(text) == std::string::npos) {
      Fail(run.name, "does not say \"" + text + "\" but \"" + LastLine(outcome.err) + "\"");
    } else if (check.kind == "silent" && outcome.err.find(text) != std::string::npos) {
      Fail(run.name, "says \"" + text + "\"");
    } else if (check.kind == "warnings") {
      const int count = CountOf(outcome.err, "warning: ");
      if (std::to_string(count) != text)
        Fail(run.name, std::to_string(count) + " warnings instead of " + text + ": " + outcome.err);
    }
  }
}

const Judge::Pictures* Judge::Of(const std::string& where, const std::string& name) {
  const auto found = pictures_.find(name);
  if (found != pictures_.end() && !found->second.images.empty()) return &found->second;
  Fail(where, "there is no picture of \"" + name + "\" to compare with");
  return nullptr;
}

void Judge::CheckPictures(const hardcases::Run& run) {
  const Pictures& pictures = pictures_[run.name];
  PixelBounds region;
  for (const Check& check : run.checks) {
    if (check.kind == "says" || check.kind == "silent" || check.kind == "warnings") continue;
    if (check.kind == "region") {
      region = RegionFrom(check.arguments);
      continue;
    }
    std::span<const Image> others;
    if (NeedsOther(check.kind)) {
      const Pictures* other = Of(run.name, check.arguments.at(0));
      if (!other) continue;
      others = other->images;
    }
    const PictureResult result = CheckPicture(check, pictures.images, others, region);
    if (!result.isRight) Fail(run.name, result.text);
    if (result.falseAlarm) verdict_.falseAlarms.push_back(*result.falseAlarm);
    if (result.isRight && !result.text.empty()) {
      const bool isOnlyRun = asked_.runs.size() == 1;
      verdict_.seen.push_back(isOnlyRun ? result.text : run.name + " " + result.text);
    }
  }
}

void Judge::RunScript(const Script& script) {
  const TestFolder folder;
  ProcessCommand command;
  command.folder = folder.Path();
  command.timeLimit = script.timeLimit * programs_.patience;
  command.environment = {"EXPHOTON=" + programs_.exphoton,
                         "FAILING_ALLOCATIONS=" FAILING_ALLOCATIONS,
                         std::string("FULL=") + (programs_.isFull ? "1" : "")};
  command.words = {"bash", "-e", "-u", "-o", "pipefail", "-c", script.text};
  const ProcessResult outcome = RunProcess(command);
  Count(outcome);
  if (outcome.isLate) {
    Fail(script.name, "not done after " + std::to_string(int(command.timeLimit)) + " s");
  } else if (outcome.status != 0 && outcome.status != kLeavesOut) {
    Fail(script.name, "status " + std::to_string(outcome.status) + ": " + LastLine(outcome.out) +
                          " " + LastLine(outcome.err));
  } else {
    if (outcome.status == kLeavesOut) verdict_.isLeftOut = true;
    const std::string said = LastLine(outcome.out);
    verdict_.seen.push_back(said.empty() ? script.name + " holds" : said);
  }
}

}  // namespace exphoton::hardcases
