// SPDX-License-Identifier: BSD-2-Clause
#include "core/render/certificate/corrections.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/files/state_file.h"
#include "core/imaging/film/film.h"
#include "core/render/certificate/group_places.h"

namespace exphoton {
namespace {

// Adds the values to others and sets them to 0. The others are 0 if there are none yet.
void Move(std::vector<double>* from, std::vector<double>* to) {
  to->resize(std::max(to->size(), from->size()));
  for (std::size_t i = 0; i < from->size(); ++i) (*to)[i] += std::exchange((*from)[i], 0.);
}

constexpr std::int64_t kMostCounted = std::int64_t(1) << 50;  // rays, or samples
bool IsCount(std::int64_t rays) { return rays >= 0 && rays <= kMostCounted; }

constexpr const char* kCountSection = "corrections";
constexpr const char* kCurrentSection = "corrections of the pass";

std::string GroupSection(std::size_t group) {
  return "corrections of group " + std::to_string(group);
}

// Saves or loads the numbers, which may be none if isOptional. Their number is known.
template <class Number>
void TransferNumbers(ByteArchive* archive, std::size_t count, bool isOptional,
                     std::vector<Number>* numbers) {
  archive->List(numbers);
  if (numbers->size() != count && !(isOptional && numbers->empty()))
    throw ArchiveError("its corrections have other pixels");
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

void Corrections::ClearPixel(Point2i pixel) {
  if (!crop_.Contains(pixel.x, pixel.y)) return;
  const std::size_t at = IndexOf(pixel);
  for (std::vector<double>* sums : {&current_, &currentSharing_})
    if (!sums->empty()) std::fill_n(sums->begin() + std::ptrdiff_t(3 * at), 3, 0.);
  rayCount_[at] = gatherRays_[at] = 0;
}

void Corrections::ClearPass() {
  for (std::vector<double>* sums : {&current_, &currentSharing_})
    std::fill(sums->begin(), sums->end(), 0.);
  std::fill(rayCount_.begin(), rayCount_.end(), 0);
  std::fill(gatherRays_.begin(), gatherRays_.end(), 0);
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

void Corrections::SubtractSharing(const Film& light, int group) {
  const auto place = std::size_t(PlaceOfGroup(group, mostGroups_, isFirstJoined_));
  // Joined groups are in the first place.
  const bool hasPlace = place < groups_.size() && groups_[place].samplesPerPixel > 0;
  Group& to = groups_[hasPlace ? place : 0];
  to.sums.resize(current_.size());
  to.sharing.resize(current_.size());
  for (std::size_t i = 0; i < light.PixelCount(); ++i) {
    const Film::Sums sums = light.SumsOf(i);
    to.sharing[3 * i] -= sums.r;
    to.sharing[3 * i + 1] -= sums.g;
    to.sharing[3 * i + 2] -= sums.b;
  }
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

void Corrections::TransferCounts(ByteArchive* archive) {
  archive->Same(share_);
  std::uint64_t groups = groups_.size();
  char isFirstJoined = isFirstJoined_ ? 1 : 0;
  archive->Values(&groups, &isFirstJoined, &count_, &expected_);
  if (groups > std::uint64_t(mostGroups_) || count_ < 0 || count_ > kMostCounted ||
      !(expected_ >= 0) || !std::isfinite(expected_))
    throw ArchiveError("its counts of corrections contradict each other");
  groups_.resize(std::size_t(groups));
  isFirstJoined_ = isFirstJoined != 0;
}

void Corrections::TransferPass(ByteArchive* archive) {
  const std::size_t pixels = rayCount_.size();
  TransferNumbers(archive, 3 * pixels, false, &current_);
  TransferNumbers(archive, currentSharing_.size(), false, &currentSharing_);
  TransferNumbers(archive, pixels, false, &rayCount_);
  TransferNumbers(archive, pixels, false, &gatherRays_);
  if (!std::ranges::all_of(rayCount_, IsCount) || !std::ranges::all_of(gatherRays_, IsCount))
    throw ArchiveError("its numbers of gather rays are impossible");
}

void Corrections::TransferPixel(ByteArchive* archive, Point2i pixel) {
  const std::size_t at = IndexOf(pixel);
  double* const sums = current_.data() + 3 * at;
  archive->Values(&sums[0], &sums[1], &sums[2], &rayCount_[at], &gatherRays_[at]);
  if (!IsCount(rayCount_[at]) || !IsCount(gatherRays_[at]) || !std::isfinite(sums[0]) ||
      !std::isfinite(sums[1]) || !std::isfinite(sums[2]))
    throw ArchiveError("its corrections are impossible");
}

void Corrections::TransferGroup(ByteArchive* archive, Group* group) {
  archive->Values(&group->samplesPerPixel);
  TransferNumbers(archive, current_.size(), true, &group->sums);
  TransferNumbers(archive, currentSharing_.size(), true, &group->sharing);
  if (group->samplesPerPixel < 0 || group->samplesPerPixel > kMostCounted ||
      (group->samplesPerPixel > 0 && group->sums.empty()))
    throw ArchiveError("a group has no corrections");
  if (group->sharing.size() > group->sums.size())
    throw ArchiveError("a group has corrections of sharing alone");
}

// Each group has a section of its own, so that only one is in memory twice.
void Corrections::Save(StateWriter* writer) {
  writer->AddArchive(kCountSection, [this](ByteArchive* archive) { TransferCounts(archive); });
  writer->AddArchive(kCurrentSection, [this](ByteArchive* archive) { TransferPass(archive); });
  for (std::size_t g = 0; g < groups_.size(); ++g)
    writer->AddArchive(GroupSection(g),
                       [&](ByteArchive* archive) { TransferGroup(archive, &groups_[g]); });
}

void Corrections::Load(const StateFile& file) {
  file.Read(kCountSection, [this](ByteArchive* archive) { TransferCounts(archive); });
  file.Read(kCurrentSection, [this](ByteArchive* archive) { TransferPass(archive); });
  for (std::size_t g = 0; g < groups_.size(); ++g)
    file.Read(GroupSection(g), [&](ByteArchive* archive) { TransferGroup(archive, &groups_[g]); });
}

std::vector<const Corrections::Group*> Corrections::Groups() const {
  std::vector<const Group*> groups;
  for (const Group& group : groups_)
    if (group.samplesPerPixel > 0) groups.push_back(&group);
  return groups;
}

}  // namespace exphoton
