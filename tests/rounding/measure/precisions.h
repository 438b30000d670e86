// SPDX-License-Identifier: BSD-2-Clause
// Pictures of one scene in three precisions: by a build in float, by a build in double, and by the
// latter with each operation in double rounded up or down at random. The distance of the last two
// is the error of double, in the place of a picture in long double. All use the same random bits.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "tests/rounding/measure/spread.h"

namespace exphoton::rounding {

// ScenePictures holds R, G, B of each pixel in double precision. The first picture is rounded to
// nearest, the others at random.
struct ScenePictures {
  std::string name;
  std::vector<std::vector<double>> pictures;
};
// One scene a block: its name, the number of pictures, and a line of hexadecimal numbers for each.
void Write(const ScenePictures& scene, std::ostream& out);
std::vector<ScenePictures> ReadPictures(std::istream& in);

// Distance says how far pictures are from a picture of higher precision. The error of a pixel is
// relative to the sum of its value and .01 of the mean, as in SpreadOf.
struct Distance {
  double median = 0;   // of the pixels' errors
  double between = 0;  // the share of pixels with an error above kRounded and up to kDecided
  double decided = 0;  // the share of pixels with an error above kDecided
};
// A larger error has another reason than roundings in double, which are 2^-53: a decision that
// hardly changes the pixel, or an intermediate result in single precision.
inline constexpr double kRounded = 0x1p-36;

// Each pixel has the largest error of all pictures.
Distance DistanceOf(const std::vector<std::vector<double>>& pictures,
                    const std::vector<double>& truth);

struct PrecisionRow {
  std::string name;
  Distance inFloat, inDouble;
  // log2 of the ratio of the medians; 0 if one of them is 0. Roundings have 2^-29.
  double Shrinks() const;
};
// Compares the scenes that both lists have, and that have equally many pixels. Scenes of one name
// are compared in their order.
std::vector<PrecisionRow> ComparePrecisions(const std::vector<ScenePictures>& inFloat,
                                            const std::vector<ScenePictures>& inDouble);
// Medians are in epsilons of their precision (2^-23 and 2^-52).
std::string TextOf(const std::vector<PrecisionRow>& rows);

}  // namespace exphoton::rounding
