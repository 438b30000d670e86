// SPDX-License-Identifier: BSD-2-Clause
// soak is the long run over random scenes. Seeds are consecutive, from a given one or from the
// clock. Failing scenes are shrunk and written to a folder. The exit status is 1 if a scene failed
// and 2 if the command line is wrong. With --until-failure the run ends with the first failure, and
// no scene is shrunk or written. With --counts FILE the run goes on after the seeds of earlier runs
// with this file, and adds its scenes to their number.
#include <charconv>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/random/scenes/counts.h"
#include "tests/random/scenes/run.h"

namespace exphoton::random_scenes {
namespace {

using Clock = std::chrono::steady_clock;

struct Options {
  double hours = 0;
  std::uint64_t seed = 0;   // 0: from the clock
  int scenes = 0;           // 0: until the time is over
  int agreementEvery = 20;  // 0: never
  std::string only;         // a property; empty: all
  bool untilFailure = false;
  int shrinkTries = RunSettings{}.maxStatisticalTries;
  std::string folder = "failed-scenes";
  std::string counts;  // a file; empty: none
};

constexpr const char* kUsage =
    "usage: soak HOURS | --scenes K [--seed N] [--agreement-every M] [--only PROPERTY] "
    "[--shrink TRIES] [--until-failure] [--folder PATH] [--counts FILE]\nproperties: variations, "
    "probes, estimates, energy, pairs, photons, layers, gathers, invariances, sums, furnace, "
    "rooms, agreement";

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
    else if (word == "--only")
      options.only = value();
    else if (word == "--until-failure")
      options.untilFailure = true;
    else if (word == "--shrink")
      options.shrinkTries = ParseNumber<int>(value());
    else if (word == "--folder")
      options.folder = value();
    else if (word == "--counts")
      options.counts = value();
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

SoakCounts ReadCounts(const std::string& name) {
  std::ifstream file(name);
  if (!file) return {};
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  try {
    return ParseCounts(text);
  } catch (const std::exception& error) {
    throw std::invalid_argument(name + ": " + error.what());
  }
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

// How often a property is checked: with every scene, or with every third one and so on.
struct Share {
  const std::string& property;
  int every;
};

std::vector<Share> SharesOf(const Options& options) {
  const std::vector<Share> all{{kVariations, 1},
                               {kProbes, 4},
                               {kEstimates, 2},
                               {kEnergy, 2},
                               {kPairs, 20},
                               {kInvariances, 100},
                               {kSums, 50},
                               {kFurnace, 200},
                               {kPhotons, 20},
                               {kLayers, 50},
                               {kGathers, 50},
                               {kRooms, 200},
                               {kAgreement, options.agreementEvery}};
  if (options.only.empty()) return all;
  for (const Share& share : all)
    if (share.property == options.only)
      return {{share.property, share.property == kAgreement ? options.agreementEvery : 1}};
  throw std::invalid_argument("there is no property \"" + options.only + "\"\n" + kUsage);
}

// Soak checks scenes one after the other and reports.
class Soak {
 public:
  explicit Soak(const Options& options)
      : options_(options),
        shares_(SharesOf(options)),
        run_({.maxTries =
                  options.untilFailure || options.shrinkTries == 0 ? 0 : RunSettings{}.maxTries,
              .maxStatisticalTries = options.untilFailure ? 0 : options.shrinkTries}) {
    if (!options_.counts.empty()) earlier_ = ReadCounts(options_.counts);
    if (earlier_.next > 0) options_.seed = earlier_.next;
    std::printf("seeds from %llu\n", static_cast<unsigned long long>(options_.seed));
  }

  bool Run() {
    const auto end = Clock::now() + std::chrono::duration<double>(options_.hours * 3600);
    const int batch = options_.untilFailure ? 10 : 100;  // scenes between two judgements
    int done = 0;
    while (options_.scenes > 0 ? done < options_.scenes : Clock::now() < end) {
      CheckScene(done++);
      const bool isTime = done % batch == 0;
      if (isTime) Report(done);
      if (options_.untilFailure && !run_.Failures().empty()) break;
    }
    Report(done);
    if (options_.untilFailure) return !ReportFirst();
    if (!options_.counts.empty())
      std::printf("all runs together:\n%s",
                  TalliesText(Sum(earlier_, run_.Tallies()).tallies).c_str());
    std::printf("%s%.0f CPU seconds\n", run_.Summary().c_str(),
                double(std::clock()) / CLOCKS_PER_SEC);
    std::printf("one scene again: ./dev soak --seed N --scenes 1\n");
    return run_.Failures().empty();
  }

 private:
  void CheckScene(int number) {
    const std::uint64_t seed = options_.seed + std::uint64_t(number);
    for (const Share& share : shares_)
      if (share.every > 0 && seed % std::uint64_t(share.every) == 0) run_.Add(share.property, seed);
  }

  void Report(int done) {
    run_.JudgeComparisons();
    if (options_.untilFailure) return;
    if (!options_.counts.empty()) {
      SoakCounts counts = Sum(earlier_, run_.Tallies());
      counts.next = options_.seed + std::uint64_t(done);
      std::ofstream(options_.counts) << CountsText(counts);
    }
    for (; written_ < run_.Failures().size(); ++written_)
      Write(run_.Failures()[written_], options_.folder);
    for (; named_ < run_.Blurred().size(); ++named_)
      std::printf("blur, seed %llu: %s\n",
                  static_cast<unsigned long long>(run_.Blurred()[named_].seed),
                  run_.Blurred()[named_].detail.c_str());
    std::printf("%d scenes, %zu failures\n", done, run_.Failures().size());
    std::fflush(stdout);
  }

  // Returns whether there is a failure.
  bool ReportFirst() const {
    if (run_.Failures().empty()) {
      std::printf("nothing found in %d scenes\n", options_.scenes);
      return false;
    }
    const Failure* first = &run_.Failures().front();
    for (const Failure& failure : run_.Failures())
      if (failure.seed < first->seed) first = &failure;
    std::printf("found after %llu scenes: %s: %s\n",
                static_cast<unsigned long long>(first->seed - options_.seed + 1),
                first->property.c_str(), first->detail.c_str());
    return true;
  }

  Options options_;
  std::vector<Share> shares_;
  SceneRun run_;
  SoakCounts earlier_;  // the runs before
  std::size_t written_ = 0, named_ = 0;
};

}  // namespace
}  // namespace exphoton::random_scenes

int main(int count, char** words) {
  try {
    const auto options = exphoton::random_scenes::Parse(count, words);
    return exphoton::random_scenes::Soak(options).Run() ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "soak: %s\n", error.what());
    return 2;
  }
}
