// SPDX-License-Identifier: BSD-2-Clause
// ReadMapTexels reads the image of a light: an environment, an intensity distribution or a slide.
#pragma once

#include <string>
#include <vector>

#include "core/math/spectrum.h"
#include "core/plugin.h"

namespace exphoton {

struct MapTexels {
  std::vector<Spectrum> texels;  // width * height, at least one; row by row from the top
  int width = 0, height = 0;

  bool IsUniform() const;  // all texels are equal
};

// Reads the channels R, G and B. Negative and non-finite values become 0, with a warning. Throws
// ParamError for parameter "mapname" if the image cannot be read or lacks a channel.
MapTexels ReadMapTexels(const std::string& name, const LightContext& context);

}  // namespace exphoton
