// SPDX-License-Identifier: BSD-2-Clause
// ConeAxes: unit directions, one component after the other, and how many of them lie close to
// another direction: counted with the widest vectors that the machine has, to the same number.
#pragma once

#include <span>

#include "core/base/arena.h"
#include "core/math/vec.h"

namespace exphoton {

class ConeAxes {
 public:
  ConeAxes() = default;  // none
  // With room for `capacity`, as long as the arena keeps it.
  ConeAxes(std::size_t capacity, Arena* arena) {
    capacity = (capacity + kRun - 1) / kRun * kRun;
    x_ = arena->Room<Real>(3 * capacity);
    y_ = x_ + capacity;
    z_ = y_ + capacity;
  }

  // w: unit. The next one takes its place where it is not wanted.
  void Add(const Vector3& w, bool isWanted = true) {
    x_[count_] = w.x;
    y_[count_] = w.y;
    z_[count_] = w.z;
    count_ += isWanted;
  }
  // To be called after the last Add.
  void Finish() {
    // Runs are whole: what fills the last is far from every direction.
    for (std::size_t i = count_; i < PaddedSize(); ++i) x_[i] = y_[i] = z_[i] = kFar;
  }

  std::size_t size() const { return count_; }
  Vector3 operator[](std::size_t i) const { return {x_[i], y_[i], z_[i]}; }

  // Whether the i-th ends within a chord of w: |w - axis|^2 <= chord2, chord2 <= 4.
  bool IsWithin(std::size_t i, const Vector3& w, Real chord2) const {
    const Real dx = x_[i] - w.x, dy = y_[i] - w.y, dz = z_[i] - w.z;
    return dx * dx + dy * dy + dz * dz <= chord2;
  }
  int CountWithin(const Vector3& w, Real chord2) const {
    return Fastest()(x_, y_, z_, PaddedSize(), w, chord2);
  }

  // Of a multiple of kRun directions. One for each width of vectors, for tests.
  using Counter = int (*)(const Real* x, const Real* y, const Real* z, std::size_t count,
                          const Vector3& w, Real chord2);
  static std::span<const Counter> Counters();  // that this machine can run, the widest last

 private:
  static constexpr std::size_t kRun = 16;
  static constexpr Real kFar = 9;

  static Counter Fastest() {
    static const Counter counter = Counters().back();
    return counter;
  }
  std::size_t PaddedSize() const { return (count_ + kRun - 1) / kRun * kRun; }

  Real *x_ = nullptr, *y_ = nullptr, *z_ = nullptr;
  std::size_t count_ = 0;
};

}  // namespace exphoton
