// SPDX-License-Identifier: BSD-2-Clause
// ConeDirections: unit directions, one component after the other, and how many of them lie close to
// another direction: counted with the widest vectors that the machine has, to the same number.
#pragma once

#include <span>

#include "core/base/arena.h"
#include "core/math/simd/real16.h"

namespace exphoton {

// Directions to choose from, one component after the other. Rows can be read up to a whole number
// of runs; what fills the last has a limit of 0.
struct DirectionRows {
  const Real *x, *y, *z;
  const Real *value, *limit;  // >= 0, and a number
  std::size_t count;
};

// Loops over runs. One for each width of vectors.
struct ConeLoops {
  // Writes the directions whose value * scale < limit one after the other, and up to a run more;
  // how many there were.
  std::size_t (*choose)(const DirectionRows& from, Real scale, Real* x, Real* y, Real* z);
  // How many of the directions of whole runs end within a chord of w.
  int (*count)(const Real* x, const Real* y, const Real* z, std::size_t count, const Vector3& w,
               Real chord2);
};

class ConeDirections {
 public:
  static constexpr std::size_t kRun = kReal16Lanes;

  ConeDirections() = default;  // none
  // With room for `capacity`, as long as the arena keeps it.
  ConeDirections(std::size_t capacity, Arena* arena);

  void Add(const Vector3& w) {  // unit
    x_[count_] = w.x;
    y_[count_] = w.y;
    z_[count_] = w.z;
    ++count_;
  }
  // Of `from` those whose value * scale < limit.
  void AddChosen(const DirectionRows& from, Real scale);
  void Set(std::size_t i, const Vector3& w) { x_[i] = w.x, y_[i] = w.y, z_[i] = w.z; }
  // To be called after the last change.
  void Finish();

  std::size_t size() const { return count_; }
  Vector3 operator[](std::size_t i) const { return {x_[i], y_[i], z_[i]}; }

  // Whether the i-th ends within a chord of w: |w - axis|^2 <= chord2, chord2 <= 4.
  bool IsWithin(std::size_t i, const Vector3& w, Real chord2) const {
    const Real dx = x_[i] - w.x, dy = y_[i] - w.y, dz = z_[i] - w.z;
    return dx * dx + dy * dy + dz * dz <= chord2;
  }
  int CountWithin(const Vector3& w, Real chord2) const {
    return Fastest().count(x_, y_, z_, WholeRuns(count_), w, chord2);
  }

  // So many directions, as they fill runs.
  static constexpr std::size_t WholeRuns(std::size_t count) {
    return (count + kRun - 1) / kRun * kRun;
  }

  static std::span<const ConeLoops> Loops();  // that this machine can run, the widest last

 private:
  static constexpr Real kFar = 9;

  static const ConeLoops& Fastest() {
    static const ConeLoops& fastest = Loops().back();
    return fastest;
  }

  Real *x_ = nullptr, *y_ = nullptr, *z_ = nullptr;
  std::size_t count_ = 0;
};

}  // namespace exphoton
