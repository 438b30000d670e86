// SPDX-License-Identifier: BSD-2-Clause
// A local fit is a weighted linear regression of gathered light over the fragments around a target
// (Bitterli et al. 2016, "Nonlinearly Weighted First-order Regression for Denoising Monte Carlo
// Renderings", section 3). The features are 1, the position on the film (2) and the tilt of the
// shading normal (2). A neighbour at film distance d has the weight 1 - (d / radius)^2, times its
// number of records.
#pragma once

#include <array>
#include <cstddef>
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

// FitNeighbours lists the fragments around a target in runs of neighbours in FragmentRows, as a
// structure of arrays. Runs without a fragment on the surface of the target and within the radius
// are left out. `tilted` has the runs with a shading normal that is not exactly the target's. Flat
// surfaces have few of them, and the others add nothing to moments of the tilt.
struct FitNeighbours {
  static constexpr std::size_t kRun = 8;
  // Squared distance on the film, infinite for fragments that do not count, and features. U3 and U4
  // are those of `tilted`.
  enum Column { Distance2, U1, U2, U3, U4, kColumns };

  void Reserve(std::size_t runs);
  // Calls use(fragment, weight) for the fragments that count, with their index and kernel weight.
  template <class Use>
  void ForWeights(const Use& use) const {
    const Real* const distances2 = At(Distance2);
    const Real most = radius * radius;
    for (std::size_t run = 0; run < runs; ++run)
      for (std::size_t i = 0; i < kRun; ++i)
        if (const Real distance2 = distances2[run * kRun + i]; distance2 < most)
          use(first[run] + i, 1 - distance2 / most);
  }
  Real* At(int column) { return columns[std::size_t(column)].data(); }
  const Real* At(int column) const { return columns[std::size_t(column)].data(); }

  const FragmentRows* rows = nullptr;
  Real radius = 0;
  std::array<std::vector<Real>, kColumns> columns;
  std::vector<std::size_t> first;   // fragment of each run
  std::vector<std::size_t> tilted;  // runs
  std::size_t runs = 0, tiltedRuns = 0;
  std::vector<FragmentRows::Range> ranges;  // scratch memory of collecting
};

// The sums of weight * feature_i * feature_j for i <= j, and of weight * feature_i * light.
struct FitMoments {
  std::array<Real, kFitFeatures*(kFitFeatures + 1) / 2> matrix{};
  std::array<std::array<Real, 3>, kFitFeatures> right{};
};

// LocalFitLoops holds the loops, compiled for one SIMD target.
struct LocalFitLoops {
  // Lists the fragments of out->ranges, of out->rows, within out->radius. There must be memory for
  // all runs.
  void (*describe)(const FitTarget& target, FitNeighbours* out);
  void (*locate)(const FitTarget& target, FitNeighbours* out);  // fills no features
  // Adds up the records of one set within the radius, at most the one of the neighbours.
  void (*accumulate)(const FitNeighbours& from, Real radius, FragmentRows::Column set,
                     FitMoments* moments);
};

class LocalFit {
 public:
  // Collects the fragments within `radius` pixels of the target. The rows must outlive `out`.
  struct Place {
    const FitTarget& target;
    Point2i pixel;
    Real radius;
  };
  static void Collect(const FragmentRows& rows, const Place& place, FitNeighbours* out);
  // Collects the fragments without features, so that there are weights but no fits.
  static void CollectPlaces(const FragmentRows& rows, const Place& place, FitNeighbours* out);

  // Fits one set of records, which is stated by its first column. The neighbours must reach to
  // `radius`.
  LocalFit(const FitNeighbours& neighbours, Real radius, FragmentRows::Column set);

  bool IsEmpty() const { return !(total_ > 0); }  // no record had a weight
  Spectrum At(const FitFeatures& features) const;
  const Spectrum& AtTarget() const { return coefficients_[0]; }
  // Returns the part of AtTarget() that the light of one record at the target has.
  double InfluenceOfRecord() const { return double(influence_); }

  static std::span<const LocalFitLoops* const> Loops();  // for this machine, widest last

 private:
  std::array<Spectrum, kFitFeatures> coefficients_{};
  Real total_ = 0, influence_ = 0;
};

}  // namespace exphoton
