// SPDX-License-Identifier: BSD-2-Clause
// IdShares sums, for each pixel, the weights of the ids that its samples have. It is the coverage
// of pixels by objects, as the Cryptomatte specification 1.2 needs it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace exphoton {

class ByteArchive;

class IdShares {
 public:
  static constexpr std::size_t kRanks = 6;  // ids that a picture stores for a pixel

  explicit IdShares(std::size_t pixels = 0) : pixels_(pixels) {}

  bool IsEmpty() const { return pixels_.empty(); }
  std::size_t Count() const { return pixels_.size(); }
  void Add(std::size_t pixel, std::uint32_t id, double weight);
  void Add(const IdShares& other);
  void Clear();
  void ClearPixel(std::size_t pixel);
  // Saves or loads one pixel.
  void TransferPixel(ByteArchive* archive, std::size_t pixel);

  // Writes kRanks pairs of an id and its share of all weights, the largest share first. Of equal
  // shares, the smaller id is first. The id 0, a sample that hit nothing, is left out. Pairs
  // without an id are 0.
  void Rank(std::size_t pixel, float* out) const;

 private:
  struct Share {
    std::uint32_t id = 0;
    double weight = 0;
  };
  std::vector<std::vector<Share>> pixels_;  // in the order in which ids were found
};

}  // namespace exphoton
