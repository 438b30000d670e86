// SPDX-License-Identifier: BSD-2-Clause
#include "core/render/passes/photons/unequal_sets.h"

#include <algorithm>
#include <cmath>

#include "core/files/byte_archive.h"

namespace exphoton {

void UnequalSets::Join(double noise, std::int64_t samples) {
  noiseOfSample_ = noise * double(samples);
  sets_ = {{-1, 0, samples}};
}

void UnequalSets::Add(int group, int place, std::int64_t samples) {
  if (sets_.back().group != group) sets_.push_back({group, place, 0});
  sets_.back().samples += samples;
}

std::int64_t UnequalSets::Samples() const {
  std::int64_t samples = 0;
  for (const Set& set : sets_) samples += set.samples;
  return samples;
}

// Let A / n be the variance of n samples for given photons, and B the variance by one set of
// photons. The mean of all N samples has the variance A / N + B Q, where Q is the sum of the
// squared shares of the sets. PassNoise adds up w^2 d^2 / (1 - w) for the distances d of the places
// of shares w from the mean. With q, the part of Q of the sets in a place, d^2 has the expected
// value q B / w^2 (1 - 2 w) + Q B + (1 - w) / w A / N. So the sum finds A / N + B S with
//   S = sum (q (1 - 2 w) + w^2 Q) / (1 - w).
double UnequalSets::FactorOn(double between) const {
  if (!(noiseOfSample_ > 0) || sets_.size() < 2 || !(between > 0)) return 1;
  const auto samples = double(Samples());
  int places = 0;
  for (const Set& set : sets_) places = std::max(places, set.place + 1);
  std::vector<double> shares(std::size_t(places), 0), squares = shares;
  double all = 0;
  for (const Set& set : sets_) {
    const double share = double(set.samples) / samples;
    shares[std::size_t(set.place)] += share;
    squares[std::size_t(set.place)] += share * share;
    all += share * share;
  }
  double found = 0;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    const double w = shares[i];
    if (w > 0) found += (squares[i] * (1 - 2 * w) + w * w * all) / (1 - w);
  }
  const double ofSamples = std::min(noiseOfSample_ / samples, between);
  return (ofSamples + (between - ofSamples) * std::max(all / found, 1.)) / between;
}

void UnequalSets::Transfer(ByteArchive* archive) {
  archive->Values(&noiseOfSample_);
  sets_.resize(archive->Count(sets_.size(), sizeof(int) * 2 + sizeof(std::int64_t)));
  constexpr int kMostPlaces = 1024;
  constexpr std::int64_t kMostSamples = std::int64_t(1) << 50;  // of all sets
  bool isPossible = noiseOfSample_ >= 0 && std::isfinite(noiseOfSample_);
  std::int64_t left = kMostSamples;
  for (Set& set : sets_) {
    archive->Values(&set.group, &set.place, &set.samples);
    isPossible = isPossible && set.place >= 0 && set.place < kMostPlaces && set.samples > 0 &&
                 set.samples <= left;
    left -= isPossible ? set.samples : 0;
  }
  if (!isPossible) throw ArchiveError("its sets of photons are impossible");
}

}  // namespace exphoton
