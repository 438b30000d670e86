// SPDX-License-Identifier: BSD-2-Clause
// RenderTotals counts what the threads of a render did. Summarize turns the counts of all passes
// into statistics and warnings.
#pragma once

#include <algorithm>
#include <cstdint>

#include "core/base/statistics.h"
#include "core/render/non_finite_log.h"
#include "core/render/render.h"

namespace exphoton {

class ByteArchive;

struct RenderTotals {
  RayCounters rays;
  std::int64_t cameraSamples = 0, nonFinite = 0, negative = 0;

  void Add(const RenderTotals& other);  // all counts, but not the light
  // Adds the picture of a pass.
  void AddLight(const Film& film, std::int64_t samplesPerPixel);
  // Adds the estimate of a complete pass or batch of passes. Open pixels would count as free of
  // bias.
  void AddSharingBias(const SharingBias& bias, std::int64_t samplesPerPixel);
  void DropSharingBias() { bias_ = biasVariance_ = 0, biasSamples_ = 0; }
  // Returns the mean of all passes; nullopt if no pass has an estimate.
  std::optional<SharingBias> MeanSharingBias() const;
  void Transfer(ByteArchive* archive);                            // saves or loads everything
  std::int64_t SamplesPerPixel() const { return lightSamples_; }  // of all pictures so far
  // Returns the mean luminance of the picture.
  double MeanLight() const { return light_ / double(std::max<std::int64_t>(lightSamples_, 1)); }

 private:
  double light_ = 0;  // sum over the passes of the mean luminance times lightSamples_
  std::int64_t lightSamples_ = 0;
  double bias_ = 0, biasVariance_ = 0;  // sums over passes, weighted by samples
  std::int64_t biasSamples_ = 0;
};

struct SummaryTarget {
  Statistics& statistics;
  Log& log;
  std::string integratorName;
  DepthParameters limits;
};

// States the estimate for shared gathers in the result and in the statistics.
void SetSharingBias(const std::optional<SharingBias>& bias, Statistics* statistics,
                    RenderResult* result);

// `radius`: mean radius of the windows of shared gathers, in pixels.
void SetSharingRadius(double radius, Statistics* statistics);

// Fills the statistics, logs warnings and returns the non-finite samples.
RenderResult Summarize(const SummaryTarget& job, const RenderTotals& totals,
                       const NonFiniteLog& log);

}  // namespace exphoton
