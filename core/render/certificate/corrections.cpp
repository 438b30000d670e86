// SPDX-License-Identifier: BSD-2-Clause
#include "core/render/certificate/corrections.h"

#include <algorithm>
#include <utility>

#include "core/render/certificate/group_places.h"

namespace exphoton {
namespace {

// Adds the values to others and sets them to 0. The others are 0 if there are none yet.
void Move(std::vector<double>* from, std::vector<double>* to) {
  to->resize(std::max(to->size(), from->size()));
  for (std::size_t i = 0; i < from->size(); ++i) (*to)[i] += std::exchange((*from)[i], 0.);
}

}  // namespace

Corrections::Corrections(const PixelBounds& crop, double share, int mostGroups)
    : crop_(crop),
      share_(share),
      mostGroups_(mostGroups),
      current_(3 * std::size_t(crop.Width()) * std::size_t(crop.Height())),
      rayCount_(current_.size() / 3),
      gatherRays_(rayCount_.size()) {}

void Corrections::Add(Point2i pixel, const CorrectionSample& sample, Real weight) {
  if (!crop_.Contains(pixel.x, pixel.y)) return;
  gatherRays_[IndexOf(pixel)] += sample.gatherRays;
  if (!sample.sum.IsFinite()) return;
  rayCount_[IndexOf(pixel)] += sample.count;
  AddLight(pixel, sample.sum, weight);
}

void Corrections::AddLight(Point2i pixel, const Spectrum& correction, Real weight) {
  AddTo(&current_, pixel, correction, weight);
}

void Corrections::AddSharing(Point2i pixel, const Spectrum& correction, Real weight) {
  AddTo(currentSharing_.empty() ? &current_ : &currentSharing_, pixel, correction, weight);
}

void Corrections::AddTo(std::vector<double>* sums, Point2i pixel, const Spectrum& correction,
                        Real weight) {
  if (!crop_.Contains(pixel.x, pixel.y)) return;
  double* const at = sums->data() + 3 * IndexOf(pixel);
  for (int c = 0; c < Spectrum::kChannels; ++c) at[c] += double(correction[c] * weight);
}

void Corrections::KeepSharingApart() { currentSharing_.assign(current_.size(), 0); }

void Corrections::EndPass(int group, std::int64_t samplesPerPixel) {
  const auto place = std::size_t(PlaceOfGroup(group, mostGroups_, isFirstJoined_));
  if (groups_.size() <= place) groups_.resize(place + 1);
  Group& to = groups_[place];
  to.samplesPerPixel += samplesPerPixel;
  Move(&current_, &to.sums);
  Move(&currentSharing_, &to.sharing);
  for (const std::int64_t count : rayCount_) count_ += count;
  std::fill(rayCount_.begin(), rayCount_.end(), 0);
  for (const std::int64_t rays : gatherRays_) expected_ += share_ * double(rays);
  std::fill(gatherRays_.begin(), gatherRays_.end(), 0);
}

void Corrections::JoinGroups() {
  for (std::size_t g = 1; g < groups_.size(); ++g) {
    Group& from = groups_[g];
    groups_[0].samplesPerPixel += from.samplesPerPixel;
    Move(&from.sums, &groups_[0].sums);
    Move(&from.sharing, &groups_[0].sharing);
    from = {};
  }
  isFirstJoined_ = true;
}

std::vector<double> Corrections::SumsOf(const Group& group) const {
  std::vector<double> sums = group.sums;
  if (isShared_)
    for (std::size_t i = 0; i < group.sharing.size(); ++i) sums[i] += group.sharing[i];
  return sums;
}

std::vector<const Corrections::Group*> Corrections::Groups() const {
  std::vector<const Group*> groups;
  for (const Group& group : groups_)
    if (group.samplesPerPixel > 0) groups.push_back(&group);
  return groups;
}

}  // namespace exphoton
