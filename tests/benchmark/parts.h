// SPDX-License-Identifier: BSD-2-Clause
// Each of these functions registers the contests of one part of the benchmark program.
#pragma once

namespace exphoton {

void AddRays();
void AddLookups();
void AddBuilds();
void AddParsing();

}  // namespace exphoton
