// SPDX-License-Identifier: BSD-2-Clause
// These functions make the sections of a study's report, in page order. Each returns a <section>.
#pragma once

#include <string>

#include "core/app/analysis/analysis.h"

namespace exphoton::study {

std::string PageStyle();  // for screen (light and dark), phone and print

std::string HeadlineSection(const Results& results, const Analysis& analysis);
std::string CurveSection(const Results& results, const Analysis& analysis);
std::string BarSection(const Results& results, const Analysis& analysis);
std::string PictureSection(const std::string& folder, const Results& results,
                           const Analysis& analysis);
std::string PriceSection(const Results& results, const Analysis& analysis);
std::string MapSection(const std::string& folder, const Results& results);
std::string DataSection(const Results& results, const Analysis& analysis);

// Returns a table with horizontal scrolling.
std::string Table(const std::string& head, const std::string& rows);
std::string SectionOf(const std::string& title, const std::string& content);
std::string MeasuredText(const Measured& measured);  // "0.012 ± 0.001"
std::string ColorDot(std::size_t line);              // colour marker of a line
std::string CountText(double count);                 // "120 k"

}  // namespace exphoton::study
