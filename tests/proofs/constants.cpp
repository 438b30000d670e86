// SPDX-License-Identifier: BSD-2-Clause
// Prints the constants of the code that the proofs beside this file use, as hexadecimal numbers.
// Names that end in Rounded allow for the rounding of the computed bound.
#include <cstdio>

#include "core/geometry/triangle_single.h"
#include "integrators/photon/gather/cone_directions.h"
#include "integrators/photon/maps/photon_map.h"

int main() {
  using namespace exphoton;
  const auto print = [](const char* name, double value) { std::printf("%s %a\n", name, value); };
  const double rounding = 0x1p-20, volume = double(LargeVolume::of[0]);
  print("kSingleError", double(kSingleError));
  print("kBeyond", double(kBeyond));
  print("kVolumeErrorRounded", double(kVolumeError) * (1 - rounding));
  print("leastVolumeRounded", volume * (1 - rounding));
  print("leastVolumeLess", volume * (1 - 0x1p-10));
  print("kAheadMargin", kAheadMargin);
  print("kShear", 0x4.01p-24);
  print("large0", volume * (1 - rounding));
  print("large1", double(LargeVolume::of[1]) * (1 - rounding));
  print("large2", double(LargeVolume::of[2]) * (1 - rounding));
  print("kChordError", double(ConeDirections::kChordError));
  print("steepness", double(1 / PhotonMap::kFlatness));
  print("kFlattenedError", double(PhotonMap::kFlattenedError));
}
