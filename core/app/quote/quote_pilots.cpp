// SPDX-License-Identifier: BSD-2-Clause
// RunPilots: the number of samples doubles until the time is used up, so that the last pilot is
// the most accurate one.
#include "core/app/quote/quote_pilots.h"

#include <algorithm>

#include "core/base/error.h"
#include "core/base/statistics.h"

namespace exphoton::cli {
namespace {

constexpr std::size_t kLeastPilots = 2, kMostPilots = 8;
// The estimate of the bias takes this many times the time of the samples of the last pilot.
constexpr double kBiasTime = 3;
constexpr double kPixelMemory = 70;  // bytes for each pixel of a picture

// Integrators whose pictures are right in the mean, but for limits of depth.
constexpr const char* kWithoutBias[] = {"path", "guidedpath", "bidirectional"};

// The next pilot takes twice as long, and then comes one that estimates the bias.
void RenderSeries(PilotSeries* series, double cpuSeconds) {
  const auto fits = [&] {
    const double bias = series->HasBias() ? kBiasTime * series->Next() : 0;
    return series->Spent() + series->Next() + bias <= cpuSeconds;
  };
  while (series->Count() < kLeastPilots || (series->Count() < kMostPilots && fits()))
    series->Render();
  if (series->HasBias()) series->RenderBias(1);
}

}  // namespace

Quote RunPilots(PilotRenderer* renderer, const std::string& integrator, double cpuSeconds) {
  ResetPeakMemory();
  Quote quote;
  quote.integrator = integrator;
  PilotSeries series(renderer, integrator, 0, PilotSeries::Unit::CpuSeconds);
  try {
    const std::vector<std::string> unseen = series.UnseenLight();
    if (!unseen.empty()) {
      quote.failure = "never finds " + unseen.front();
      return quote;
    }
    RenderSeries(&series, cpuSeconds);
  } catch (const Error& error) {
    quote.failure = error.what();
    return quote;
  }
  const PilotPicture& last = series.Last();
  quote.model = series.Model();
  quote.settings = series.Settings();
  quote.light = last.light;
  quote.messages = last.messages;
  quote.memory = PeakMemoryBytes() + kPixelMemory * (renderer->Pixels() - last.pixels);
  if (last.certificate)
    quote.notCovered = last.certificate->notCovered;
  else if (std::ranges::find(kWithoutBias, integrator) == std::end(kWithoutBias))
    quote.notCovered = {"all that this integrator lacks or blurs, so the error is its noise alone"};
  return quote;
}

}  // namespace exphoton::cli
