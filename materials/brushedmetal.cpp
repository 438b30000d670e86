// SPDX-License-Identifier: BSD-2-Clause
// The material "brushedmetal" is brushed metal without a diffuse part. lafortune_material.h names
// the source. The fit gains energy at grazing angles: the albedo is above 1 where the cosine is
// below 0.3, and at most 1.61. The mean over directions is 0.82 at most. The published coefficients
// are kept, because pictures depend on them.
#include "materials/common/lafortune_material.h"

namespace exphoton {
namespace {

const LafortuneFit& Fit() {
  static const LafortuneFit fit{{{Real(-1.11854), Real(-1.11845), Real(-1.11999)},
                                 {Real(1.01272), Real(1.01469), Real(1.01942)},
                                 {Real(15.8708), Real(15.6489), Real(15.4571)}},
                                {{Real(-1.05334), Real(-1.06409), Real(-1.08378)},
                                 {Real(.69541), Real(.662178), Real(.626672)},
                                 {Real(111.267), Real(88.9222), Real(65.2179)}},
                                {{Real(-1.01684), Real(-1.01635), Real(-1.01529)},
                                 {Real(1.00132), Real(1.00112), Real(1.00108)},
                                 {Real(180.181), Real(184.152), Real(195.773)}}};
  return fit;
}

const ParamTable<SurfaceSettings>& Parameters() { return SurfaceParameters(); }

std::unique_ptr<Material> Create(const SurfaceSettings& settings, const MaterialContext&) {
  return std::make_unique<LafortuneMaterial>(settings, Spectrum(), Fit());
}

}  // namespace
}  // namespace exphoton

EXPHOTON_MATERIAL("brushedmetal", "brushed metal, measured")
