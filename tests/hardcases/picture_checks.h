// SPDX-License-Identifier: BSD-2-Clause
// Questions about the pictures of a run, one for each seed. Means are decided by equivalence
// (tests/support/equivalence.h), so that noise cannot answer yes.
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
  std::string text;  // what was seen
  // Of a mean over seeds: how often other seeds would fail, if what was measured is the truth.
  std::optional<double> falseAlarm{};
};

// x0,x1,y0,y1, the upper ones excluded; empty: the whole picture.
PixelBounds RegionFrom(const std::vector<std::string>& words);

bool NeedsOther(const std::string& kind);

//   mean TRUTH TOLERANCE        mean of R, G and B over the region; 1% or absolute
//   atleast X, atmost X         of the mean of the first picture
//   spread TOLERANCE            block means (4 x 4 blocks) lie that near to their mean
//   same RUN                    bit for bit
//   scaled RUN FACTOR           bit for bit after multiplication
//   permuted RUN                bit for bit with R, G, B taken as G, B, R
//   near RUN TOLERANCE SHARE    at least this share of pixels within the relative tolerance
//   ratio RUN FACTOR TOLERANCE  mean of the first picture over that of the other's
//   equals RUN TOLERANCE        means over seeds equal
PictureResult CheckPicture(const Check& check, std::span<const Image> pictures,
                           std::span<const Image> others, PixelBounds region);

}  // namespace exphoton::hardcases
