// SPDX-License-Identifier: BSD-2-Clause
#include "core/render/passes/unshared/unshared_picture.h"

#include <limits>

#include "core/render/certificate/corrections.h"
#include "core/render/sharing/sharing_plan.h"
#include "core/render/splat_weights.h"

namespace exphoton {
namespace {

constexpr std::size_t kMostPixels = std::size_t(1) << 21;
// The rule that limits the samples is the rule of the shared picture.
constexpr PassSum::Limits kNoLimits{std::nullopt, std::numeric_limits<std::int64_t>::max()};

// The sections of a state.
constexpr const char* kSumSection = "unshared";
constexpr const char* kFilmSection = "unshared film";
constexpr const char* kAovSection = "unshared aovs";
constexpr const char* kPassSection = "pass sharing";
constexpr const char* kPassAovSection = "pass sharing aovs";

}  // namespace

std::unique_ptr<UnsharedPicture> UnsharedPicture::Follow(const RenderJob& job, PassParts* parts,
                                                         PassSum* sum) {
  Corrections* const corrections = parts->Options().corrections;
  if (!corrections || !IsKnown(job)) return nullptr;
  auto unshared = std::make_unique<UnsharedPicture>(job.film, parts->Aovs());
  parts->SetSharingChange(unshared->OfPass());
  corrections->KeepSharingApart();
  sum->UseLevelsOf(unshared->sum_);
  return unshared;
}

bool UnsharedPicture::IsKnown(const RenderJob& job) {
  return PlanSharing(job.integrator, job.scene, job.camera).isOn && !SplatWeights::Of(job.filter) &&
         job.film.PixelCount() <= kMostPixels;
}

UnsharedPicture::UnsharedPicture(const Film& picture, const AovFilm* aovs)
    : pass_(picture, aovs),
      picture_(picture.Full(), picture.Crop()),
      aovs_(aovs ? std::make_unique<AovFilm>(aovs->Crop(), aovs->Wanted()) : nullptr),
      sum_(&picture_, kNoLimits) {}

void UnsharedPicture::Add(const Film& pass, std::int64_t samplesPerPixel, int group) {
  Film own = pass;
  own.SubtractLight(pass_.film);
  sum_.Add(own, samplesPerPixel, group);
  if (aovs_) aovs_->Add(*pass_.aovs);
  pass_.Clear();
}

void UnsharedPicture::AddChange(const AovFilm* light) {
  if (aovs_) aovs_->Add(*light);
}

std::optional<SharingBias> UnsharedPicture::BiasOf(const PassSum& shared,
                                                   GroupSamples samples) const {
  return BiasOfSharing(shared.GroupSums(), sum_.GroupSums(), samples);
}

void UnsharedPicture::Replace(Film* picture, AovFilm* aovs, PassSum* sum) const {
  *picture = picture_;
  if (aovs && aovs_) aovs->SubtractLight(*aovs_);
  sum->TakeNoise(sum_);
}

void UnsharedPicture::TransferSum(ByteArchive* archive) {
  sum_.TransferCounts(archive);
  sum_.TransferNoise(archive);
}

void UnsharedPicture::Save(StateWriter* writer) {
  writer->AddArchive(kSumSection, [this](ByteArchive* archive) { TransferSum(archive); });
  SaveSection(kFilmSection, picture_, writer);
  SaveSection(kPassSection, pass_.film, writer);
  if (!aovs_) return;
  SaveSection(kAovSection, *aovs_, writer);
  SaveSection(kPassAovSection, *pass_.aovs, writer);
}

void UnsharedPicture::Load(const StateFile& file, const PassSum& shared) {
  file.Read(kSumSection, [&](ByteArchive* archive) {
    TransferSum(archive);
    if (!sum_.HasSamePasses(shared)) throw ArchiveError("it has other passes than the picture");
  });
  LoadSection(kFilmSection, &picture_, file);
  LoadSection(kPassSection, &pass_.film, file);
  if (!aovs_) return;
  LoadSection(kAovSection, aovs_.get(), file);
  LoadSection(kPassAovSection, pass_.aovs.get(), file);
}

}  // namespace exphoton
