// SPDX-License-Identifier: BSD-2-Clause
// JointWindows: the fragments of all passes choose the windows, and each pass fits its own gathers.
#include "core/render/sharing/passes/joint_windows.h"

#include <string>
#include <utility>

#include "core/files/byte_archive.h"
#include "core/render/sharing/sharing_bands.h"

namespace exphoton {
namespace {

constexpr const char* kSection = "joint windows";
// The bytes of a pixel of SharingChange without AOVs. Fit has two of them beside those of passes.
constexpr double kChangeBytes = 80, kFitBytes = 2 * kChangeBytes;

std::string PassSection(std::size_t pass) { return "joint pass " + std::to_string(pass); }
std::string RowSection(std::size_t pass, int y) {
  return "joint gathers of pass " + std::to_string(pass) + ", row " + std::to_string(y);
}

}  // namespace

JointWindows::JointWindows(const Film& picture, const AovFilm* aovs, double memory)
    : picture_(picture),
      aovs_(aovs),
      memory_(memory),
      gathered_(WithSharingMargin(picture.Crop(), picture.Full(), 0)),
      next_({}, 0),
      all_(gathered_, 0) {}

bool JointWindows::HasRoomFor(std::int64_t samplesPerPixel) const {
  double bytes = GatherFragments::BytesPerPixel(samplesPerPixel) + kChangeBytes +
                 GatherFragments::BytesPerPixel(0) + kFitBytes;
  for (const Pass& pass : passes_)
    bytes += GatherFragments::BytesPerPixel(pass.samples) + kChangeBytes;
  const PixelBounds& full = picture_.Full();
  const bool fits = double(full.Width()) * full.Height() * bytes <= memory_;
  return fits && passes_.size() < kMostPasses;
}

std::int64_t JointWindows::SamplesPerPixel() const {
  std::int64_t samples = 0;
  for (const Pass& pass : passes_) samples += pass.samples;
  return samples;
}

void JointWindows::Add(std::int64_t samplesPerPixel, int group) {
  passes_.push_back({group, samplesPerPixel, std::exchange(next_, GatherFragments({}, 0)),
                     SharingChange(picture_, aovs_)});
}

void JointWindows::JoinNewPasses(ThreadPool* threads) {
  threads->For(gathered_.Height(), [&](std::int64_t row, int) {
    for (int x = gathered_.x0; x < gathered_.x1; ++x)
      for (std::size_t i = joined_; i < passes_.size(); ++i) {
        const Point2i pixel{x, gathered_.y0 + int(row)};
        all_.At(pixel).JoinFragments(passes_[i].gathers.At(pixel));
      }
  });
  joined_ = passes_.size();
}

double JointWindows::Fit(ThreadPool* threads, const Use& use) {
  JoinNewPasses(threads);
  const FragmentRows rows(all_);
  const SharingChoice choice(all_, rows, {picture_.Crop()}, threads);
  SharingTotals totals;
  for (Pass& pass : passes_) {
    SharingChange change(picture_, aovs_);
    const SharedGathers shared(pass.gathers, choice, picture_.Crop(), threads);
    totals.Add(shared.AddLight(
        {nullptr, nullptr, nullptr, picture_.Crop(), double(pass.samples), nullptr, &change}));
    SharingChange difference(picture_, aovs_);
    difference.Add(change);
    difference.Subtract(pass.change);
    use(pass.group, difference);
    pass.change = std::move(change);
  }
  return totals.MeanRadius();
}

void JointWindows::Transfer(ByteArchive* archive) {
  std::uint64_t passes = passes_.size();
  archive->Values(&passes);
  if (passes > kMostPasses) throw ArchiveError("too many passes share windows");
  while (passes_.size() < passes)
    passes_.push_back({0, 0, GatherFragments(gathered_, 0), SharingChange(picture_, aovs_)});
}

void JointWindows::TransferPass(ByteArchive* archive, Pass* pass, int groups) {
  archive->Values(&pass->group, &pass->samples);
  if (pass->group < 0 || pass->group >= groups || pass->samples < 1)
    throw ArchiveError("a pass with joint windows is impossible");
  pass->change.Transfer(archive);
}

void JointWindows::TransferRow(ByteArchive* archive, Pass* pass, int y) const {
  for (int x = gathered_.x0; x < gathered_.x1; ++x) pass->gathers.At({x, y}).Transfer(archive);
}

void JointWindows::Save(StateWriter* writer) {
  writer->AddArchive(kSection, [this](ByteArchive* archive) { Transfer(archive); });
  for (std::size_t i = 0; i < passes_.size(); ++i) {
    Pass& pass = passes_[i];
    writer->AddArchive(PassSection(i),
                       [&](ByteArchive* archive) { TransferPass(archive, &pass, pass.group + 1); });
    for (int y = gathered_.y0; y < gathered_.y1; ++y)
      writer->AddArchive(RowSection(i, y),
                         [&](ByteArchive* archive) { TransferRow(archive, &pass, y); });
  }
}

void JointWindows::Load(const StateFile& file, int groups) {
  file.Read(kSection, [this](ByteArchive* archive) { Transfer(archive); });
  for (std::size_t i = 0; i < passes_.size(); ++i) {
    Pass& pass = passes_[i];
    file.Read(PassSection(i), [&](ByteArchive* archive) { TransferPass(archive, &pass, groups); });
    for (int y = gathered_.y0; y < gathered_.y1; ++y)
      file.Read(RowSection(i, y), [&](ByteArchive* archive) { TransferRow(archive, &pass, y); });
  }
}

}  // namespace exphoton
