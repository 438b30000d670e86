// SPDX-License-Identifier: BSD-2-Clause
// KernelDisk computes the kernel weight, per area, of a photon at squared distance d2 from the
// centre of a disk of squared radius r2. Each kernel integrates to 1 over the disk
// (docs/theory/exphotonmap.md, eq. 10). Simpson's kernel is 3 / (pi r^2) (1 - (d/r)^2)^2 (Silverman
// 1986, "biweight").
#pragma once

#include <algorithm>
#include <limits>

#include "integrators/photon/photon_settings.h"

namespace exphoton {

// One object weights all photons of a disk, so that they share its divisions.
class KernelDisk {
 public:
  KernelDisk(DensityKernel kernel, Real r2)
      : isSimpson_(kernel == DensityKernel::Simpson),
        r2_(r2),
        inverse_(1 / std::max(r2, std::numeric_limits<Real>::min())),
        scale_((isSimpson_ ? 3 : 1) * kInvPi * inverse_) {}

  Real Weight(Real d2) const {
    // The constant kernel includes photons at the rim of the disk, as the search does.
    if (!isSimpson_) return scale_;
    return d2 < r2_ ? scale_ * Square(1 - d2 * inverse_) : Real(0);
  }

 private:
  bool isSimpson_;
  Real r2_, inverse_, scale_;
};

}  // namespace exphoton
