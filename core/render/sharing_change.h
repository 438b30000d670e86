// SPDX-License-Identifier: BSD-2-Clause
// SharingChange receives the difference that shared gathers make to the picture of a pass. It has
// no samples of its own, so Film::SubtractLight gives the picture without sharing.
#pragma once

#include <memory>

#include "core/imaging/film/aov_film.h"
#include "core/imaging/film/film.h"

namespace exphoton {

struct SharingChange {
  // aovs: those of the picture; null: none.
  SharingChange(const Film& picture, const AovFilm* pictureAovs)
      : film(picture.Full(), picture.Crop()),
        aovs(pictureAovs ? std::make_unique<AovFilm>(pictureAovs->Crop(), pictureAovs->Wanted())
                         : nullptr) {}

  void Clear() {
    film.Clear();
    if (aovs) aovs->Clear();
  }

  void Add(const SharingChange& other) {
    film.Add(other.film);
    if (aovs) aovs->Add(*other.aovs);
  }
  void Subtract(const SharingChange& other) {
    film.SubtractLight(other.film);
    if (aovs) aovs->SubtractLight(*other.aovs);
  }
  void Transfer(ByteArchive* archive) {  // saves or loads
    film.Transfer(archive);
    if (aovs) aovs->Transfer(archive);
  }

  Film film;
  std::unique_ptr<AovFilm> aovs;  // the light AOVs and the bias of sharing
};

}  // namespace exphoton
