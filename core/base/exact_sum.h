// SPDX-License-Identifier: BSD-2-Clause
// ExactSum adds numbers in fixed point. Its result does not depend on the order of the additions,
// so sums of several threads are the same for any division of the work.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>

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
  // Saves or loads the sum without rounding (core/files/byte_archive.h).
  template <class Archive>
  void Transfer(Archive* archive) {
    archive->Values(&sum_);
  }

 private:
  __extension__ using Fixed = __int128;
  Fixed sum_ = 0;
};

// WideExactSum is an ExactSum for values of any size, such as light in scenes with very bright or
// very dim lamps. Values from 2^-40 to 2^40 are rounded to multiples of 2^-64. Smaller and larger
// ones, which are rare, have sums of their own, with steps of 2^-148 and 2^17: a value keeps 24
// bits, unless it is below 2^-124. Up to 2^22 values fit, each below 2^121.
class WideExactSum {
 public:
  WideExactSum() = default;
  WideExactSum(const WideExactSum& other)
      : middle_(other.middle_),
        others_(other.others_ ? std::make_unique<Others>(*other.others_) : nullptr) {}
  WideExactSum& operator=(const WideExactSum&) = delete;

  void Add(double value) {
    const double size = std::abs(value);
    if (size >= 0x1p-40 && size < 0x1p40) {
      middle_ += Round(value * 0x1p64);
    } else if (size > 0) {  // no NaN
      if (!others_) others_ = std::make_unique<Others>();
      if (size < 1)
        others_->small += Round(value * 0x1p148);
      else
        others_->large += Round(std::clamp(value, -0x1p121, 0x1p121) * 0x1p-17);
    }
  }
  void Add(const WideExactSum& other) {
    middle_ += other.middle_;
    if (!other.others_) return;
    if (!others_) others_ = std::make_unique<Others>();
    others_->small += other.others_->small;
    others_->large += other.others_->large;
  }
  double Total() const {
    const double middle = double(middle_) * 0x1p-64;
    if (!others_) return middle;
    return double(others_->large) * 0x1p17 + (middle + double(others_->small) * 0x1p-148);
  }
  // Saves or loads the sum without rounding (core/files/byte_archive.h).
  template <class Archive>
  void Transfer(Archive* archive) {
    char hasOthers = others_ ? 1 : 0;
    archive->Values(&middle_, &hasOthers);
    if (archive->IsLoading()) others_ = hasOthers ? std::make_unique<Others>() : nullptr;
    if (others_) archive->Values(&others_->small, &others_->large);
  }

 private:
  __extension__ using Fixed = __int128;
  struct Others {
    Fixed small = 0, large = 0;
  };
  static Fixed Round(double value) { return Fixed(std::nearbyint(value)); }

  Fixed middle_ = 0;
  std::unique_ptr<Others> others_;  // null: no such value was added
};

}  // namespace exphoton
