// SPDX-License-Identifier: BSD-2-Clause
// These functions format the numbers of a study for people: "9.8 s", "0.200 ± 0.005", "1/9".
#pragma once

#include <string>

#include "core/app/analysis/separation.h"

namespace exphoton::study {

std::string SecondsText(double seconds);                // "9.8 s", "1.3 min"
std::string ShortNumber(double value, int digits = 2);  // "0.012", "2.9×10⁻⁴"
std::string CountText(double count);                    // "120 k"
std::string Superscript(int number);                    // "⁻³"

// RoundedPair is a value and its standard error, rounded to the same decimal. The error has one
// digit, and the value at most five; `error` is empty if it is unknown.
struct RoundedPair {
  std::string value, error;
};
RoundedPair RoundTogether(const Measured& measured);
// Returns "0.200 ± 0.005", or "0.2" if the standard error is unknown, or "–".
std::string MeasuredText(const Measured& measured);

// Returns the change that a factor means, in per cent: "−68 ± 3 %".
std::string ChangeText(const Measured& factor);
std::string SignedSecondsText(const Measured& seconds);  // "+1.5 ± 0.1 s"

// Returns a share below 1 as people say it: "1/43", or "42 %" if it is larger than 1/4. Returns "–"
// if it is unknown.
std::string ShareText(double share);

}  // namespace exphoton::study
