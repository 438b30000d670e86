// SPDX-License-Identifier: BSD-2-Clause
#include "tests/benchmark/contest.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <exception>

namespace exphoton {
namespace {

std::vector<Outcome>& MutableOutcomes() {
  static std::vector<Outcome> outcomes;
  return outcomes;
}

double Now(Clock clock) {
  if (clock == Clock::Wall)
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
}

void Run(benchmark::State& state, const std::string& name,
         const std::function<Contest()>& prepare) {
  Contest contest;
  try {
    contest = prepare();
  } catch (const std::exception& error) {
    state.SkipWithError(error.what());
    return;
  }
  Outcome outcome{name, contest.unit, contest.amount, {}, {}};
  const std::size_t count = contest.contestants.size();
  outcome.seconds.resize(count);
  for (const Contestant& contestant : contest.contestants) {
    outcome.contestants.push_back(contestant.name);
    contestant.work();  // untimed: warms memory and caches
  }
  std::size_t first = 0;
  for (auto _ : state) {
    double together = 0;
    for (std::size_t i = 0; i < count; ++i) {  // a different contestant begins each round
      const std::size_t at = (first + i) % count;
      const double start = Now(contest.clock);
      contest.contestants[at].work();
      const double seconds = Now(contest.clock) - start;
      outcome.seconds[at].push_back(seconds);
      together += seconds;
    }
    ++first;
    state.SetIterationTime(together);
  }
  MutableOutcomes().push_back(std::move(outcome));
}

}  // namespace

void AddContest(const std::string& name, int rounds, std::function<Contest()> prepare) {
  benchmark::RegisterBenchmark(
      name.c_str(), [name, prepare](benchmark::State& state) { Run(state, name, prepare); })
      ->Iterations(rounds)
      ->UseManualTime()
      ->Unit(benchmark::kMillisecond);
}

Quartiles QuartilesOf(std::vector<double> values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const auto at = [&](double part) {
    return values[std::size_t(part * double(values.size() - 1) + .5)];
  };
  return {at(.25), at(.5), at(.75)};
}

int Outcome::IndexOf(const std::string& contestant) const {
  const auto found = std::find(contestants.begin(), contestants.end(), contestant);
  return found == contestants.end() ? -1 : int(found - contestants.begin());
}

double Outcome::Rate(int contestant) const {
  return amount / QuartilesOf(seconds[std::size_t(contestant)]).median;
}

Quartiles Outcome::Ratio(int contestant, int opponent) const {
  std::vector<double> ratios;
  const auto& own = seconds[std::size_t(contestant)];
  const auto& other = seconds[std::size_t(opponent)];
  for (std::size_t i = 0; i < own.size(); ++i) ratios.push_back(other[i] / own[i]);
  return QuartilesOf(std::move(ratios));
}

const std::vector<Outcome>& Outcomes() { return MutableOutcomes(); }

}  // namespace exphoton
