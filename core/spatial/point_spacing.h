// SPDX-License-Identifier: BSD-2-Clause
// MeasureSpacing2 estimates the local point density, from which k-NN queries choose their first
// radius.
#pragma once

#include <vector>

#include "core/base/parallel.h"
#include "core/spatial/nearest/nearest_search.h"

namespace exphoton {

// Returns for each run of PointTreeView::kSpacingPoints points the squared radius round the run's
// middle point that is expected to contain one point. The spacing2 of the view is ignored.
std::vector<Real> MeasureSpacing2(PointTreeView view, ThreadPool& threads);

}  // namespace exphoton
