// SPDX-License-Identifier: BSD-2-Clause
// StudyRunner runs one render at a time. The picture is moved into place before its row is written.
// A row thus always has a picture, and a picture without a row is rendered again.
#include "core/app/study/study_runner.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>

#include "core/app/output/output_files.h"
#include "core/app/process/child_process.h"
#include "core/app/process/signals.h"
#include "core/app/study/study_tasks.h"
#include "core/base/error.h"
#include "core/base/format.h"

namespace exphoton::cli {
namespace {

namespace fs = std::filesystem;

std::string Duration(double seconds) {
  char text[64];
  if (seconds < 100)
    std::snprintf(text, sizeof text, "%.0f s", std::max(seconds, 1.));
  else if (seconds < 6000)
    std::snprintf(text, sizeof text, "%.0f min", seconds / 60);
  else
    std::snprintf(text, sizeof text, "%.1f h", seconds / 3600);
  return text;
}

void Rename(const std::string& from, const std::string& to) {
  std::error_code error;
  fs::rename(from, to, error);
  if (error) throw Error(ExitStatus::File, "cannot write \"" + to + "\": " + error.message());
}

// Forecast keeps the mean seconds of each setting's runs, to estimate the remaining time.
class Forecast {
 public:
  void Add(std::size_t setting, double seconds) {
    auto& entry = means_[setting];
    entry.first += seconds;
    ++entry.second;
    total_ += seconds;
    ++count_;
  }
  // Returns the mean over all runs for a setting without runs.
  double Of(std::size_t setting) const {
    const auto found = means_.find(setting);
    if (found != means_.end()) return found->second.first / found->second.second;
    return count_ > 0 ? total_ / count_ : 0;
  }

 private:
  std::map<std::size_t, std::pair<double, int>> means_;
  double total_ = 0;
  int count_ = 0;
};

}  // namespace

void Say(const StudyOptions& options, const std::string& text) {
  if (!options.isQuiet) std::fprintf(stderr, "%s\n", text.c_str());
}

void StudyRunner::ShowWarnings(const study::RunRow& row) {
  for (const std::string& warning : warnings_.Add(row.warnings))
    std::fprintf(stderr, "%s\n", warning.c_str());
}

RenderedPicture StudyRunner::Render(const std::vector<std::string>& arguments) {
  const std::string statistics = folder_.Running("render.json");
  RenderedPicture result{{}, folder_.Running("render.exr")};
  std::vector<std::string> all = arguments;
  all.insert(all.end(),
             {"--quiet", "--no-progress", "--stats-json", statistics, "-o", result.path});
  if (!options_.limits.empty()) all.insert(all.end(), {"--limits", options_.limits});
  if (StopFlag()) throw StudyInterrupted();
  const ChildResult child = RunSelf(all, folder_.Running("render.log"), StopFlag());
  if (child.wasInterrupted || StopFlag()) {
    folder_.RemoveRunning();
    throw StudyInterrupted();
  }
  if (child.status != 0) {
    folder_.RemoveRunning();
    throw Error(child.status < 6 ? ExitStatus(child.status) : ExitStatus::Internal,
                "a render of the study failed (status " + std::to_string(child.status) +
                    "): " + CommandText(arguments) + "\n" + child.messages);
  }
  study::AddRunStatistics(ReadTextFile(statistics), &result.row);
  result.row.wallSeconds = child.wallSeconds;
  result.row.cpuSeconds = child.cpuSeconds;
  result.row.peakMemory = child.peakMemory;
  result.row.command = CommandText(arguments);
  result.row.warnings = WarningsIn(child.messages);
  ShowWarnings(result.row);
  std::error_code ignored;
  fs::remove(statistics, ignored);
  return result;
}

study::RunRow StudyRunner::RunOne(const study::Setting& setting, std::uint64_t seed,
                                  const std::vector<std::string>& extra) {
  std::vector<std::string> arguments = RunArguments(options_, setting, seed);
  arguments.insert(arguments.end(), extra.begin(), extra.end());
  return RunAs(RunFileName(setting, seed) + (extra.empty() ? "" : "_maps"), arguments, seed);
}

study::RunRow StudyRunner::RunAs(const std::string& name, const std::vector<std::string>& arguments,
                                 std::uint64_t seed) {
  study::RunRow row;
  wasFound_ = finished_.Find(folder_.Path(), name, arguments, &row);
  if (wasFound_) {
    ShowWarnings(row);
    return row;
  }
  const std::string task = finished_.FindInTasks(name, arguments, &row);
  wasFound_ = !task.empty();
  if (wasFound_) {
    ShowWarnings(row);
    folder_.Take(task + "/" + name + ".exr", name + ".exr");
  } else {
    const RenderedPicture picture = Render(arguments);
    row = picture.row;
    row.key = finished_.Key(arguments, finished_.Processor());
    row.seed = seed;
    row.image = name + ".exr";
    if (options_.task) {
      row.node = NodeName();
      row.processor = finished_.Processor();
      row.isAlone = options_.isAlone;
    }
    Rename(picture.path, folder_.Claim(name + ".exr"));
  }
  WriteTextFile(folder_.Claim(name + ".json"), study::RowToJson(row));
  return row;
}

std::vector<study::RunRow> StudyRunner::RunAll(const std::vector<study::Setting>& settings) {
  std::vector<StudyRun> todo = RunsOfStudy(settings.size(), options_.seeds);
  if (options_.task) {
    std::size_t index = 0;
    std::erase_if(todo, [&](const StudyRun&) {
      return StudyTask::Of(index++, options_.task->count) != options_.task->index;
    });
  }
  std::vector<study::RunRow> rows;
  Forecast forecast;
  int found = 0;
  for (std::size_t i = 0; i < todo.size(); ++i) {
    const study::Setting& setting = settings[todo[i].setting];
    study::RunRow row = RunOne(setting, todo[i].seed);
    row.setting = todo[i].setting;
    forecast.Add(row.setting, row.wallSeconds);
    rows.push_back(row);
    found += int(wasFound_);
    if (wasFound_) continue;
    double left = 0;
    for (std::size_t j = i + 1; j < todo.size(); ++j) left += forecast.Of(todo[j].setting);
    char text[512];
    std::snprintf(text, sizeof text, "[%zu/%zu] %s, %s, seed %llu: %.2f s%s", i + 1, todo.size(),
                  setting.label.c_str(), setting.Text().c_str(),
                  static_cast<unsigned long long>(row.seed), row.wallSeconds,
                  left > 0 ? (", about " + Duration(left) + " left").c_str() : "");
    Say(options_, text);
  }
  if (found > 0) Say(options_, Counted(found, "render") + " existed already");
  return rows;
}

}  // namespace exphoton::cli
