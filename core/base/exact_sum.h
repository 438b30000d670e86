// SPDX-License-Identifier: BSD-2-Clause
// ExactSum adds non-negative numbers in fixed point. Its result does not depend on the order of the
// additions, so sums of several threads are the same for any division of the work.
#pragma once

#include <algorithm>

namespace exphoton {

class ExactSum {
 public:
  ExactSum() = default;
  ExactSum(double value) { Add(value); }  // implicit, so that it can replace a double

  // Values below 2^-44 are rounded to 0 or 2^-44, and values above 2^60 count as 2^60. NaN and
  // negative values count as 0.
  void Add(double value) {
    if (value > 0) sum_ += Fixed(std::min(value, 0x1p60) * 0x1p44 + .5);
  }
  ExactSum& operator+=(double value) { return Add(value), *this; }
  ExactSum& operator+=(const ExactSum& other) { return sum_ += other.sum_, *this; }
  operator double() const { return double(sum_) * 0x1p-44; }

 private:
  __extension__ using Fixed = unsigned __int128;
  Fixed sum_ = 0;
};

}  // namespace exphoton
