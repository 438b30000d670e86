// SPDX-License-Identifier: BSD-2-Clause
// A Contest times several ways of doing the same work in turn within one process, so that other
// load on the machine slows all of them equally. The results are ratios of times of the same round,
// as median and quartiles. Google Benchmark selects, repeats and reports contests.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace exphoton {

// Clock selects the time to measure: CPU time of one thread, whatever else runs, or wall-clock
// time, for work of several threads.
enum class Clock { Thread, Wall };

struct Contestant {
  std::string name;
  std::function<void()> work;
};

struct Contest {
  double amount = 0;  // work in one round
  std::string unit;   // speed is in units per second: "Mrays" with amount in 1e6 rays
  std::vector<Contestant> contestants;
  Clock clock = Clock::Thread;
};

// Registers a contest under "part/size/name". `prepare` is called just before the contest and may
// throw.
void AddContest(const std::string& name, int rounds, std::function<Contest()> prepare);

struct Quartiles {
  double low = 0, median = 0, high = 0;
};
Quartiles QuartilesOf(std::vector<double> values);

// Outcome holds the times of a contest.
struct Outcome {
  std::string name, unit;
  double amount = 0;
  std::vector<std::string> contestants;
  std::vector<std::vector<double>> seconds;  // by contestant, then by round

  int IndexOf(const std::string& contestant) const;  // -1: did not take part
  double Rate(int contestant) const;                 // units per second, median
  // Returns how many times as fast as the opponent it is, as quartiles over the rounds.
  Quartiles Ratio(int contestant, int opponent) const;
};

// Returns the outcomes of the contests that have run, in the order of running.
const std::vector<Outcome>& Outcomes();

}  // namespace exphoton
