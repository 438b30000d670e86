// SPDX-License-Identifier: BSD-2-Clause
// soak is the long run over random scenes. Seeds are consecutive, from a given one or from the
// clock. Failing scenes are shrunk and written to a folder. The exit status is 1 if a scene failed
// and 2 if the command line is wrong.
#include <charconv>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include "tests/random/scenes/run.h"

namespace exphoton::random_scenes {
namespace {

using Clock = std::chrono::steady_clock;

struct Options {
  double hours = 0;
  std::uint64_t seed = 0;  // 0: from the clock
  int scenes = 0;          // 0: until the time is over
  int agreementEvery = 10;
  bool onlyAgreement = false;
  int shrinkTries = RunSettings{}.maxStatisticalTries;
  std::string folder = "failed-scenes";
};

constexpr const char* kUsage =
    "usage: soak HOURS | --scenes K [--seed N] [--agreement-every M] [--only agreement] "
    "[--shrink TRIES] [--folder PATH]";

// Converts the whole text to a number of type T.
template <class T>
T ParseNumber(const std::string& text) {
  T value{};
  const char* const end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, value);
  if (result.ec != std::errc() || result.ptr != end)
    throw std::invalid_argument("\"" + text + "\" is no number that fits here\n" + kUsage);
  return value;
}

Options Parse(int count, char** words) {
  Options options;
  for (int i = 1; i < count; ++i) {
    const std::string word = words[i];
    const auto value = [&] {
      if (++i >= count) throw std::invalid_argument(word + " needs a value\n" + kUsage);
      return std::string(words[i]);
    };
    if (word == "--seed")
      options.seed = ParseNumber<std::uint64_t>(value());
    else if (word == "--scenes")
      options.scenes = ParseNumber<int>(value());
    else if (word == "--agreement-every")
      options.agreementEvery = ParseNumber<int>(value());
    else if (word == "--only" && i + 1 < count && words[i + 1] == std::string("agreement"))
      options.onlyAgreement = value() == "agreement";
    else if (word == "--shrink")
      options.shrinkTries = ParseNumber<int>(value());
    else if (word == "--folder")
      options.folder = value();
    else if (word.starts_with("-"))
      throw std::invalid_argument("there is no option \"" + word + "\"\n" + kUsage);
    else
      options.hours = ParseNumber<double>(word);
  }
  if (!(options.hours > 0) && options.scenes <= 0) throw std::invalid_argument(kUsage);
  if (options.seed == 0)
    options.seed =
        std::uint64_t(std::chrono::system_clock::now().time_since_epoch().count() / 1'000'000'000) *
        100'000;
  return options;
}

void Write(const Failure& failure, const std::string& folder) {
  std::filesystem::create_directories(folder);
  const std::string name =
      folder + "/" + failure.property + "-" + std::to_string(failure.seed) + ".pbrt";
  std::ofstream(name) << "# " << failure.property << ", seed " << failure.seed << "\n# "
                      << failure.detail << "\n"
                      << failure.text;
  std::printf("FAILED %s, seed %llu: %s\n  %s\n", failure.property.c_str(),
              static_cast<unsigned long long>(failure.seed), failure.detail.c_str(), name.c_str());
}

int RunSoak(const Options& options) {
  constexpr int kBatch = 100;  // scenes between two evaluations of the comparisons
  const auto end = Clock::now() + std::chrono::duration<double>(options.hours * 3600);
  std::printf("seeds from %llu\n", static_cast<unsigned long long>(options.seed));
  SceneRun run({.maxStatisticalTries = options.shrinkTries});
  std::size_t written = 0, named = 0;
  const auto report = [&] {
    run.JudgeComparisons();
    for (; written < run.Failures().size(); ++written)
      Write(run.Failures()[written], options.folder);
    for (; named < run.Blurred().size(); ++named)
      std::printf("blur, seed %llu: %s\n",
                  static_cast<unsigned long long>(run.Blurred()[named].seed),
                  run.Blurred()[named].detail.c_str());
  };
  int done = 0;
  while (options.scenes > 0 ? done < options.scenes : Clock::now() < end) {
    const std::uint64_t seed = options.seed + std::uint64_t(done);
    if (!options.onlyAgreement) {
      run.CheckInvariances(seed);
      run.CompareEnergy(seed);
    }
    if (options.agreementEvery > 0 && done % options.agreementEvery == 0)
      run.CompareAgreement(seed);
    if (++done % kBatch != 0) continue;
    report();
    std::printf("%d scenes, %zu failures\n", done, run.Failures().size());
    std::fflush(stdout);
  }
  report();
  std::printf("%s", run.Summary().c_str());
  std::printf("one scene again: ./dev soak --seed N --scenes 1\n");
  return run.Failures().empty() ? 0 : 1;
}

}  // namespace
}  // namespace exphoton::random_scenes

int main(int count, char** words) {
  try {
    return exphoton::random_scenes::RunSoak(exphoton::random_scenes::Parse(count, words));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "soak: %s\n", error.what());
    return 2;
  }
}
