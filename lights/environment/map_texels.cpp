// SPDX-License-Identifier: BSD-2-Clause
// ReadMapTexels converts the pixels of an image to spectra and counts values that are no radiance.
#include "lights/environment/map_texels.h"

#include <algorithm>
#include <cmath>

#include "core/imaging/image.h"
#include "core/params/scene_path.h"

namespace exphoton {

bool MapTexels::IsUniform() const {
  return std::all_of(texels.begin(), texels.end(),
                     [&](const Spectrum& s) { return s == texels.front(); });
}

MapTexels ReadMapTexels(const std::string& name, const LightContext& context) {
  Image image;
  try {
    image = ReadImage(name);
  } catch (const ImageError& error) {
    throw ParamError{"mapname", UnreadableFileText(name, error.what()), ""};
  }
  const int channels[3] = {image.FindChannel("R"), image.FindChannel("G"), image.FindChannel("B")};
  if (channels[0] < 0 || channels[1] < 0 || channels[2] < 0)
    throw ParamError{"mapname", "\"" + name + "\" lacks one of the channels R, G, B", ""};
  long long bad = 0;
  MapTexels map{{}, image.Width(), image.Height()};
  map.texels.resize(std::size_t(map.width) * std::size_t(map.height));
  if (map.texels.empty()) throw ParamError{"mapname", "names an image without pixels", ""};
  for (std::size_t i = 0; i < map.texels.size(); ++i) {
    const int x = int(i % std::size_t(map.width)), y = int(i / std::size_t(map.width));
    for (int c = 0; c < 3; ++c) {
      const float value = image.At(x, y, channels[c]);
      const bool isRadiance = std::isfinite(value) && value >= 0;
      if (!isRadiance) ++bad;
      map.texels[i][c] = isRadiance ? Real(value) : 0;
    }
  }
  if (bad > 0)
    context.log.Warning("\"" + name + "\": " + std::to_string(bad) +
                            " values are negative or not finite; they count as 0",
                        context.where);
  return map;
}

}  // namespace exphoton
