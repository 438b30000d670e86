// SPDX-License-Identifier: BSD-2-Clause
// RenderTotals: sums over all passes, and the warnings at the end of a render.
#include "core/render/render_totals.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/files/byte_archive.h"
#include "core/render/shards/shard_statistics.h"

namespace exphoton {
namespace {

double MeanLuminance(const Film& film) {
  double sum = 0;
  for (std::size_t i = 0; i < film.PixelCount(); ++i) {
    const Film::Sums s = film.SumsOf(i);
    if (s.weight > 0)
      sum += double(Spectrum(Real(s.r / s.weight), Real(s.g / s.weight), Real(s.b / s.weight)).Y());
  }
  return sum / double(film.PixelCount());
}

// Warns if a depth limit cut more than kSilentShare of the light, which the picture lacks. Cut
// specular paths are assumed to carry the mean radiance of the paths that were not cut. Other cut
// light is measured (core/transport/cut_light.h).
void WarnOfCutPaths(const SummaryTarget& job, const RenderTotals& totals) {
  const RayCounters& camera = totals.rays;
  const RayCounters gather = job.statistics.Rays();  // with the rays of preprocessing
  constexpr double kSilentShare = 1e-3;
  // `error` is the standard error of the share. A few bright paths are no evidence.
  const auto warn = [&](double share, double error, const char* parameter, const char* of) {
    if (!(share - error > kSilentShare)) return;
    std::ostringstream text;
    text.precision(2);
    text << (job.integratorName.empty() ? "the integrator"
                                        : "integrator \"" + job.integratorName + "\"")
         << ": the depth limit \"" << parameter << "\" cut about " << 100 * share << " % of " << of;
    if (error > .1 * share) text << " (standard error " << 100 * error << " %)";
    job.log.Warning(text.str(), {}, std::string("raise \"") + parameter + "\"");
  };
  const auto shareOf = [](double cut, double kept) { return cut > 0 ? cut / (cut + kept) : 0; };
  const DepthParameters& limits = job.limits;
  const double samples = double(std::max<std::int64_t>(totals.cameraSamples, 1));
  const double gathers = std::max(double(gather.counts[std::size_t(RayKind::Gather)]), 1.);
  const double light = samples * totals.MeanLight();
  const double share = shareOf(camera.cutLight, light);
  const double spread = std::sqrt(double(camera.cutLightSquares));
  const double error = share > 0 ? share * (1 - share) * spread / camera.cutLight : 0;
  warn(camera.cutThroughput / samples + share, error, limits.camera, "the light");
  warn(gather.cutGatherThroughput / gathers + shareOf(gather.cutGatherLight, gather.gatherLight), 0,
       limits.gather, "the light of gather rays");
}

}  // namespace

void RenderTotals::Add(const RenderTotals& other) {
  rays.Add(other.rays);
  cameraSamples += other.cameraSamples;
  nonFinite += other.nonFinite;
  negative += other.negative;
}

void RenderTotals::Transfer(ByteArchive* archive) {
  ShardStatistics::TransferRays(archive, &rays);
  archive->Values(&cameraSamples, &nonFinite, &negative, &light_, &lightSamples_);
  archive->Values(&bias_, &biasVariance_, &biasSamples_);
}

void RenderTotals::AddLight(const Film& film, std::int64_t samplesPerPixel) {
  light_ += MeanLuminance(film) * double(samplesPerPixel);
  lightSamples_ += samplesPerPixel;
}

void RenderTotals::AddSharingBias(const SharingBias& bias, std::int64_t samplesPerPixel) {
  const auto weight = double(samplesPerPixel);
  bias_ += bias.squared * weight;
  biasVariance_ += bias.standardError * bias.standardError * weight * weight;
  biasSamples_ += samplesPerPixel;
}

std::optional<SharingBias> RenderTotals::MeanSharingBias() const {
  if (biasSamples_ <= 0) return std::nullopt;
  const auto total = double(biasSamples_);
  return SharingBias{bias_ / total, std::sqrt(std::max(biasVariance_, 0.)) / total};
}

RenderResult Summarize(const SummaryTarget& job, const RenderTotals& totals,
                       const NonFiniteLog& log) {
  RenderResult result;
  result.nonFiniteSamples = totals.nonFinite;
  job.statistics.AddRays(totals.rays);
  result.nonFiniteReports = log.Texts();
  result.sharingBias = totals.MeanSharingBias();
  if (result.sharingBias)
    job.statistics.SetCounter("render/sharing bias", result.sharingBias->squared,
                              "relMSE, estimated squared bias of shared gathers");
  job.statistics.SetCounter("render/camera samples", double(totals.cameraSamples),
                            "camera rays started");
  job.statistics.SetCounter("render/non-finite samples", double(result.nonFiniteSamples),
                            "camera samples dropped, counted as black");
  job.statistics.SetCounter("render/negative samples", double(totals.negative),
                            "camera samples with a component below 0, taken as 0");
  WarnOfCutPaths(job, totals);
  if (result.nonFiniteSamples == 0) return result;
  for (const std::string& text : result.nonFiniteReports)
    job.log.Warning("dropped a non-finite " + text);
  job.log.Warning(std::to_string(result.nonFiniteSamples) +
                  " non-finite camera samples were dropped and count as black");
  return result;
}

}  // namespace exphoton
