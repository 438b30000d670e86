// SPDX-License-Identifier: BSD-2-Clause
// CheckSampler checks the numbers of a sampler: their range and distribution, that no two samples
// have the same, and that they follow from the key of a sample alone.
#pragma once

#include "core/app/checks/check.h"
#include "core/sampling/sampler.h"

namespace exphoton {

Checks CheckSampler(const Sampler& sampler, std::uint64_t seed);

}  // namespace exphoton
