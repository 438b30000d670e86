// SPDX-License-Identifier: BSD-2-Clause
// Gallery shows settings as figures: the picture of the first seed with enlarged parts, and maps of
// its error. The parts are where these pictures differ most from the reference.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/app/analysis/analysis.h"
#include "core/app/report/template.h"

namespace exphoton::study {

// Shot is a setting to show, and its line.
struct Shot {
  std::size_t line, setting;  // indices of Analysis::lines and Analysis::settings
};

// Returns the time at which pictures are compared: the shortest time to the headline's error, or
// else the median time.
double CommonTime(const Analysis& analysis);
// Return the setting of a line's front with the time, or the error, nearest to the value by ratio.
// At equal time the picture need not be useful: what a line shows after this time is the answer.
Shot NearestInTime(const Analysis& analysis, std::size_t line, double seconds);
Shot NearestInError(const Analysis& analysis, std::size_t line, double error);

// Returns "about 12 times as long" and the like if the ratio is above 2 or below 1/2, or else "".
std::string OffText(double ratio, const char* more, const char* less);

class Gallery {
 public:
  // `shots` choose the enlarged parts, unless the study names some.
  Gallery(const std::string& folder, const Results& results, const Analysis& analysis,
          const std::vector<Shot>& shots);

  // Return figures of the first screen: the picture with its enlarged parts inside.
  Html Poster(const Shot& shot, const std::string& remark) const;
  Html ReferencePoster() const;

  // Return figures with the picture, the enlarged parts, the signed error and the FLIP map.
  Html Comparison(const Shot& shot, const std::string& remark) const;
  Html ReferenceComparison() const;

 private:
  Image Read(std::size_t setting) const;
  Html Crops(const Image& image, const std::string& of) const;
  Html Frames() const;
  // Returns CSS classes that put the enlarged parts where they cover least of their originals.
  std::string PosterKind() const;
  Html Shown(const Image& image, const std::string& alt) const;
  Html ErrorMaps(const Image& reference, const Image& image, const std::string& of) const;
  Html Caption(const Shot& shot, const std::string& remark) const;

  const std::string& folder_;
  const Results& results_;
  const Analysis& analysis_;
  Image reference_;
  double scale_ = 1;
  bool isTall_ = false;  // enlarged parts are beside the picture
  std::vector<std::array<double, 4>> crops_;
};

// Returns the legends of the signed error and of the FLIP map.
Html ErrorLegends();

}  // namespace exphoton::study
