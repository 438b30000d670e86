// SPDX-License-Identifier: BSD-2-Clause
// GatherCorrection: the number of rays and their choice.
#include "integrators/photon/certificate/gather_correction.h"

#include <cmath>

#include "integrators/photon/certificate/separate_context.h"

namespace exphoton {
namespace {

// Writes cumulative sums of the rays' probabilities, which are not normalized. A ray that hits
// nothing has none. The mean radiance is added to each radiance, so that rays that wrongly read
// little light are chosen too. Returns the luminance of the mean radiance.
Real Accumulate(const GatherRay::Reads& reads, std::span<Real> sums) {
  Real weights = 0, light = 0;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    weights += reads.weights[i].Y();
    light += reads.weights[i].Y() * reads.radiances[i].Y();
  }
  const Real mean = weights > 0 ? light / weights : Real(0);
  Real sum = 0;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const Real radiance = mean > 0 ? reads.radiances[i].Y() + mean : Real(1);
    if (reads.segments[i].hit) sum += reads.weights[i].Y() * radiance;
    sums[i] = sum;
  }
  return mean;
}

}  // namespace

void GatherCorrection::Observe(const ShadingPoint& point, const GatherRay::Reads& reads) {
  CorrectionSample& result = *context_.correction;
  RandomStream random =
      context_.Stream(HashKey({SeparateContext::kStream, std::uint64_t(point.depth)}));
  const std::size_t count = reads.segments.size();
  const auto chosen = int(std::floor(result.share * double(count) + double(random.Uniform())));
  if (chosen == 0) return;
  const Arena::Mark mark = context_.arena.GetMark();
  const std::span<Real> sums(context_.arena.AllocateArray<Real>(count), count);
  const Real mean = Accumulate(reads, sums);
  SeparateContext own(context_);
  ExactRadiance exact(sources_, own.Get(), &random);
  const double expected = result.share * double(count);
  for (int i = 0; i < chosen && sums.back() > 0; ++i) {
    const Real u = random.Uniform() * sums.back();
    const auto at = std::min(
        std::size_t(std::upper_bound(sums.begin(), sums.end(), u) - sums.begin()), count - 1);
    const Real before = at > 0 ? sums[at - 1] : Real(0);
    const Real probability = (sums[at] - before) / sums.back();
    if (!(probability > 0)) continue;
    const Spectrum correction = exact.Correction(reads.segments[at], mean);
    result.sum +=
        point.throughput * reads.weights[at] * correction / (probability * Real(expected));
    ++result.count;
  }
  context_.arena.Rewind(mark);
}

}  // namespace exphoton
