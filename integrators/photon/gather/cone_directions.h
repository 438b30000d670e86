// SPDX-License-Identifier: BSD-2-Clause
// ConeDirections stores the axes of cones, which are unit directions, as a structure of arrays. It
// counts how many axes lie close to another direction, so how many cones contain that direction. It
// uses the widest SIMD target of the machine; all give the same number.
#pragma once

#include <span>

#include "core/base/arena.h"
#include "core/math/vec.h"

namespace exphoton {

// DirectionRows is a structure of arrays of directions to choose from. Direction i is chosen if
// value[i] * scale < limit[i]. Rows can be read up to a whole number of runs; padding has a limit
// of 0, so it is never chosen.
struct DirectionRows {
  const Real *x, *y, *z;
  const Real *value, *limit;  // >= 0, not NaN
  std::size_t count;
};

// ConeLoops holds the loops over runs, compiled for one SIMD target.
struct ConeLoops {
  // Writes the directions with value * scale < limit, and up to one run of other values after them.
  // Returns the number of chosen directions.
  std::size_t (*choose)(const DirectionRows& from, Real scale, Real* x, Real* y, Real* z);
  // Counts the directions with |axis - w|^2 <= chord2. `count` is a whole number of runs.
  int (*count)(const Real* x, const Real* y, const Real* z, std::size_t count, const Vector3& w,
               Real chord2);
};

class ConeDirections {
 public:
  static constexpr std::size_t kRun = 16;

  ConeDirections() = default;  // no directions
  // Makes room for `capacity` directions, valid as long as the arena keeps it.
  ConeDirections(std::size_t capacity, Arena* arena);

  void Add(const Vector3& w) {  // unit
    x_[count_] = w.x;
    y_[count_] = w.y;
    z_[count_] = w.z;
    ++count_;
  }
  // Adds the directions of `from` with value * scale < limit.
  void AddChosen(const DirectionRows& from, Real scale);
  // Replaces the i-th axis.
  void Set(std::size_t i, const Vector3& w) { x_[i] = w.x, y_[i] = w.y, z_[i] = w.z; }
  // Pads the last run. Must be called after the last change.
  void Finish();

  std::size_t size() const { return count_; }
  Vector3 operator[](std::size_t i) const { return {x_[i], y_[i], z_[i]}; }

  // The relative error of |w - axis|^2, however small the angle is (tests/proofs/cone_chord.gappa).
  static constexpr Real kChordError = Gamma(5);

  // Returns whether the i-th axis lies within a chord of w: |w - axis|^2 <= chord2, chord2 <= 4.
  bool IsWithin(std::size_t i, const Vector3& w, Real chord2) const {
    const Real dx = x_[i] - w.x, dy = y_[i] - w.y, dz = z_[i] - w.z;
    return dx * dx + dy * dy + dz * dz <= chord2;
  }
  int CountWithin(const Vector3& w, Real chord2) const {
    return Fastest().count(x_, y_, z_, WholeRuns(count_), w, chord2);
  }

  // Rounds `count` up to whole runs.
  static constexpr std::size_t WholeRuns(std::size_t count) {
    return (count + kRun - 1) / kRun * kRun;
  }

  static std::span<const ConeLoops* const> Loops();  // for this machine, widest last

 private:
  static constexpr Real kFar = 9;

  static const ConeLoops& Fastest() {
    static const ConeLoops& fastest = *Loops().back();
    return fastest;
  }

  Real *x_ = nullptr, *y_ = nullptr, *z_ = nullptr;
  std::size_t count_ = 0;
};

}  // namespace exphoton
