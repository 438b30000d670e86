// SPDX-License-Identifier: BSD-2-Clause
// SharingWindows: judges the windows at each grid pixel, and then chooses among them by the errors
// of a neighbourhood.
#include "core/render/sharing/sharing_windows.h"

#include <algorithm>
#include <cmath>

namespace exphoton {
namespace {

constexpr Real kChoiceRadius = 12, kBlendRadius = 6;  // pixels

int FloorDivide(int a, int b) { return a >= 0 ? a / b : -((b - 1 - a) / b); }
int CeilDivide(int a, int b) { return -FloorDivide(-a, b); }

// In double precision, because the square of faint or bright light leaves the range of float.
double SquaredDifference(const Spectrum& a, const Spectrum& b) {
  double sum = 0;
  for (int c = 0; c < Spectrum::kChannels; ++c) {
    const double d = double(a[c]) - double(b[c]);
    sum += d * d;
  }
  return sum;
}

// Statistics of the differences between two windows' errors.
struct Comparison {
  double sum = 0, squares = 0;
  void Add(double weight, double difference) {
    const double weighted = weight * difference;
    sum += weighted;
    squares += weighted * weighted;
  }
  // Returns whether the first window is better by more than this number of standard errors.
  bool IsBetter(double deviations) const { return sum + deviations * std::sqrt(squares) < 0; }
};

// Returns whether the light of a group differs from a fit by more than its noise, and not against
// this direction.
bool StandsOut(const GatherFragment& fragment, int group, const Spectrum& fit,
               const Spectrum& direction, Real noise) {
  constexpr double kDeviations = 3;
  const Spectrum own = fragment.Mean(group), both = (own - fit) * direction;
  // Brighter light has more noise, so the brighter one of both counts.
  const double variance =
      double(noise) *
      std::max(SquaredDifference(fit, Spectrum()), SquaredDifference(own, Spectrum())) /
      double(fragment.count[std::size_t(group)]);
  return noise > 0 && both[0] + both[1] + both[2] > 0 &&
         SquaredDifference(own, fit) > kDeviations * kDeviations * variance;
}

}  // namespace

SharingWindows::SharingWindows(const GatherFragments& gathers, const FragmentRows& rows,
                               ThreadPool* threads) {
  const PixelBounds& bounds = gathers.Bounds();
  x0_ = CeilDivide(bounds.x0, kStride);
  y0_ = CeilDivide(bounds.y0, kStride);
  columns_ = std::max(CeilDivide(bounds.x1, kStride) - x0_, 0);
  rows_ = std::max(CeilDivide(bounds.y1, kStride) - y0_, 0);
  cells_.resize(std::size_t(columns_) * std::size_t(rows_));
  std::vector<FitNeighbours> scratch(std::size_t(threads->Count()));
  threads->For(rows_, [&](std::int64_t row, int worker) {
    for (int column = 0; column < columns_; ++column) {
      const Point2i pixel{(x0_ + column) * kStride, (y0_ + int(row)) * kStride};
      Cell& cell = cells_[std::size_t(row) * std::size_t(columns_) + std::size_t(column)];
      for (const GatherFragment& fragment : gathers.At(pixel).fragments)
        cell.push_back(Judge(rows, pixel, fragment, &scratch[std::size_t(worker)]));
    }
  });
  std::vector<std::vector<Nearby>> nearby(scratch.size());
  threads->For(rows_, [&](std::int64_t row, int worker) {
    for (int column = 0; column < columns_; ++column)
      for (Place& place : cells_[std::size_t(row) * std::size_t(columns_) + std::size_t(column)])
        Choose(&place, &nearby[std::size_t(worker)]);
  });
}

SharingWindows::Place SharingWindows::Judge(const FragmentRows& rows, Point2i pixel,
                                            const GatherFragment& fragment,
                                            FitNeighbours* scratch) {
  Place place(pixel, fragment);
  if (!fragment.HasGroup(kChoosingGroups[0]) || !fragment.HasGroup(kChoosingGroups[1]))
    return place;
  LocalFit::Collect(rows, {FitTarget(fragment), pixel, kMaxRadius}, scratch);
  std::array<std::array<Spectrum, kRadii.size()>, 2> fitted;
  for (std::size_t set = 0; set < 2; ++set) {
    const int group = kChoosingGroups[set];
    fitted[set][0] = fragment.Mean(group);
    for (std::size_t w = 1; w < kRadii.size(); ++w)
      fitted[set][w] =
          LocalFit(*scratch, kRadii[w], FragmentRows::OfGroup(group)).At({1, 0, 0, 0, 0});
  }
  const Spectrum smooth = (fitted[0].back() + fitted[1].back()) * Real(.5);
  const double scale = SquaredDifference(smooth, Spectrum());
  if (!(scale > 0)) return place;
  for (std::size_t set = 0; set < 2; ++set) {
    place.otherRecords[set] = fragment.count[std::size_t(kChoosingGroups[1 - set])];
    for (std::size_t w = 0; w < kRadii.size(); ++w) {
      const auto& other = fitted[1 - set];
      place.errors[set][w] = float(SquaredDifference(fitted[set][w], other[0]) / scale);
      place.errorsOfFits[set][w] = float(SquaredDifference(fitted[set][w], other[1]) / scale);
    }
  }
  place.isJudged = true;
  return place;
}

template <class Use>
void SharingWindows::ForNearby(const Spot& point, Real radius, const Use& use) const {
  const int reach = int(radius);
  const int firstX = std::max(CeilDivide(point.pixel.x - reach, kStride) - x0_, 0),
            firstY = std::max(CeilDivide(point.pixel.y - reach, kStride) - y0_, 0),
            lastX = std::min(FloorDivide(point.pixel.x + reach, kStride) - x0_, columns_ - 1),
            lastY = std::min(FloorDivide(point.pixel.y + reach, kStride) - y0_, rows_ - 1);
  for (int y = firstY; y <= lastY; ++y) {
    for (int x = firstX; x <= lastX; ++x) {
      for (const Place& place : cells_[std::size_t(y) * std::size_t(columns_) + std::size_t(x)]) {
        const Point2 d = place.film - point.film;
        const Real weight = 1 - (d.x * d.x + d.y * d.y) / (radius * radius);
        if (weight > 0 && place.isJudged && place.depth == point.depth &&
            LieOnOneSurface(point.p, point.ng, place.p, place.ng))
          use(place, weight);
      }
    }
  }
}

void SharingWindows::Choose(Place* place, std::vector<Nearby>* scratch) const {
  std::vector<Nearby>& nearby = *scratch;
  nearby.clear();
  ForNearby(*place, kChoiceRadius, [&](const Place& other, Real weight) {
    nearby.push_back({&other, weight});
  });
  // Start with the smallest window that has a fit. Another window replaces the best one only if its
  // errors are clearly smaller. Fits are compared with a fit, which has much less noise than a
  // group's own light, so that better windows are recognised. Fireflies are in the light of a group
  // alone, so a sample keeps its own light only if this is better beyond doubt.
  std::size_t best = 1;
  const auto compare = [&](std::size_t window, Errors Place::*kind) {
    Comparison comparison;
    for (const Nearby& other : nearby)
      for (const auto& errors : other.place->*kind)
        comparison.Add(double(other.weight), double(errors[window]) - double(errors[best]));
    return comparison;
  };
  for (std::size_t window = 2; window < kRadii.size(); ++window)
    if (compare(window, &Place::errorsOfFits).IsBetter(1)) best = window;
  if (best == 1 && compare(0, &Place::errors).IsBetter(2)) best = 0;
  place->radius = kRadii[best];
  place->noise = NoiseAround(nearby, std::max(best, std::size_t(1)));
}

// A line of single pixels differs from all fits, and is not noise. Places where the light of both
// groups is far from the fit are therefore left out. Noise alone makes few such places, and a
// firefly is in one group.
Real SharingWindows::NoiseAround(const std::vector<Nearby>& nearby, std::size_t window) {
  constexpr float kFar = 9;  // times the median
  std::vector<float> errors;
  errors.reserve(2 * nearby.size());
  for (const Nearby& other : nearby)
    for (const auto& ofGroup : other.place->errors) errors.push_back(ofGroup[window]);
  if (errors.empty()) return 0;
  const auto middle = errors.begin() + std::ptrdiff_t(errors.size() / 2);
  std::nth_element(errors.begin(), middle, errors.end());
  const float limit = kFar * *middle;
  Real noise = 0, total = 0;
  for (const Nearby& other : nearby) {
    const Place& place = *other.place;
    if (std::min(place.errors[0][window], place.errors[1][window]) > limit) continue;
    for (std::size_t set = 0; set < 2; ++set)
      noise += other.weight * Real(place.errors[set][window]) * place.otherRecords[set];
    total += 2 * other.weight;
  }
  return total > 0 ? noise / total : 0;
}

SharingWindows::Window SharingWindows::At(Point2i pixel, const GatherFragment& fragment) const {
  Real radii = 0, noise = 0, total = 0;
  ForNearby(Spot(pixel, fragment), kBlendRadius, [&](const Place& place, Real weight) {
    radii += weight * place.radius;
    noise += weight * place.noise;
    total += weight;
  });
  const Real radius = (total > 0 ? radii / total : kRadii[1]) * scale_;
  return {std::max(radius, kRadii[1]), std::min(radius / kRadii[1], Real(1)),
          total > 0 ? noise / total : 0};
}

WindowFit::WindowFit(const FragmentRows& rows, const SharingWindows& windows, const Place& place,
                     FitNeighbours* scratch)
    : fragment_(place.fragment),
      window_(windows.At(place.pixel, place.fragment)),
      target_(place.fragment),
      neighbours_(*scratch) {
  if (window_.share > 0) LocalFit::Collect(rows, {target_, place.pixel, window_.radius}, scratch);
}

std::optional<LocalFit> WindowFit::To(FragmentRows::Column set) const {
  if (!(window_.share > 0)) return std::nullopt;
  const LocalFit fit(neighbours_, window_.radius, set);
  if (IsDetail(fit.AtTarget())) return std::nullopt;
  return fit;
}

bool WindowFit::IsDetail(const Spectrum& fit) const {
  const Real noise = window_.noise;
  if (!fragment_.HasGroup(kChoosingGroups[0]) || !fragment_.HasGroup(kChoosingGroups[1]))
    return false;
  const Spectrum direction = fragment_.Mean(kChoosingGroups[0]) - fit;
  for (int group = 0; group < kGatherGroups; ++group)
    if (fragment_.HasGroup(group) && !StandsOut(fragment_, group, fit, direction, noise))
      return false;
  for (std::size_t set = 0; set < 2; ++set) {
    const LocalFit other(neighbours_, window_.radius, FragmentRows::OfGroup(kChoosingGroups[set]));
    if (!StandsOut(fragment_, kChoosingGroups[1 - set], other.AtTarget(), direction, noise))
      return false;
  }
  return true;
}

}  // namespace exphoton
