// SPDX-License-Identifier: BSD-2-Clause
// BudgetRecord is the error budget of an integrator as a study keeps it: texts for its page.
#pragma once

#include <string>
#include <vector>

namespace exphoton::study {

struct BudgetRecord {
  // A part, or their sum, or the measured error.
  struct Row {
    std::string name;
    std::string value, halfWidth;  // relMSE, and half of its 95 % interval
    std::string share;             // of the sum; "": none
    std::string halving;           // what half of the part costs, and how; "": nothing is known
  };
  std::string integrator;
  std::string headline;
  std::vector<Row> rows;
  std::vector<std::string> notes;  // phrases
};

}  // namespace exphoton::study
