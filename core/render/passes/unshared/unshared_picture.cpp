// SPDX-License-Identifier: BSD-2-Clause
#include "core/render/passes/unshared/unshared_picture.h"

#include "core/render/certificate/corrections.h"
#include "core/render/sharing/sharing_plan.h"
#include "core/render/splat_weights.h"

namespace exphoton {
namespace {

constexpr std::size_t kMostPixels = std::size_t(1) << 21;

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
      sum_(&picture_, {}) {}

void UnsharedPicture::Add(const Film& pass, std::int64_t samplesPerPixel, int group) {
  Film own = pass;
  own.SubtractLight(pass_.film);
  sum_.Add(own, samplesPerPixel, group);
  if (aovs_) aovs_->Add(*pass_.aovs);
  pass_.Clear();
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

}  // namespace exphoton
