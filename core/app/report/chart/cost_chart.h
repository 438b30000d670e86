// SPDX-License-Identifier: BSD-2-Clause
// CostChart draws error against seconds, both logarithmic. Thin lines join settings that differ in
// their samples only, and a step shows the smallest error of each line for a given time.
#pragma once

#include "core/app/analysis/analysis.h"
#include "core/app/report/template.h"

namespace exphoton::study {

// ChartShape is the size of a chart in CSS pixels. Narrow charts are for phones.
struct ChartShape {
  double width, height;
  bool isNarrow;
};
inline constexpr ChartShape kWideChart{830, 322, false}, kFullChart{1248, 322, false},
    kNarrowChart{360, 400, true};

// The settings that nothing beats in both time and error have numbers in the order of their time.
Html CostChart(const Results& results, const Analysis& analysis, const ChartShape& shape);

}  // namespace exphoton::study
