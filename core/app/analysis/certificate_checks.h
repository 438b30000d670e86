// SPDX-License-Identifier: BSD-2-Clause
// CertificateCheck puts the certificates of a setting's renders (study --certify) beside the errors
// that the study measured. An interval of a certificate is about the bias of blocks of pixels, in
// which bias of both signs cancels. It is compared with the measured bias of the same blocks.
#pragma once

#include <vector>

#include "core/app/analysis/analysis.h"

namespace exphoton::study {

struct CertificateCheck {
  std::size_t setting = 0;  // index of Analysis::settings
  // Parts of relMSE, as means over the renders with certificates: the whole error, and the ends of
  // the interval of the squared bias of blocks. error and upper may be infinite.
  double error = 0, lower = 0, upper = 0;
  Measured blockBias{0, 0};           // the measured squared bias of the same blocks
  int leastWidth = 0, mostWidth = 0;  // of the blocks, in pixels
  // The number of renders whose interval can be compared with the measured bias, and the number of
  // intervals that contain it. The standard error of the bias plays no part.
  int compared = 0, contained = 0;
};

// Returns the checks of the settings that have certificates, line by line.
std::vector<CertificateCheck> CheckCertificates(const Results& results, const Analysis& analysis);

// Returns the width of the blocks of a render's certificate in pixels, or 0 without a certificate.
int BlockWidth(const RunRow& row);

}  // namespace exphoton::study
