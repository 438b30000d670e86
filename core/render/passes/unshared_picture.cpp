// SPDX-License-Identifier: BSD-2-Clause
#include "core/render/passes/unshared_picture.h"

namespace exphoton {

UnsharedPicture::UnsharedPicture(const Film& picture, const AovFilm* aovs)
    : pass_(picture, aovs),
      picture_(picture.Full(), picture.Crop()),
      aovs_(aovs ? std::make_unique<AovFilm>(aovs->Crop(), aovs->Wanted()) : nullptr),
      sum_(&picture_, {}) {}

void UnsharedPicture::Add(Film* pass, std::int64_t samplesPerPixel, int group) {
  pass->SubtractLight(pass_.film);
  sum_.Add(*pass, samplesPerPixel, group);
  if (aovs_) aovs_->Add(*pass_.aovs);
  pass_.Clear();
}

void UnsharedPicture::Replace(Film* picture, AovFilm* aovs, PassSum* sum) const {
  *picture = picture_;
  if (aovs && aovs_) aovs->SubtractLight(*aovs_);
  sum->TakeNoise(sum_);
}

}  // namespace exphoton
