// SPDX-License-Identifier: BSD-2-Clause
// HilbertOrder uses a Hilbert curve on the octahedral square, where neighbours are also neighbours
// on the sphere. It sorts by counting, with a few additions per photon and no branches that depend
// on directions.
#include "integrators/photon/gather/hilbert_order.h"

#include <array>
#include <utility>

namespace exphoton {
namespace {

constexpr std::uint32_t kBits = 4, kSide = 1 << kBits;  // cells along a side of the square
constexpr std::uint32_t kDigits = kSide;                // a curve position has two digits

// Returns the position at which the Hilbert curve visits cell (x, y): 0 to kSide^2 - 1.
constexpr std::uint8_t HilbertPlace(std::uint32_t x, std::uint32_t y) {
  std::uint32_t place = 0;
  for (std::uint32_t half = kSide / 2; half > 0; half /= 2) {
    const bool isRight = (x & half) != 0, isUp = (y & half) != 0;
    place += half * half * (isRight ? (isUp ? 2 : 3) : (isUp ? 1 : 0));
    if (isUp) continue;  // the lower quarters are mirrored at a diagonal
    if (isRight) x = kSide - 1 - x, y = kSide - 1 - y;
    std::swap(x, y);
  }
  return std::uint8_t(place);
}

constexpr std::array<std::uint8_t, kSide * kSide> HilbertPlaces() {
  std::array<std::uint8_t, kSide * kSide> places{};
  for (std::uint32_t y = 0; y < kSide; ++y)
    for (std::uint32_t x = 0; x < kSide; ++x) places[y * kSide + x] = HilbertPlace(x, y);
  return places;
}
constexpr auto kPlaces = HilbertPlaces();

// Returns the curve position of an EncodeOctahedral code. The code has two signed 16-bit numbers,
// whose upper bits give the cell.
std::uint8_t LocationOf(std::uint32_t octahedral) {
  const std::uint32_t shifted = octahedral ^ 0x80008000u;  // makes both numbers unsigned
  return kPlaces[(shifted >> (32 - kBits)) * kSide + (shifted >> (16 - kBits) & (kSide - 1))];
}

struct Placed {
  std::uint32_t photon;
  std::uint32_t place;
};

// Stable counting sort by the digit that begins at bit `shift`.
void SortByDigit(std::span<const Placed> from, std::uint32_t shift, Placed* to) {
  std::uint32_t next[kDigits + 1] = {};
  for (const Placed& item : from) ++next[(item.place >> shift & (kDigits - 1)) + 1];
  for (std::uint32_t digit = 1; digit < kDigits; ++digit) next[digit] += next[digit - 1];
  for (const Placed& item : from) to[next[item.place >> shift & (kDigits - 1)]++] = item;
}

}  // namespace

std::span<const std::uint32_t> HilbertOrder(const PhotonMap& map,
                                            std::span<const std::uint32_t> photons, Arena* arena) {
  const std::size_t count = photons.size();
  Placed *const given = arena->AllocateArray<Placed>(count), *const sorted =
                                                                 arena->AllocateArray<Placed>(
                                                                     count);
  for (std::size_t i = 0; i < count; ++i)
    given[i] = {photons[i], LocationOf(map.DirectionCode(photons[i]))};
  SortByDigit({given, count}, 0, sorted);
  SortByDigit({sorted, count}, kBits, given);
  std::uint32_t* const ordered = arena->AllocateArray<std::uint32_t>(count);
  for (std::size_t i = 0; i < count; ++i) ordered[i] = given[i].photon;
  return {ordered, count};
}

}  // namespace exphoton
