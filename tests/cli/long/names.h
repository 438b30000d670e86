// SPDX-License-Identifier: BSD-2-Clause
// The words of command lines, joined with "+".
#pragma once
#include <string>
#include <vector>

namespace exphoton {

using Names = std::vector<std::string>;

inline Names operator+(Names a, const Names& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

}  // namespace exphoton
