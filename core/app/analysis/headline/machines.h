// SPDX-License-Identifier: BSD-2-Clause
// MachinesText says on which machines the tasks of a study ran, and whether their times can be
// compared.
#pragma once

#include <string>

#include "core/app/analysis/results.h"

namespace exphoton::study {

// Returns one or two sentences, or "" if the study ran as one process after the other on one
// machine. Times can be compared if all renders ran alone on machines with the same processor.
std::string MachinesText(const Results& results);

}  // namespace exphoton::study
