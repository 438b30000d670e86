// SPDX-License-Identifier: BSD-2-Clause
// Draw makes the choices of generated scenes. Its numbers depend on the seed alone and are the same
// with every library.
#pragma once

#include <cstdint>
#include <random>

namespace exphoton::recorded {

class Draw {
 public:
  explicit Draw(std::uint64_t seed) : numbers_(seed) { numbers_.discard(8); }

  // Returns 0, 1, ... or count - 1.
  std::uint64_t Below(std::uint64_t count) { return (numbers_() >> 16) % count; }

  template <class List>
  const auto& From(const List& list) {
    return list[std::size_t(Below(list.size()))];
  }

 private:
  std::mt19937_64 numbers_;
};

}  // namespace exphoton::recorded
