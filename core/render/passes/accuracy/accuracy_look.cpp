// SPDX-License-Identifier: BSD-2-Clause
#include "core/render/passes/accuracy/accuracy_look.h"

#include <cmath>

#include "core/base/format.h"

namespace exphoton {

std::optional<Certificate> LookAtError(const LookedAtPasses& passes, AccuracyRule* rule, Log& log) {
  const PassSum& sum = passes.sum;
  std::optional<Certificate> certificate;
  if (passes.corrections)
    certificate = Certify(*passes.corrections, sum.Levels(), *sum.Noise(), rule->NextGoal());
  if (certificate) certificate->sharing = passes.sharing;
  const double noiseError = sum.NoiseError();
  rule->Look({*sum.Noise(), noiseError, passes.fixedNoise, certificate ? &*certificate : nullptr,
              sum.NoiseBetweenGroups(), sum.NoiseFreedom(), passes.ofMaps, passes.photonNoise});
  log.Verbose(
      Format("after %s a pixel: noise %.3g \u00b1 %.2g of relMSE, bias %.3g to %.3g, "
             "error below %s %%",
             Counted(sum.SamplesPerPixel(), "sample").c_str(), *sum.Noise(), noiseError,
             certificate ? certificate->LowerBias() : 0, certificate ? certificate->UpperBias() : 0,
             Plain(100 * std::sqrt(rule->Upper()), 3).c_str()));
  return certificate;
}

}  // namespace exphoton
