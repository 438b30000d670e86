// SPDX-License-Identifier: BSD-2-Clause
// The sentence that a study comes down to: how long each line takes to one error.
#pragma once

#include "core/study/analysis.h"

namespace exphoton::study {

// Chooses the error, finds every line's time to it, and fills target, toTarget and headline.
void WriteHeadline(const Results& results, Analysis* analysis);

// "a reference rendered 4 times as long would do", for errors that the reference is too noisy for;
// empty where it is good enough.
std::string ShortfallText(const Reference& reference, double error);

}  // namespace exphoton::study
