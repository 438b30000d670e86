// SPDX-License-Identifier: BSD-2-Clause
// How densely points lie, measured at every few of them: where searches for the nearest begin.
#pragma once

#include <vector>

#include "core/base/parallel.h"
#include "core/spatial/nearest/nearest_search.h"

namespace exphoton {

// For each run of PointTreeView::kSpacingPoints points of the view (whose own spacing does not
// count) the squared radius round the middle one in which one point is to be expected.
std::vector<Real> MeasureSpacing2(PointTreeView view, ThreadPool& threads);

}  // namespace exphoton
