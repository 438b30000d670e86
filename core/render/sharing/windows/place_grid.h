// SPDX-License-Identifier: BSD-2-Clause
// PlaceGrid holds the fragments of every fourth pixel, with what is chosen for their surroundings.
#pragma once

#include <vector>

#include "core/base/parallel.h"
#include "core/render/sharing/fragment_rows.h"
#include "core/render/sharing/gather_fragments.h"
#include "core/render/sharing/local_fit.h"

namespace exphoton {

// Where a fragment is.
struct PlaceSpot {
  Point2i pixel;
  std::size_t fragment;  // index in its pixel
  FitTarget target;
};

// Place is derived from PlaceSpot, and made of one.
template <class Place>
class PlaceGrid {
 public:
  static constexpr int kStride = 4;  // pixels

  explicit PlaceGrid(const GatherFragments& gathers) : rows_(gathers, kStride) {
    places_.reserve(rows_.Count());
    rows_.ForPixels([&](Point2i pixel) {
      const auto& fragments = gathers.At(pixel).fragments;
      for (std::size_t i = 0; i < fragments.size(); ++i)
        places_.emplace_back(PlaceSpot{pixel, i, FitTarget(fragments[i])});
    });
  }

  // Calls use(place, worker) for all places.
  template <class Use>
  void ForAll(ThreadPool* threads, const Use& use) {
    threads->For(std::int64_t(places_.size()),
                 [&](std::int64_t i, int worker) { use(&places_[std::size_t(i)], worker); });
  }

  // Calls use(place, weight) for the places within `radius` pixels on the surface of a target, with
  // the weight of a local fit.
  template <class Use>
  void ForNearby(const LocalFit::Place& around, FitNeighbours* scratch, const Use& use) const {
    LocalFit::CollectPlaces(rows_, around, scratch);
    scratch->ForWeights([&](std::size_t i, Real weight) { use(places_[i], weight); });
  }
  // Returns whether a condition holds for all places within this number of pixels along both axes.
  template <class Condition>
  bool HoldsAround(Point2i pixel, int reach, const Condition& condition) const {
    bool holds = true;
    rows_.ForRowsAround(pixel, reach, [&](const FragmentRows::Range& range) {
      for (std::size_t i = range.begin; holds && i < range.end; ++i) holds = condition(places_[i]);
    });
    return holds;
  }

 private:
  FragmentRows rows_;
  std::vector<Place> places_;  // by index in the rows
};

}  // namespace exphoton
