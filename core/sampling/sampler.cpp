// SPDX-License-Identifier: BSD-2-Clause
// SampleLayout records what integrators request, and CameraSamples stores the points of one camera
// sample. The sampler plugins make the points.
#include "core/sampling/sampler.h"

#include <algorithm>

namespace exphoton {
int SampleLayout::Request1D(int count) {
  counts1D_.push_back(std::max(count, 0));
  return int(counts1D_.size()) - 1;
}

int SampleLayout::Request2D(int count) {
  counts2D_.push_back(std::max(count, 0));
  return int(counts2D_.size()) - 1;
}

std::span<const int> SampleLayout::Counts1D() const { return counts1D_; }

std::span<const int> SampleLayout::Counts2D() const { return counts2D_; }

template <class T>
CameraSamples::Arrays<T>::Arrays(std::span<const int> counts)
    : offsets(1, 0), isMade(counts.size()) {
  for (const int count : counts) offsets.push_back(offsets.back() + std::size_t(count));
  values.resize(offsets.back());
}

CameraSamples::CameraSamples(const SampleLayout& layout)
    : needsLens_(layout.needsLens),
      needsTime_(layout.needsTime),
      arrays1D_(layout.Counts1D()),
      arrays2D_(layout.Counts2D()) {}

template <class T>
std::span<const T> CameraSamples::Read(Arrays<T>& arrays, int handle, int firstRequest) const {
  const auto i = std::size_t(handle);
  const std::span<T> values(arrays.values.data() + arrays.offsets[i],
                            arrays.offsets[i + 1] - arrays.offsets[i]);
  if (!arrays.isMade[i]) {
    arrays.isMade[i] = true;
    if (!values.empty()) sampler_->Fill(key_, index_, firstRequest + handle, values);
  }
  return values;
}

std::span<const Real> CameraSamples::Array1D(int handle) const {
  return Read(arrays1D_, handle, 0);
}

std::span<const Point2> CameraSamples::Array2D(int handle) const {
  return Read(arrays2D_, handle, Count1D());
}

void Sampler::Generate(const SampleKey& key, CameraSamples* samples) const {
  samples->sampler_ = this;
  samples->index_ = key.index;
  samples->key_ = FillCamera(key, samples);
  std::ranges::fill(samples->arrays1D_.isMade, false);
  std::ranges::fill(samples->arrays2D_.isMade, false);
}

}  // namespace exphoton
