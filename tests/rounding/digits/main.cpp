// SPDX-License-Identifier: BSD-2-Clause
// digits measures the digits that rounding costs in each hard case and each scene: it renders each
// with 16 sequences of directions of rounding and compares the pictures (a build with
// EXPHOTON_STOCHASTIC). Exit status: 0 all are within the limits, 1 some are not, 2 wrong usage.
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <exception>
#include <fstream>
#include <stdexcept>
#include <string>

#include "tests/rounding/measure/census.h"
#include "tests/rounding/measure/precisions.h"
#include "tests/rounding/measure/results.h"
#include "tests/rounding/measure/subjects.h"
#include "tests/rounding/runtime/rounding.h"

namespace exphoton::rounding {
namespace {

constexpr const char* kUsage =
    "usage: digits [--only TEXT] [--roundings N] [--key N] [--jobs N] [--write-limits] [--page "
    "FILE.md]\n"
    "              [--census N] [--pictures FILE] [--compare FLOAT DOUBLE]\n"
    "  --only TEXT      cases and scenes whose name begins with the text\n"
    "  --roundings N    pictures of each scene (16)\n"
    "  --jobs N         processes (2)\n"
    "  --key N          key of the first sequence of directions (1)\n"
    "  --write-limits   makes tests/rounding/limits.txt of this run, instead of the comparison\n"
    "  --census N       instead: the N lines with the most cancellations\n"
    "  --page FILE.md   writes the tables into the page\n"
    "  --lines FILE     takes what an earlier run has printed, and measures the others\n"
    "  --pictures FILE  instead: writes pictures, rounded to nearest and at random (--roundings)\n"
    "  --compare FLOAT DOUBLE   instead: compares such files of a build in float and one in "
    "double\n";

struct Options {
  std::string only, page, lines, pictures, inFloat, inDouble;
  int roundings = 16;
  std::size_t jobs = 2;
  std::size_t censusLines = 0;  // 0: no census
  std::uint64_t key = 1;
  bool writesLimits = false;
};

Options OptionsFrom(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const auto value = [&]() -> std::string {
      if (i + 1 >= argc) throw std::invalid_argument(word + " needs a value");
      return argv[++i];
    };
    if (word == "--only")
      options.only = value();
    else if (word == "--roundings")
      options.roundings = std::stoi(value());
    else if (word == "--key")
      options.key = std::stoull(value());
    else if (word == "--write-limits")
      options.writesLimits = true;
    else if (word == "--jobs")
      options.jobs = std::max(std::stoul(value()), 1ul);
    else if (word == "--census")
      options.censusLines = std::stoul(value());
    else if (word == "--page")
      options.page = value();
    else if (word == "--lines")
      options.lines = value();
    else if (word == "--pictures")
      options.pictures = value();
    else if (word == "--compare")
      options.inFloat = value(), options.inDouble = value();
    else
      throw std::invalid_argument("unknown option " + word + "\n" + kUsage);
  }
  const int least = options.pictures.empty() ? 2 : 0;
  if (options.roundings < least || options.key == 0) throw std::invalid_argument(kUsage);
  return options;
}

Spread Measure(const Subject& subject, const Options& options) {
  const auto renders = RenderSubject(subject, options.roundings,
                                     [&](int i) { RoundAtRandom(options.key + std::uint64_t(i)); });
  RoundAtRandom(0);
  std::vector<Image> pictures;
  for (const TestRender& render : renders) pictures.push_back(render.image);
  return SpreadOf(pictures);
}

Subjects ReadSubjects(const Options& options) {
  Subjects subjects = ReadHardCases();
  for (Subject& scene : ReadScenes()) subjects.all.push_back(std::move(scene));
  std::erase_if(subjects.all,
                [&](const Subject& each) { return !NameOf(each).starts_with(options.only); });
  return subjects;
}

int TakeCensus(const Options& options) {
  CountCancellations(true);
  for (const Subject& subject : ReadSubjects(options).all) RenderSubject(subject, 1, [](int) {});
  CountCancellations(false);
  std::fputs(TextOf(ByLine(TakeCancellations()), options.censusLines).c_str(), stdout);
  return 0;
}

// Appends the pictures of a subject to the file.
void WritePicturesOf(const Subject& subject, const Options& options) {
  std::ofstream file(options.pictures, std::ios::app);
  ScenePictures scene{NameOf(subject), {}};
  try {
    const auto renders = RenderSubject(subject, 1 + options.roundings, [&](int i) {
      RoundAtRandom(i == 0 ? 0 : options.key + std::uint64_t(i) - 1);
    });
    for (const TestRender& render : renders) scene.pictures.push_back(render.values);
    Write(scene, file);
  } catch (const std::exception& error) {
    std::printf("%s is left out: %s\n", scene.name.c_str(), error.what());
    std::fflush(stdout);
  }
  if (!file.flush()) throw std::runtime_error(options.pictures + " cannot be written");
}

// Returns whether this is the new process. Throws if there is none.
bool IsNewProcess() {
  const pid_t process = fork();
  if (process < 0) throw std::runtime_error(std::string("no new process: ") + std::strerror(errno));
  return process == 0;
}

// Each subject has a process of its own, as in MeasureAll.
int WritePictures(const Options& options) {
  std::ofstream(options.pictures).close();
  for (const Subject& subject : ReadSubjects(options).all) {
    if (IsNewProcess()) {
      WritePicturesOf(subject, options);
      _exit(0);
    }
    int status = 0;
    wait(&status);
    if (status != 0) throw std::runtime_error(NameOf(subject) + " has no pictures");
  }
  return 0;
}

int ComparePictures(const Options& options) {
  std::ifstream inFloat(options.inFloat), inDouble(options.inDouble);
  if (!inFloat || !inDouble) throw std::runtime_error("a file to compare is missing");
  std::fputs(TextOf(ComparePrecisions(ReadPictures(inFloat), ReadPictures(inDouble))).c_str(),
             stdout);
  return 0;
}

std::string LimitsPath() { return std::string(EXPHOTON_SOURCE_DIR) + "/tests/rounding/limits.txt"; }

// What a process says about a subject. `error` is empty if it was measured.
struct Measured {
  Spread spread;
  double seconds;
  bool isDone;
  char error[200];
};

// Operations that round differently can make a scene invalid, for example by transformations at
// both times of a light that are no longer equal.
Measured MeasureOrFail(const Subject& subject, const Options& options) {
  const std::clock_t start = std::clock();
  RoundAtRandom(0);
  Measured measured{};
  try {
    measured.spread = Measure(subject, options);
    measured.seconds = double(std::clock() - start) / CLOCKS_PER_SEC;
    std::puts(LineOf({subject, measured.spread, measured.seconds}).c_str());
  } catch (const std::exception& error) {
    std::snprintf(measured.error, sizeof measured.error, "%s", error.what());
    std::printf("%s: %s\n", NameOf(subject).c_str(), measured.error);
  }
  std::fflush(stdout);
  measured.isDone = true;
  return measured;
}

// Measures the subjects in several processes. Subjects that fail are left out.
std::vector<Result> MeasureAll(Subjects* subjects, const Options& options) {
  const std::vector<Subject>& all = subjects->all;
  const std::size_t bytes = sizeof(Measured) * std::max(all.size(), std::size_t(1));
  void* const memory =
      mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) throw std::runtime_error("no memory");
  Measured* const measured = static_cast<Measured*>(memory);
  if (!options.lines.empty()) {
    std::ifstream file(options.lines);
    EarlierLines earlier(file);
    for (std::size_t i = 0; i < all.size(); ++i)
      if (const auto spread = earlier.Take(all[i])) measured[i] = {*spread, 0, true, ""};
  }
  // Each subject has a process of its own. Tables that are made on first use would otherwise hold
  // the roundings of an earlier subject.
  std::size_t running = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (measured[i].isDone) continue;
    if (running == options.jobs) wait(nullptr), --running;
    ++running;
    if (!IsNewProcess()) continue;
    measured[i] = MeasureOrFail(all[i], options);
    _exit(0);
  }
  while (wait(nullptr) > 0) {
  }
  std::vector<Result> results;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!measured[i].isDone) throw std::runtime_error(NameOf(all[i]) + " was not measured");
    if (*measured[i].error)
      subjects->leftOut.push_back(
          {NameOf(all[i]), std::string("fails (\"") + measured[i].error + "\")"});
    else
      results.push_back({all[i], measured[i].spread, measured[i].seconds});
  }
  munmap(memory, bytes);
  return results;
}

int Run(const Options& options) {
  if (options.censusLines > 0) return TakeCensus(options);
  if (!options.pictures.empty()) return WritePictures(options);
  if (!options.inFloat.empty()) return ComparePictures(options);
  Subjects subjects = ReadSubjects(options);
  const std::vector<Result> results = MeasureAll(&subjects, options);
  const std::vector<Row> rows = RowsOf(results);
  const std::string path = LimitsPath();
  if (options.writesLimits) std::ofstream(path) << LimitsText(rows);
  const std::vector<Limit> limits = ReadLimits(path);
  if (!options.page.empty()) WriteTables(rows, limits, subjects.leftOut, options.page);
  std::vector<std::string> excesses = Excesses(rows, limits);
  if (options.only.empty())
    for (const std::string& name : NotMeasured(rows, limits))
      excesses.push_back(name + " has a limit, but was not measured");
  for (const std::string& excess : excesses) std::puts(excess.c_str());
  return excesses.empty() ? 0 : 1;
}

}  // namespace
}  // namespace exphoton::rounding

int main(int argc, char** argv) {
  try {
    return exphoton::rounding::Run(exphoton::rounding::OptionsFrom(argc, argv));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "digits: %s\n", error.what());
    return 2;
  }
}
