// SPDX-License-Identifier: BSD-2-Clause
// UnequalSets corrects the variance between groups of passes for sets of photons of unequal sizes.
// PassNoise assumes that the variance of a group is inversely proportional to its samples. But a
// part of it comes from the photons of the group, and does not fall with its samples
// (docs/decisions/0090-noise-of-one-set-of-photons.md).
#pragma once

#include <cstdint>
#include <vector>

namespace exphoton {

class ByteArchive;

class UnequalSets {
 public:
  // States that the groups so far have one set of photons, and that each later group has its own.
  // `noise` is the variance between the groups so far, as noise of their mean (any unit); 0: it is
  // not known.
  void Join(double noise, std::int64_t samples);
  bool AreJoined() const { return !sets_.empty(); }
  // Adds samples of a group after Join. PassNoise keeps them in `place`.
  void Add(int group, int place, std::int64_t samples);

  // Returns the variance of the mean of all samples, divided by the variance `between` that
  // PassNoise finds. It is 1 without the two facts of Join.
  double FactorOn(double between) const;

  void Transfer(ByteArchive* archive);  // saves or loads

 private:
  struct Set {
    int group = 0, place = 0;
    std::int64_t samples = 0;
  };
  std::int64_t Samples() const;

  double noiseOfSample_ = 0;  // of camera samples and gather rays; 0: not known
  std::vector<Set> sets_;     // the joined groups are the first one
};

}  // namespace exphoton
