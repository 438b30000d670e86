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

constexpr double kSilentShare = 1e-3;  // of the light

// Returns the light that depth limits cut as a share of all light, given the light of the picture.
double ShareOf(double cut, double kept) { return cut > 0 ? cut / (cut + kept) : 0; }

// CutShare is the share of the light that depth limits cut from camera paths.
struct CutShare {
  double value = 0, standardError = 0;
  bool isCertain = false;  // whether it exceeds kSilentShare by more than chance
};

// Some samples have measured the cut light (core/transport/cut_light.h). Few bright paths are no
// evidence, so the cut light must be too much even if it is less by its standard error.
CutShare CutShareOf(const RenderTotals& totals) {
  const RayCounters& rays = totals.rays;
  if (rays.cutLightSamples == 0 || !(double(rays.cutLight) > 0)) return {};
  const double cut = rays.cutLight / double(rays.cutLightSamples), light = totals.MeanLight();
  const double spread = std::sqrt(double(rays.cutLightSquares));
  const double error = spread / rays.cutLight;  // relative to the cut light
  const double share = ShareOf(cut, light);
  return {share, share * (1 - share) * error, ShareOf(cut * (1 - error), light) > kSilentShare};
}

// Warns if a depth limit cut more than kSilentShare of the light, which the picture lacks. Cut
// specular gather rays are assumed to carry the mean radiance of the rays that were not cut.
void WarnOfCutPaths(const SummaryTarget& job, const RenderTotals& totals) {
  const RayCounters gather = job.statistics.Rays();  // with the rays of preprocessing
  // `error` is the standard error of the share.
  const auto warn = [&](double share, double error, const char* parameter, const char* of) {
    std::ostringstream text;
    text.precision(2);
    text << (job.integratorName.empty() ? "the integrator"
                                        : "integrator \"" + job.integratorName + "\"")
         << ": the depth limit \"" << parameter << "\" cut about " << 100 * share << " % of " << of;
    if (error > .1 * share) text << " (standard error " << 100 * error << " %)";
    job.log.Warning(text.str(), {}, std::string("raise \"") + parameter + "\"");
  };
  const CutShare camera = CutShareOf(totals);
  if (camera.isCertain) warn(camera.value, camera.standardError, job.limits.camera, "the light");
  const double gathers = std::max(double(gather.counts[std::size_t(RayKind::Gather)]), 1.);
  const double gatherShare =
      gather.cutGatherThroughput / gathers + ShareOf(gather.cutGatherLight, gather.gatherLight);
  if (gatherShare > kSilentShare)
    warn(gatherShare, 0, job.limits.gather, "the light of gather rays");
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

void SetSharingRadius(double radius, Statistics* statistics) {
  statistics->SetCounter("render/sharing radius", radius,
                         "pixels, mean radius of the windows of shared gathers");
}

void SetSharingBias(const std::optional<SharingBias>& bias, Statistics* statistics,
                    RenderResult* result) {
  result->sharingBias = bias;
  if (bias)
    statistics->SetCounter("render/sharing bias", bias->squared,
                           "relMSE, estimated squared bias of shared gathers");
}

RenderResult Summarize(const SummaryTarget& job, const RenderTotals& totals,
                       const NonFiniteLog& log) {
  RenderResult result;
  result.nonFiniteSamples = totals.nonFinite;
  job.statistics.AddRays(totals.rays);
  result.nonFiniteReports = log.Texts();
  SetSharingBias(totals.MeanSharingBias(), &job.statistics, &result);
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
