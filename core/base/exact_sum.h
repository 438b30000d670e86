// SPDX-License-Identifier: BSD-2-Clause
// ExactSum adds numbers in fixed point. Its result does not depend on the order of the additions,
// so sums of several threads are the same for any division of the work.
#pragma once

#include <algorithm>
#include <cmath>

namespace exphoton {

class ExactSum {
 public:
  ExactSum() = default;
  ExactSum(double value) { Add(value); }  // implicit, so that it can replace a double

  // Values are rounded to multiples of 2^-44 and clamped to +-2^60. NaN counts as 0.
  void Add(double value) {
    if (value == value) sum_ += Fixed(std::nearbyint(std::clamp(value, -0x1p60, 0x1p60) * 0x1p44));
  }
  ExactSum& operator+=(double value) { return Add(value), *this; }
  ExactSum& operator+=(const ExactSum& other) { return sum_ += other.sum_, *this; }
  operator double() const { return double(sum_) * 0x1p-44; }

 private:
  __extension__ using Fixed = __int128;
  Fixed sum_ = 0;
};

}  // namespace exphoton
