// SPDX-License-Identifier: BSD-2-Clause
#include "core/render/passes/photons/photon_sets.h"

#include <cmath>

#include "core/files/byte_archive.h"

namespace exphoton {

PhotonSets::PhotonSets(const PixelBounds& crop, bool isMeasured)
    : firstOwn_(isMeasured ? kNone : 0) {
  if (isMeasured) noise_.emplace(crop);
}

void PhotonSets::EndPass(std::int64_t samplesPerPixel) {
  if (noise_) noise_->EndPass(samplesPerPixel);
}

void PhotonSets::Measure(const std::vector<double>& levels) {
  relative_ = noise_->RelativeVariance(levels);
}

void PhotonSets::Decide(double wanted, int nextGroup) {
  if (AreKept(relative_, wanted)) return;
  firstOwn_ = nextGroup;
  noise_.reset();
}

void PhotonSets::Transfer(ByteArchive* archive) {
  char isMeasured = noise_ ? 1 : 0;
  archive->Values(&isMeasured, &firstOwn_, &relative_);
  const bool isPossible =
      isMeasured ? noise_ && firstOwn_ == kNone && std::isfinite(relative_) : firstOwn_ >= 0;
  if (!isPossible || !(relative_ >= 0)) throw ArchiveError("its photons contradict its passes");
  if (!isMeasured) noise_.reset();
  if (noise_) noise_->Transfer(archive);
}

}  // namespace exphoton
