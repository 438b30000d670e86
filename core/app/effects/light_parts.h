// SPDX-License-Identifier: BSD-2-Clause
// LightPartsOf returns the share of each light AOV in the light of a small picture.
#pragma once

#include <string>
#include <vector>

#include "core/imaging/film/aov_film.h"
#include "core/imaging/film/film.h"

namespace exphoton::cli {

struct MeasuredLight {
  std::string name;  // of a light AOV
  double share = 0;  // of the light of the picture
};

// The AOVs are those of the film's samples. Returns one part for each light AOV, or none if the
// picture is black.
std::vector<MeasuredLight> LightPartsOf(const Film& film, const AovFilm& aovs);

}  // namespace exphoton::cli
