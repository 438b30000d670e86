// SPDX-License-Identifier: BSD-2-Clause
#include "core/render/certificate/corrections.h"

#include <algorithm>

namespace exphoton {

Corrections::Corrections(const PixelBounds& crop, double share)
    : crop_(crop),
      share_(share),
      current_(3 * std::size_t(crop.Width()) * std::size_t(crop.Height())),
      rayCount_(current_.size() / 3) {}

void Corrections::Add(Point2i pixel, const CorrectionSample& sample, Real weight) {
  if (!crop_.Contains(pixel.x, pixel.y) || !sample.sum.IsFinite()) return;
  rayCount_[IndexOf(pixel)] += sample.count;
  AddLight(pixel, sample.sum, weight);
}

void Corrections::AddLight(Point2i pixel, const Spectrum& correction, Real weight) {
  if (!crop_.Contains(pixel.x, pixel.y)) return;
  double* const sums = current_.data() + 3 * IndexOf(pixel);
  for (int c = 0; c < Spectrum::kChannels; ++c) sums[c] += double(correction[c] * weight);
}

void Corrections::EndPass(int group, std::int64_t samplesPerPixel) {
  if (groups_.size() <= std::size_t(group)) groups_.resize(std::size_t(group) + 1);
  Group& to = groups_[std::size_t(group)];
  to.samplesPerPixel += samplesPerPixel;
  to.sums.resize(current_.size());
  for (std::size_t i = 0; i < current_.size(); ++i) to.sums[i] += current_[i];
  for (const std::int64_t count : rayCount_) count_ += count;
  std::fill(current_.begin(), current_.end(), 0.);
  std::fill(rayCount_.begin(), rayCount_.end(), 0);
}

void Corrections::JoinGroups() {
  for (std::size_t g = 1; g < groups_.size(); ++g) {
    Group& from = groups_[g];
    groups_[0].samplesPerPixel += from.samplesPerPixel;
    for (std::size_t i = 0; i < from.sums.size(); ++i) groups_[0].sums[i] += from.sums[i];
    from = {};
  }
}

std::vector<const Corrections::Group*> Corrections::Groups() const {
  std::vector<const Group*> groups;
  for (const Group& group : groups_)
    if (group.samplesPerPixel > 0) groups.push_back(&group);
  return groups;
}

}  // namespace exphoton
