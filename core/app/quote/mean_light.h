// SPDX-License-Identifier: BSD-2-Clause
// MeanLight is the mean of a picture in two independent halves, with its standard error. Pixels
// count by their light, so the error follows from the differences of light between the halves. The
// noise part of relMSE says little about it, because dark pixels dominate that.
#pragma once

#include <limits>
#include <span>

#include "core/imaging/film/film.h"

namespace exphoton::cli {

struct MeanLight {
  double mean = 0;           // of three channels; 0: there is no light
  double relativeError = 0;  // standard error, as a share of the mean
  // Degrees of freedom of the error. Few cells of pixels may have most of it, for example where one
  // sample found a rare bright path. Its size is then hardly known.
  double freedom = std::numeric_limits<double>::infinity();
};

// Each span has one value per pixel, for rows of this width. Both have the same size.
MeanLight MeanOfHalves(std::span<const double> first, std::span<const double> second,
                       std::size_t width);
MeanLight MeanOfHalves(const Film& first, const Film& second);

}  // namespace exphoton::cli
