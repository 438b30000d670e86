// SPDX-License-Identifier: BSD-2-Clause
// SharingWindows: judges the windows at each grid pixel, and then chooses among them by the errors
// of a neighbourhood.
#include "core/render/sharing/windows/sharing_windows.h"

#include <algorithm>
#include <cmath>

#include "core/render/sharing/windows/squared_difference.h"

namespace exphoton {
namespace {

constexpr Real kChoiceRadius = 12, kBlendRadius = 6;  // pixels

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

}  // namespace

SharingWindows::SharingWindows(const GatherFragments& gathers, const FragmentRows& rows,
                               ThreadPool* threads)
    : grid_(gathers) {
  std::vector<Scratch> scratch(std::size_t(threads->Count()));
  grid_.ForAll(threads, [&](Place* place, int worker) {
    Judge(rows, gathers.At(place->pixel).fragments[place->fragment], place,
          &scratch[std::size_t(worker)].neighbours);
  });
  grid_.ForAll(threads,
               [&](Place* place, int worker) { Choose(place, &scratch[std::size_t(worker)]); });
}

void SharingWindows::Judge(const FragmentRows& rows, const GatherFragment& fragment, Place* place,
                           FitNeighbours* scratch) {
  if (!fragment.HasGroup(kChoosingGroups[0]) || !fragment.HasGroup(kChoosingGroups[1])) return;
  LocalFit::Collect(rows, {place->target, place->pixel, kMaxRadius}, scratch);
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
  if (!(scale > 0)) return;
  for (std::size_t set = 0; set < 2; ++set) {
    place->otherRecords[set] = fragment.count[std::size_t(kChoosingGroups[1 - set])];
    for (std::size_t w = 0; w < kRadii.size(); ++w) {
      const auto& other = fitted[1 - set];
      place->errors[set][w] = float(SquaredDifference(fitted[set][w], other[0]) / scale);
      place->errorsOfFits[set][w] = float(SquaredDifference(fitted[set][w], other[1]) / scale);
    }
  }
  place->isJudged = true;
}

void SharingWindows::Choose(Place* place, Scratch* scratch) const {
  std::vector<Nearby>& nearby = scratch->nearby;
  nearby.clear();
  grid_.ForNearby({place->target, place->pixel, kChoiceRadius}, &scratch->neighbours,
                  [&](const Place& other, Real weight) {
                    if (other.isJudged) nearby.push_back({&other, weight});
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

SharingWindows::Window SharingWindows::At(Point2i pixel, const FitTarget& target,
                                          FitNeighbours* scratch) const {
  Real radii = 0, noise = 0, total = 0;
  grid_.ForNearby({target, pixel, kBlendRadius}, scratch, [&](const Place& place, Real weight) {
    if (!place.isJudged) return;
    radii += weight * place.radius;
    noise += weight * place.noise;
    total += weight;
  });
  const Real radius = (total > 0 ? radii / total : kRadii[1]) * scale_;
  return {std::max(radius, kRadii[1]), std::min(radius / kRadii[1], Real(1)),
          total > 0 ? noise / total : 0};
}

}  // namespace exphoton
