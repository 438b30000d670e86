// SPDX-License-Identifier: BSD-2-Clause
// The parts of the benchmark program; each registers its contests.
#pragma once

namespace exphoton {

void AddRays();
void AddLookups();
void AddBuilds();
void AddParsing();

}  // namespace exphoton
