// SPDX-License-Identifier: BSD-2-Clause
// PhotonSets decides which photons the groups of passes have. The first groups share one set, and
// their passes show the noise that it causes. As long as this is a small part of what the picture
// may have, all groups keep the photons, which saves the time of shooting others. Otherwise each
// later group has photons of its own. docs/decisions/0090-noise-of-one-set-of-photons.md has the
// reasons.
#pragma once

#include <limits>
#include <optional>

#include "core/render/photon_noise.h"

namespace exphoton {

class PhotonSets {
 public:
  // Photons are kept if they cause at most this share of the wanted noise. The samples must make up
  // for it, and a second set would halve it.
  static constexpr double kSmallShare = .25;
  static bool AreKept(double noise, double wanted) { return noise <= kSmallShare * wanted; }

  // Without measurement, each group has photons of its own.
  PhotonSets(const PixelBounds& crop, bool isMeasured);

  // Receives the signed light of the next pass. Null: it is not wanted.
  PhotonNoise* Measurement() { return noise_ ? &*noise_ : nullptr; }
  // Must be called after each pass.
  void EndPass(std::int64_t samplesPerPixel);
  // Whether the noise is known. Never true for groups with photons of their own.
  bool IsKnown() const { return noise_ && noise_->IsKnown(); }
  // Estimates the noise, which must be known. levels: as in PhotonNoise.
  void Measure(const std::vector<double>& levels);
  // Decides whether the groups from `nextGroup` on keep the photons. Must be called while the noise
  // is known, after it was measured. wanted: noise part of relMSE that the picture may have. If
  // these photons are not kept, the groups so far still have their noise, until `nextGroup` has
  // photons of its own.
  void Decide(double wanted, int nextGroup);

  // Returns the number of the photons of a group. Groups with the same number have the same.
  int SetOf(int group) const { return group < firstOwn_ ? 0 : group; }
  // Returns whether this group is the first one with photons of its own.
  bool Divides(int group) const { return group == firstOwn_ && group > 0; }
  // Returns the noise part of relMSE that the first photons cause, 0 if it is not known.
  double FirstNoise() const { return relative_; }
  // The same if all groups share these photons, otherwise 0.
  double SharedNoise() const { return noise_ ? relative_ : 0; }
  void Transfer(ByteArchive* archive);  // saves or loads

 private:
  static constexpr int kNone = std::numeric_limits<int>::max();

  std::optional<PhotonNoise> noise_;  // nullopt: groups have photons of their own
  int firstOwn_;                      // the first group with photons of its own
  double relative_ = 0;
};

}  // namespace exphoton
