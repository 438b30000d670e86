// SPDX-License-Identifier: BSD-2-Clause
// A local fit is a weighted linear regression of gathered light over the fragments around a target
// (Bitterli et al. 2016, "Nonlinearly Weighted First-order Regression for Denoising Monte Carlo
// Renderings", section 3). The features are 1, the position on the film (2) and the tilt of the
// shading normal (2). A neighbour at film distance d has the weight 1 - (d / radius)^2, times its
// number of records.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/math/vec.h"
#include "core/render/sharing/fragment_rows.h"

namespace exphoton {

constexpr int kFitFeatures = 5;  // including the constant
using FitFeatures = std::array<Real, kFitFeatures>;

// FitTarget is the place of a fit. Features are relative to it: at the target they are (1, 0 ...).
struct FitTarget {
  explicit FitTarget(const GatherFragment& fragment);
  FitFeatures FeaturesOf(Point2 samplePosition, const Normal3& sampleNormal) const;

  static constexpr Real kFilmScale = Real(.125);  // so that film features are about 1 at 8 pixels
  Point2 film;
  Point3 p;
  Normal3 n, ng;
  Vector3 s, t;  // tangents, orthogonal to ng
  Real depth;
};

// FitNeighbours lists the fragments around a target, as a structure of arrays, with the records of
// one set or of two sets.
struct FitNeighbours {
  static constexpr std::size_t kRun = 8;
  enum Column { Distance2, U1, U2, U3, U4, Count0, R0, G0, B0, Count1, R1, G1, B1, kColumns };

  void Clear() { size = 0; }
  void Reserve(std::size_t count);  // beyond `size`
  Real* At(int column) { return columns[std::size_t(column)].data(); }
  const Real* At(int column) const { return columns[std::size_t(column)].data(); }

  std::array<std::vector<Real>, kColumns> columns;
  std::size_t size = 0;  // a whole number of runs
};

// The sums of weight * feature_i * feature_j for i <= j, and of weight * feature_i * light.
struct FitMoments {
  std::array<Real, kFitFeatures*(kFitFeatures + 1) / 2> matrix{};
  std::array<std::array<Real, 3>, kFitFeatures> right{};
};

// LocalFitLoops holds the loops, compiled for one SIMD target.
struct LocalFitLoops {
  // Appends the fragments of a range. Those on another surface, and padding, get an infinite
  // distance.
  void (*describe)(const FragmentRows& rows, FragmentRows::Range range, const FitTarget& target,
                   std::span<const FragmentRows::Column> sets, FitNeighbours* out);
  // Adds up the records of one set (0 or 1) within the radius.
  void (*accumulate)(const FitNeighbours& from, Real radius, int set, FitMoments* moments);
};

class LocalFit {
 public:
  // Collects the fragments within `radius` pixels of the target. `sets` are the first columns of
  // one or two sets of records.
  struct Place {
    const FitTarget& target;
    Point2i pixel;
    Real radius;
  };
  static void Collect(const FragmentRows& rows, const Place& place,
                      std::span<const FragmentRows::Column> sets, FitNeighbours* out);

  // Fits the records of one set (0 or 1). The neighbours must reach to `radius`.
  LocalFit(const FitNeighbours& neighbours, Real radius, int set);

  bool IsEmpty() const { return !(total_ > 0); }  // no record had a weight
  Spectrum At(const FitFeatures& features) const;
  const Spectrum& AtTarget() const { return coefficients_[0]; }

  static std::span<const LocalFitLoops* const> Loops();  // for this machine, widest last

 private:
  std::array<Spectrum, kFitFeatures> coefficients_{};
  Real total_ = 0;
};

}  // namespace exphoton
