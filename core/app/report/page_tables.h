// SPDX-License-Identifier: BSD-2-Clause
// These functions make cells of tables. ParameterColumns gives each parameter a column.
#pragma once

#include <string>
#include <vector>

#include "core/app/analysis/analysis.h"
#include "core/app/report/template.h"

namespace exphoton::study {

Html MeasuredCell(const Measured& measured);     // "0.200 ± 0.005", the error in small type
Html ThousandthsCell(const Measured& measured);  // the same of 1000 times the value

// ParameterColumns are the parameters that differ between the settings of a table.
class ParameterColumns {
 public:
  // `shown` are indices of Analysis::settings.
  ParameterColumns(const Results& results, const Analysis& analysis,
                   const std::vector<std::size_t>& shown);
  std::size_t Count() const { return names_.size(); }
  Html Heads() const;
  Html Cells(const SettingResult& setting) const;

 private:
  const Results& results_;
  std::vector<std::string> names_;
};

// Returns the indices of all settings, line by line.
std::vector<std::size_t> AllByLine(const Analysis& analysis);
// Returns the settings on each line's own front, line by line.
std::vector<std::size_t> FrontsByLine(const Analysis& analysis);
// Returns the index of the setting's line.
std::size_t LineOf(const Analysis& analysis, std::size_t setting);
// Returns marker and label of the setting's line.
Html LineCell(const Analysis& analysis, std::size_t setting);

}  // namespace exphoton::study
