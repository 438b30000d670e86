// SPDX-License-Identifier: BSD-2-Clause
// Judge names the first limit that a picture breaks, from the plainest to the subtlest.
#include "core/app/commands/compare_verdict.h"

#include <algorithm>
#include <cmath>

#include "core/base/format.h"

namespace exphoton::cli {
namespace {

// The integrators whose pixels are uncorrelated. Most use random numbers of their own pixel alone;
// the pixels of guidedpath share photons, but the mean of a pixel is the same for any photons.
// Photon maps, virtual lights and irradiance records are shared by all pixels.
constexpr const char* kIndependentPixels[] = {"path",           "guidedpath", "bidirectional",
                                              "directlighting", "whitted",    "ambientocclusion",
                                              "debug"};

bool SharesNoise(const Image& image) {
  const auto found = image.attributes.find("integrator");
  const auto* name =
      found == image.attributes.end() ? nullptr : std::get_if<std::string>(&found->second);
  return !name || std::find(std::begin(kIndependentPixels), std::end(kIndependentPixels), *name) ==
                      std::end(kIndependentPixels);
}

std::string Percent(double ratio) { return Format("%+.2g %%", 100 * ratio); }

std::string PartText(const NoiseFinding& finding, bool isMean) {
  if (isMean) return "mean of " + finding.channel;
  const PixelBounds& part = finding.part;
  return finding.channel +
         Format(" in x %d to %d, y %d to %d", part.x0, part.x1 - 1, part.y0, part.y1 - 1);
}

Verdict Fail(const std::string& text) { return {false, "FAIL: " + text}; }
Verdict Pass(const std::string& text) { return {true, "PASS: " + text}; }

Verdict JudgeNoise(const NoiseTest& test, double significance) {
  for (const bool isMean : {true, false}) {
    const NoiseFinding& finding = isMean ? test.mean : test.block;
    if (finding.p >= test.threshold) continue;
    return Fail(PartText(finding, isMean) + ' ' + Percent(finding.relativeDifference) +
                " differs beyond noise" + Format(" (p %.2g < %.2g)", finding.p, test.threshold));
  }
  return Pass(
      Format("no difference beyond noise (%d tests, smallest p %.2g >= %.2g; equal "
             "pictures fail in %.3g %% of cases)",
             test.count, std::min(test.mean.p, test.block.p), test.threshold, 100 * significance));
}

}  // namespace

std::optional<NoiseTest> TestNoise(std::span<const Image> references, const Image& picture,
                                   const std::string& name, const CompareLimits& limits) {
  if (limits.IsBounded() && !limits.requiresNoiseTest) return {};
  NoiseTestOptions options;
  options.significance = limits.significance;
  options.sharesNoise = SharesNoise(picture);
  for (const Image& reference : references)
    options.sharesNoise = options.sharesNoise || SharesNoise(reference);
  const NoiseTest test = TestAgainstNoise(references, picture, options);
  if (test.source != NoiseSource::None) return test;
  if (limits.requiresNoiseTest)
    throw ImageError(name + ": --z-test does not know the noise; " + test.reason);
  return {};
}

Verdict Judge(const Comparison& comparison, const CompareLimits& limits) {
  const ImageDifference& difference = comparison.difference;
  if (difference.nonFinitePixels > 0)
    return Fail(std::to_string(difference.nonFinitePixels) + " pixels are not finite");
  if (comparison.isIdentical) return Pass("identical");
  if (limits.maxRelMse >= 0 && difference.relMse > limits.maxRelMse)
    return Fail(Format("relMSE %.3g > %.3g", difference.relMse, limits.maxRelMse));
  if (limits.maxMean >= 0) {
    const auto isOver = [&](double ratio) { return !(std::abs(ratio) <= limits.maxMean); };
    for (std::size_t c = 0; c < 3; ++c)
      if (isOver(comparison.relativeMeans[c]))
        return Fail(std::string("mean of ") + "RGB"[c] + ' ' +
                    Percent(comparison.relativeMeans[c]) +
                    Format(" > %.3g %%", 100 * limits.maxMean));
  }
  if (comparison.noise) {
    const Verdict verdict = JudgeNoise(*comparison.noise, limits.significance);
    if (!verdict.isPass || !limits.IsBounded()) return verdict;
  }
  if (limits.IsBounded()) return Pass("within the limits");
  return Fail("not identical; --max-relmse, --max-mean or --two-halves when rendering allow noise");
}

std::string NoiseText(const Comparison& comparison) {
  if (!comparison.noise) return "";
  const NoiseTest& test = *comparison.noise;
  const char* source = test.source == NoiseSource::Halves       ? "halves"
                       : test.source == NoiseSource::Replicates ? "independent pictures"
                                                                : "variances";
  return Format("%d tests by ", test.count) + source +
         Format(", p of means %.2g, of blocks %.2g", test.mean.p, test.block.p);
}

}  // namespace exphoton::cli
