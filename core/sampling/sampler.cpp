// SPDX-License-Identifier: BSD-2-Clause
// SampleLayout and CameraSamples: what integrators ask of a sampler, and the storage of one camera
// sample's points. The points themselves are made by the sampler plugins.
#include "core/sampling/sampler.h"

#include <algorithm>

namespace exphoton {
namespace {

// Where each array starts; one entry more than there are arrays.
std::vector<std::size_t> Offsets(std::span<const int> counts) {
  std::vector<std::size_t> offsets(1, 0);
  for (int count : counts) offsets.push_back(offsets.back() + std::size_t(count));
  return offsets;
}

template <class T>
std::span<T> Slice(T* values, const std::vector<std::size_t>& offsets, int handle) {
  const auto i = std::size_t(handle);
  return {values + offsets[i], offsets[i + 1] - offsets[i]};
}

}  // namespace

int SampleLayout::Request1D(int count) {
  counts1D_.push_back(std::max(count, 0));
  return int(counts1D_.size()) - 1;
}

int SampleLayout::Request2D(int count) {
  counts2D_.push_back(std::max(count, 0));
  return int(counts2D_.size()) - 1;
}

CameraSamples::CameraSamples(const SampleLayout& layout)
    : needsLens_(layout.needsLens),
      needsTime_(layout.needsTime),
      offsets1D_(Offsets(layout.Counts1D())),
      offsets2D_(Offsets(layout.Counts2D())),
      values1D_(offsets1D_.back()),
      values2D_(offsets2D_.back()) {}

std::span<const Real> CameraSamples::Array1D(int handle) const {
  return Slice(values1D_.data(), offsets1D_, handle);
}
std::span<const Point2> CameraSamples::Array2D(int handle) const {
  return Slice(values2D_.data(), offsets2D_, handle);
}
std::span<Real> CameraSamples::Array1D(int handle) {
  return Slice(values1D_.data(), offsets1D_, handle);
}
std::span<Point2> CameraSamples::Array2D(int handle) {
  return Slice(values2D_.data(), offsets2D_, handle);
}

}  // namespace exphoton
