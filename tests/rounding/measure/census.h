// SPDX-License-Identifier: BSD-2-Clause
// The census of cancellations by source line. addr2line finds the lines of addresses.
#pragma once

#include <string>
#include <vector>

#include "tests/rounding/runtime/rounding.h"

namespace exphoton::rounding {

struct CensusLine {
  std::string place;  // "core/geometry/ray.h:34"; not of helpers such as the operators of vectors
  std::uint64_t count = 0, zeros = 0;
  double bits = 0;  // the sum over `count`
};

// Adds the counts of places by line, those with the largest sum of bits first.
std::vector<CensusLine> ByLine(const std::vector<Cancellations>& places);
std::string TextOf(const std::vector<CensusLine>& lines, std::size_t most);

// Chooses from what addr2line -i prints for one address: the innermost line that is not in a
// header of vectors and scalars.
std::string PlaceOf(const std::vector<std::string>& frames);

}  // namespace exphoton::rounding
