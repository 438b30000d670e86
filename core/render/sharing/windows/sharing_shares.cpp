// SPDX-License-Identifier: BSD-2-Clause
// SharingShares: sums of squares around each place.
#include "core/render/sharing/windows/sharing_shares.h"

#include <algorithm>

#include "core/render/sharing/windows/squared_difference.h"

namespace exphoton {
namespace {

constexpr Real kSumRadius = 6, kShareRadius = 6;  // pixels

// Estimates of b^2 and V of one fragment, relative to the square of its fit.
struct Evidence {
  double squaredBias = 0, variance = 0;
};

// The groups of a fragment have independent noise, so their scatter shows V. The squared difference
// d^2 of own light and fit has the expected value b^2 + V, but for the part that the fragment has
// in its fit: with the leverage h, the own light and the fit have the covariance h V, and the fit
// has the variance 2/3 h V for the weights of LocalFit.
Evidence EvidenceOf(const GatherFragment& fragment, const LocalFit& fit) {
  constexpr double kOfLeverage = 2 - 2. / 3;
  const Spectrum fitted = fit.AtTarget();
  const double scale = SquaredDifference(fitted, Spectrum());
  const Real count = fragment.Count();
  const Spectrum own = fragment.Light() / count;
  int groups = 0;
  double scatter = 0;
  for (int group = 0; group < kGatherGroups; ++group) {
    if (!fragment.HasGroup(group)) continue;
    ++groups;
    scatter +=
        double(fragment.count[std::size_t(group)]) * SquaredDifference(fragment.Mean(group), own);
  }
  if (!(scale > 0) || groups < 2) return {};
  const double variance = scatter / (groups - 1) / double(count) / scale;
  const double leverage = std::min(fit.InfluenceOfRecord() * double(count), 1 / kOfLeverage);
  return {SquaredDifference(own, fitted) / scale - (1 - kOfLeverage * leverage) * variance,
          variance};
}

// Adds up evidence with weights. The sum of b^2 loses twice its variance over itself, so that
// noise alone leaves nearly all light to the fit.
class EvidenceSum {
 public:
  void Add(double weight, const Evidence& evidence) {
    const double squaredBias = weight * evidence.squaredBias;
    squaredBias_ += squaredBias;
    squares_ += squaredBias * squaredBias;
    variance_ += weight * evidence.variance;
  }
  Real Share() const {
    if (!(squaredBias_ > 0) || !(variance_ > 0)) return 1;
    const double likely = std::max(squaredBias_ - 2 * squares_ / squaredBias_, 0.);
    return Real(variance_ / (variance_ + likely));
  }

 private:
  double squaredBias_ = 0, squares_ = 0, variance_ = 0;
};

std::vector<Evidence> EvidenceOfAll(const FragmentFits::Source& source, const FragmentFits& fits,
                                    ThreadPool* threads) {
  const PixelBounds& bounds = source.gathers.Bounds();
  std::vector<Evidence> all(source.rows.Count());
  threads->For(bounds.Height(), [&](std::int64_t row, int) {
    for (int x = bounds.x0; x < bounds.x1; ++x) {
      const Point2i pixel{x, bounds.y0 + int(row)};
      const auto& fragments = source.gathers.At(pixel).fragments;
      const FragmentFit* fit = fits.At(pixel);
      for (std::size_t i = 0; i < fragments.size(); ++i, ++fit)
        if (fit->fit) all[source.rows.First(pixel) + i] = EvidenceOf(fragments[i], *fit->fit);
    }
  });
  return all;
}

}  // namespace

SharingShares::SharingShares(const FragmentFits::Source& source, const FragmentFits& fits,
                             ThreadPool* threads)
    : grid_(source.gathers) {
  const std::vector<Evidence> all = EvidenceOfAll(source, fits, threads);
  std::vector<FitNeighbours> scratch(std::size_t(threads->Count()));
  grid_.ForAll(threads, [&](Place* place, int worker) {
    FitNeighbours& nearby = scratch[std::size_t(worker)];
    LocalFit::CollectPlaces(source.rows, {place->target, place->pixel, kSumRadius}, &nearby);
    EvidenceSum sum;
    nearby.ForWeights([&](std::size_t i, Real weight) { sum.Add(double(weight), all[i]); });
    place->share = sum.Share();
  });
}

Real SharingShares::At(Point2i pixel, const FitTarget& target, FitNeighbours* scratch) const {
  constexpr int kReachOfShare = int(kShareRadius);
  static_assert(Real(kReachOfShare) == kShareRadius);
  if (grid_.HoldsAround(pixel, kReachOfShare, [](const Place& place) { return place.share == 1; }))
    return 1;
  Real shares = 0, total = 0;
  grid_.ForNearby({target, pixel, kShareRadius}, scratch, [&](const Place& place, Real weight) {
    shares += weight * place.share;
    total += weight;
  });
  return total > 0 ? shares / total : 1;
}

}  // namespace exphoton
