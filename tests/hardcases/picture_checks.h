// SPDX-License-Identifier: BSD-2-Clause
// CheckPicture checks the pictures of a run, one for each seed. Means are compared by equivalence
// (tests/support/equivalence.h), so noise cannot make a check pass.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/imaging/image.h"
#include "tests/hardcases/case_file.h"

namespace exphoton::hardcases {

struct PictureResult {
  bool isRight = false;
  std::string text;  // the measured values
  // For a mean over seeds: the probability that other seeds fail, if the measured mean is the
  // truth.
  std::optional<double> falseAlarm{};
};

// Converts x0 x1 y0 y1, with the upper bounds excluded. An empty region is the whole picture.
PixelBounds RegionFrom(const std::vector<std::string>& words);

bool NeedsOther(const std::string& kind);

// CheckPicture evaluates one check:
//   mean TRUTH TOLERANCE        mean of R, G and B over the region; 1% or absolute
//   atleast X, atmost X         bound on the mean of the first picture
//   spread TOLERANCE            each of 4 x 4 block means is within the tolerance of their mean
//   same RUN                    bit for bit
//   scaled RUN FACTOR           bit for bit after multiplication
//   permuted RUN                bit for bit with R, G, B taken as G, B, R
//   near RUN TOLERANCE SHARE    at least this share of pixels within the relative tolerance
//   ratio RUN FACTOR TOLERANCE  mean of the first picture over the mean of the other's first
//   equals RUN TOLERANCE        means over seeds equal
PictureResult CheckPicture(const Check& check, std::span<const Image> pictures,
                           std::span<const Image> others, PixelBounds region);

}  // namespace exphoton::hardcases
