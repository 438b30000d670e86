// SPDX-License-Identifier: BSD-2-Clause
// A contest: several ways of doing the same work, timed in turn within one process, so that what
// else the machine does slows all of them alike. What counts are ratios of times of the same round;
// their median and quartiles are reported. Google Benchmark selects, repeats and reports.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace exphoton {

// Which time a contest is about: that of the one thread, whatever else runs, or that of the clock
// on the wall, for work of several threads.
enum class Clock { Thread, Wall };

struct Contestant {
  std::string name;
  std::function<void()> work;
};

struct Contest {
  double amount = 0;  // of work in one round
  std::string unit;   // of which, a second, speed is given: "Mrays" with amount in 1e6 rays
  std::vector<Contestant> contestants;
  Clock clock = Clock::Thread;
};

// Registers a contest under "part/size/name". `prepare` is called when it is its turn; it may
// throw.
void AddContest(const std::string& name, int rounds, std::function<Contest()> prepare);

struct Quartiles {
  double low = 0, median = 0, high = 0;
};
Quartiles QuartilesOf(std::vector<double> values);

// What a contest gave.
struct Outcome {
  std::string name, unit;
  double amount = 0;
  std::vector<std::string> contestants;
  std::vector<std::vector<double>> seconds;  // by contestant, then by round

  int IndexOf(const std::string& contestant) const;  // -1: took no part
  double Rate(int contestant) const;                 // units a second, median
  // How many times as fast as the opponent: quartiles over the rounds.
  Quartiles Ratio(int contestant, int opponent) const;
};

// Those of the contests that have run, in their order.
const std::vector<Outcome>& Outcomes();

}  // namespace exphoton
