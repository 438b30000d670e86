// SPDX-License-Identifier: BSD-2-Clause
#include "core/app/effects/light_parts.h"

#include "core/imaging/image.h"

namespace exphoton::cli {

std::vector<MeasuredLight> LightPartsOf(const Film& film, const AovFilm& aovs) {
  Image image = film.ToImage(false);
  const std::size_t first = image.channels.size();
  aovs.AppendTo(film, false, &image);
  const auto sumFrom = [&](std::size_t channel) {
    double sum = 0;
    for (int y = 0; y < image.Height(); ++y)
      for (int x = 0; x < image.Width(); ++x)
        for (std::size_t c = 0; c < 3; ++c) sum += double(image.At(x, y, int(channel + c)));
    return sum;
  };
  std::vector<MeasuredLight> parts;
  const double whole = sumFrom(0);
  if (!(whole > 0)) return parts;
  const std::vector<Aov> list = (aovs.Wanted() & kLightAovs).List();
  for (std::size_t i = 0; i < list.size(); ++i)
    parts.push_back({GetAovInfo(list[i]).name, sumFrom(first + 3 * i) / whole});
  return parts;
}

}  // namespace exphoton::cli
