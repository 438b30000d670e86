// SPDX-License-Identifier: BSD-2-Clause
// These functions make the sections of a study's report, in page order. Each returns a <section>.
#pragma once

#include <string>

#include "core/app/analysis/analysis.h"
#include "core/app/report/template.h"

namespace exphoton::study {

Html HeadlineSection(const Results& results, const Analysis& analysis);
Html CurveSection(const Results& results, const Analysis& analysis);
Html BarSection(const Results& results, const Analysis& analysis);
Html PictureSection(const std::string& folder, const Results& results, const Analysis& analysis);
Html PriceSection(const Results& results, const Analysis& analysis);
Html MapSection(const std::string& folder, const Results& results);
Html DataSection(const Results& results, const Analysis& analysis);

Html MeasuredText(const Measured& measured);  // "0.012 ± 0.001"
Html LineMarker(std::size_t line);            // colour and shape of a line
std::string CountText(double count);          // "120 k"

}  // namespace exphoton::study
