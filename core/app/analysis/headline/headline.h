// SPDX-License-Identifier: BSD-2-Clause
// WriteHeadline sums up a study in a sentence: the share of time that the fastest integrator needs
// for the same error as the others.
#pragma once

#include "core/app/analysis/analysis.h"

namespace exphoton::study {

// Chooses the contenders, the error that most of them reach, and the times to it. Fills
// contenders, target, toTarget, headline, details and lowerBounds of the analysis.
void WriteHeadline(const Results& results, Analysis* analysis);

// Returns 1 / (error x seconds) relative to another setting, or unknown if the reference is too
// noisy for either setting.
Measured RelativeEfficiency(const Analysis& analysis, const SettingResult& setting,
                            const SettingResult& base);

// Returns a note such as "one rendered 4 times as long would do" if the reference is too noisy for
// this error, and "" otherwise.
std::string ShortfallText(const Reference& reference, double error);

}  // namespace exphoton::study
