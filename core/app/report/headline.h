// SPDX-License-Identifier: BSD-2-Clause
// The sentence that a study comes down to: how long each line takes to one error.
#pragma once

#include "core/app/analysis/analysis.h"

namespace exphoton::study {

// Chooses the error, finds every line's time to it, and fills target, toTarget and headline.
void WriteHeadline(const Results& results, Analysis* analysis);

// 1 / (error x seconds), as a multiple of another setting's; unknown where the reference is too
// noisy for either.
Measured RelativeEfficiency(const Analysis& analysis, const SettingResult& setting,
                            const SettingResult& base);

// "a reference rendered 4 times as long would do", for errors that the reference is too noisy for;
// empty where it is good enough.
std::string ShortfallText(const Reference& reference, double error);

}  // namespace exphoton::study
