// SPDX-License-Identifier: BSD-2-Clause
// The material "skin" is human skin. lafortune_material.h names the source.
#include "materials/common/lafortune_material.h"

namespace exphoton {
namespace {

const LafortuneFit& Fit() {
  static const LafortuneFit fit{{{Real(-1.131747), Real(-1.016939), Real(-.966018)},
                                 {Real(-1.209182), Real(-1.462488), Real(-1.222419)},
                                 {Real(6.421658), Real(3.699932), Real(3.524889)}},
                                {{Real(-.546570), Real(-.643533), Real(-.638934)},
                                 {Real(.380123), Real(.410559), Real(.437367)},
                                 {Real(3.685044), Real(4.266495), Real(4.539742)}},
                                {{Real(-.998888), Real(-1.020153), Real(-1.027479)},
                                 {Real(.857998), Real(.703913), Real(.573625)},
                                 {Real(64.208486), Real(63.919687), Real(43.809866)}}};
  return fit;
}

const ParamTable<SurfaceSettings>& Parameters() { return SurfaceParameters(); }

std::unique_ptr<Material> Create(const SurfaceSettings& settings, const MaterialContext&) {
  return std::make_unique<LafortuneMaterial>(
      settings, Spectrum(Real(.428425), Real(.301341), Real(.331054)), Fit());
}

}  // namespace
}  // namespace exphoton

EXPHOTON_MATERIAL("skin", "human skin, measured")
