// SPDX-License-Identifier: BSD-2-Clause
// digits measures the digits that rounding costs in each hard case and each scene: it renders each
// with 16 sequences of directions of rounding and compares the pictures (a build with
// EXPHOTON_STOCHASTIC). Exit status: 0 all are within the limits, 1 some are not, 2 wrong usage.
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <exception>
#include <fstream>
#include <set>
#include <stdexcept>
#include <string>

#include "tests/rounding/measure/census.h"
#include "tests/rounding/measure/results.h"
#include "tests/rounding/measure/subjects.h"
#include "tests/rounding/runtime/rounding.h"

namespace exphoton::rounding {
namespace {

constexpr const char* kUsage =
    "usage: digits [--only TEXT] [--roundings N] [--key N] [--jobs N] [--write-limits] [--page "
    "FILE.md]\n"
    "              [--census N]\n"
    "  --only TEXT      cases and scenes whose name begins with the text\n"
    "  --roundings N    pictures of each scene (16)\n"
    "  --jobs N         processes (2)\n"
    "  --key N          key of the first sequence of directions (1)\n"
    "  --write-limits   makes tests/rounding/limits.txt of this run, instead of the comparison\n"
    "  --census N       instead: the N lines with the most cancellations\n"
    "  --page FILE.md   writes the tables into the page\n";

struct Options {
  std::string only, page;
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
    else
      throw std::invalid_argument("unknown option " + word + "\n" + kUsage);
  }
  if (options.roundings < 2 || options.key == 0) throw std::invalid_argument(kUsage);
  return options;
}

Spread Measure(const Subject& subject, const Options& options) {
  std::vector<Image> pictures;
  for (int i = 0; i < options.roundings; ++i) {
    RoundAtRandom(options.key + std::uint64_t(i));
    pictures.push_back(RenderSubject(subject));
  }
  RoundAtRandom(0);
  return SpreadOf(pictures);
}

std::vector<Subject> ReadSubjects(const Options& options) {
  std::vector<Subject> subjects = ReadHardCases();
  for (Subject& scene : ReadScenes()) subjects.push_back(std::move(scene));
  std::erase_if(subjects,
                [&](const Subject& each) { return !NameOf(each).starts_with(options.only); });
  return subjects;
}

int TakeCensus(const Options& options) {
  CountCancellations(true);
  for (const Subject& subject : ReadSubjects(options)) RenderSubject(subject);
  CountCancellations(false);
  std::fputs(TextOf(ByLine(TakeCancellations()), options.censusLines).c_str(), stdout);
  return 0;
}

std::string LimitsPath() { return std::string(EXPHOTON_SOURCE_DIR) + "/tests/rounding/limits.txt"; }

// Without a name or new limits, cases that have no limit are left out, and the output says so.
void KeepLimited(const Options& options, std::vector<Subject>* subjects) {
  if (!options.only.empty() || options.writesLimits) return;
  std::set<std::string> limited, left;
  for (const Limit& limit : ReadLimits(LimitsPath())) limited.insert(limit.name);
  for (const Subject& subject : *subjects)
    if (!limited.contains(RowNameOf(subject))) left.insert(RowNameOf(subject));
  std::erase_if(*subjects, [&](const Subject& each) { return left.contains(RowNameOf(each)); });
  for (const std::string& name : left) std::printf("%s: no limit, left out\n", name.c_str());
  std::fflush(stdout);
}

// Measures each subject in one of several processes.
std::vector<Result> MeasureAll(const std::vector<Subject>& subjects, const Options& options) {
  struct Measured {
    Spread spread;
    double seconds;
    bool isDone;
  };
  const std::size_t bytes = sizeof(Measured) * std::max(subjects.size(), std::size_t(1));
  void* const memory =
      mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) throw std::runtime_error("no memory");
  Measured* const measured = static_cast<Measured*>(memory);
  for (std::size_t job = 0; job < options.jobs; ++job) {
    if (fork() != 0) continue;
    for (std::size_t i = job; i < subjects.size(); i += options.jobs) {
      const std::clock_t start = std::clock();
      const Spread spread = Measure(subjects[i], options);
      measured[i] = {spread, double(std::clock() - start) / CLOCKS_PER_SEC, true};
      std::puts(LineOf({subjects[i], spread, measured[i].seconds}).c_str());
      std::fflush(stdout);
    }
    _exit(0);
  }
  while (wait(nullptr) > 0) {
  }
  std::vector<Result> results;
  for (std::size_t i = 0; i < subjects.size(); ++i) {
    if (!measured[i].isDone) throw std::runtime_error(NameOf(subjects[i]) + " was not measured");
    results.push_back({subjects[i], measured[i].spread, measured[i].seconds});
  }
  munmap(memory, bytes);
  return results;
}

int Run(const Options& options) {
  if (options.censusLines > 0) return TakeCensus(options);
  std::vector<Subject> subjects = ReadSubjects(options);
  KeepLimited(options, &subjects);
  const std::vector<Result> results = MeasureAll(subjects, options);
  const std::vector<Row> rows = RowsOf(results);
  const std::string path = LimitsPath();
  if (options.writesLimits) std::ofstream(path) << LimitsText(rows);
  const std::vector<Limit> limits = ReadLimits(path);
  if (!options.page.empty()) WriteTables(rows, limits, options.page);
  const std::vector<std::string> excesses = Excesses(rows, limits);
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
