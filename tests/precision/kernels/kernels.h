// SPDX-License-Identifier: BSD-2-Clause
// The same formulas of the core in three precisions. kernels.cpp is compiled once for each, with
// the namespace of the core renamed, so that all three are in one program.
#pragma once

#include <string>
#include <vector>

namespace precision {

struct Value {
  std::string name;
  long double value;
};
// u holds eight variates that are multiples of 2^-24, exact in each precision.
std::vector<Value> ComputeInFloat(const double* u);
std::vector<Value> ComputeInDouble(const double* u);
std::vector<Value> ComputeInLongDouble(const double* u);

}  // namespace precision
