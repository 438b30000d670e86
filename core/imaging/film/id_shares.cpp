// SPDX-License-Identifier: BSD-2-Clause
// IdShares searches linearly: a pixel sees few objects.
#include "core/imaging/film/id_shares.h"

#include <algorithm>

#include "core/files/byte_archive.h"

namespace exphoton {

void IdShares::Add(std::size_t pixel, std::uint32_t id, double weight) {
  std::vector<Share>& shares = pixels_[pixel];
  const auto found = std::find_if(shares.begin(), shares.end(),
                                  [id](const Share& share) { return share.id == id; });
  if (found != shares.end()) {
    found->weight += weight;
  } else {
    shares.push_back({id, weight});
  }
}

void IdShares::Add(const IdShares& other) {
  for (std::size_t pixel = 0; pixel < pixels_.size(); ++pixel)
    for (const Share& share : other.pixels_[pixel]) Add(pixel, share.id, share.weight);
}

void IdShares::Clear() {
  for (auto& shares : pixels_) shares.clear();
}

void IdShares::ClearPixel(std::size_t pixel) {
  if (!pixels_.empty()) pixels_[pixel].clear();
}

void IdShares::TransferPixel(ByteArchive* archive, std::size_t pixel) {
  if (pixels_.empty()) return;
  std::vector<Share>& shares = pixels_[pixel];
  shares.resize(archive->Count(shares.size(), sizeof(std::uint32_t) + sizeof(double)));
  for (Share& share : shares) archive->Values(&share.id, &share.weight);
}

void IdShares::Rank(std::size_t pixel, float* out) const {
  std::vector<Share> shares = pixels_[pixel];
  double sum = 0;
  for (const Share& share : shares) sum += share.weight;
  std::erase_if(shares, [](const Share& share) { return share.id == 0; });
  std::sort(shares.begin(), shares.end(), [](const Share& a, const Share& b) {
    return a.weight != b.weight ? a.weight > b.weight : a.id < b.id;
  });
  std::fill_n(out, 2 * kRanks, 0.f);
  for (std::size_t i = 0; i < std::min(shares.size(), kRanks) && sum > 0; ++i) {
    out[2 * i] = float(shares[i].id);
    out[2 * i + 1] = float(shares[i].weight / sum);
  }
}

}  // namespace exphoton
