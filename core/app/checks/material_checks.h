// SPDX-License-Identifier: BSD-2-Clause
// CheckMaterial checks the BSDF that a material makes on a flat surface: energy, samples against
// their density and value, reciprocity, and that light and cameras see the same.
#pragma once

#include "core/app/checks/check.h"
#include "core/scattering/material.h"

namespace exphoton {

Checks CheckMaterial(const Material& material, std::uint64_t seed);

}  // namespace exphoton
