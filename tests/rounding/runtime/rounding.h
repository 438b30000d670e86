// SPDX-License-Identifier: BSD-2-Clause
// RoundAtRandom is the control of a build with EXPHOTON_STOCHASTIC. There each operation in single
// precision rounds up or down at random, with equal chances; an exact result stays as it is (the
// method CESTAC: Vignes 1993, "A stochastic arithmetic for reliable scientific computation").
// Double precision is not changed. The census counts cancellations by place in the code.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace exphoton::rounding {

// Chooses the directions of all later operations of this thread by the key; 0: to nearest, as in
// other builds. Threads that start later begin with equal directions. The environment variable
// EXPHOTON_ROUNDING_SEED sets the key before main.
void RoundAtRandom(std::uint64_t key);

// A cancellation is a sum or difference whose result is smaller than the first operand by a factor
// of at least 2^13, or 0 if the operand is not, so that more than 12 bits are lost.
struct Cancellations {
  std::uintptr_t address;  // behind the instruction
  std::uint64_t count;     // of results that are not 0
  std::uint64_t zeros;     // of results that are 0
  double bits;             // the sum of the bits lost, without zeros
};

// Starts or ends the census. It counts all threads.
void CountCancellations(bool isOn);
// Returns the counts by place, and clears them.
std::vector<Cancellations> TakeCancellations();

}  // namespace exphoton::rounding
