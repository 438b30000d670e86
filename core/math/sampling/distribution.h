// SPDX-License-Identifier: BSD-2-Clause
// Tabulated distributions have cumulative sums in double. DiscreteDistribution returns an index and
// its *probability*. PiecewiseConstant1D and PiecewiseConstant2D are densities on [0,1) and
// [0,1)^2.
#pragma once

#include <span>
#include <vector>

#include "core/math/sampling/random.h"
#include "core/math/vec.h"

namespace exphoton {

// DiscreteDistribution chooses i with probability weight_i / sum. Weights must be finite and not
// negative. If all are 0, the distribution is empty (IsEmpty) and must not be sampled.
class DiscreteDistribution {
 public:
  struct Choice {
    int index;
    Real probability;  // probability of `index`; > 0
    Real remapped;     // u rescaled to a new uniform variate in [0,1)
  };

  DiscreteDistribution() = default;
  explicit DiscreteDistribution(std::span<const double> weights);

  bool IsEmpty() const { return cdf_.empty(); }
  int Size() const { return size_; }
  double Sum() const { return sum_; }
  Choice Sample(Real u) const;
  Real Probability(int index) const;  // 0 for an empty distribution

 private:
  double sum_ = 0;           // precedes cdf_, whose initialiser sets it
  std::vector<double> cdf_;  // cdf_[i] = P(choice < i); size + 1 entries, last one exactly 1
  int size_ = 0;
};

// PiecewiseConstant1D is a density on [0,1) proportional to a step function of n equal steps. If
// all steps are 0, it is uniform.
class PiecewiseConstant1D {
 public:
  struct Value {
    Real x;
    Real pdf;  // per unit length
    int index;
  };

  PiecewiseConstant1D() = default;
  explicit PiecewiseConstant1D(std::span<const double> values);
  Value Sample(Real u) const;
  Real Pdf(Real x) const;
  double Integral() const { return integral_; }  // of the step function over [0,1)
  int Size() const { return int(cdf_.size()) - 1; }

 private:
  std::vector<double> cdf_;
  double integral_ = 0;
};

// PiecewiseConstant2D is a density on [0,1)^2 proportional to a width x height image, with rows
// from y = 0. If all values are 0, it is uniform.
class PiecewiseConstant2D {
 public:
  PiecewiseConstant2D() = default;
  PiecewiseConstant2D(std::span<const double> values, int width, int height);
  Point2 Sample(Point2 u) const;
  Real Pdf(Point2 p) const;  // per unit area
  double Integral() const { return marginal_.Integral(); }

 private:
  std::vector<PiecewiseConstant1D> rows_;
  PiecewiseConstant1D marginal_;
};

}  // namespace exphoton
