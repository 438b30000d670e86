// SPDX-License-Identifier: BSD-2-Clause
// These functions compare the times of photon integrators with lower bounds, which a study measures
// by renders with one camera sample and one gather ray a pixel.
#pragma once

#include <string>
#include <vector>

#include "core/app/analysis/analysis.h"

namespace exphoton::study {

inline constexpr const char* kLowerBoundMeaning =
    "the time of the photon maps, one camera sample and one gather ray a pixel";

// Returns the settings whose lower bounds a study measures, as indices of Results::settings: one
// for each of exphotonmap and photonmap that traced gather rays. It is the last setting of the
// integrator's front that is not below the headline's error, so the integrator's time in the
// headline is not below the time of this setting. Without such an error it is the most accurate
// one.
std::vector<std::size_t> SettingsForLowerBounds(const Results& results, const Analysis& analysis);

// Returns the setting with one camera sample and one gather ray a pixel. Its gathers are not shared
// and its edges have no further samples.
Setting LowerBoundSetting(const Setting& setting);

// Returns such a setting for each photon integrator of a plan that may trace gather rays.
std::vector<Setting> ExpectedLowerBounds(const std::vector<Setting>& plan);

// Returns "exphotonmap takes 2.9 times the lower bound of 0.41 s, photonmap 20 times its own of
// 0.42 s.", or "" if there is no bound. The times are those in the details of the headline.
std::string LowerBoundText(const Results& results, const Analysis& analysis);

}  // namespace exphoton::study
