// SPDX-License-Identifier: BSD-2-Clause
// The material "clay" is clay. lafortune_material.h names the source.
#include "materials/common/lafortune_material.h"

namespace exphoton {
namespace {

const LafortuneFit& Fit() {
  static const LafortuneFit fit{{{Real(-1.089701), Real(-1.102701), Real(-1.107603)},
                                 {Real(-1.354682), Real(-2.714801), Real(-1.569866)},
                                 {Real(17.968505), Real(11.024489), Real(21.270282)}},
                                {{Real(-.733381), Real(-.793320), Real(-.848206)},
                                 {Real(.676108), Real(.679314), Real(.726031)},
                                 {Real(8.219745), Real(9.055139), Real(11.261951)}},
                                {{Real(-1.010548), Real(-1.012378), Real(-1.011263)},
                                 {Real(.910783), Real(.885239), Real(.892451)},
                                 {Real(152.912795), Real(141.937171), Real(201.046802)}}};
  return fit;
}

const ParamTable<SurfaceSettings>& Parameters() { return SurfaceParameters(); }

std::unique_ptr<Material> Create(const SurfaceSettings& settings, const MaterialContext&) {
  return std::make_unique<LafortuneMaterial>(
      settings, Spectrum(Real(.383626), Real(.260749), Real(.274207)), Fit());
}

}  // namespace
}  // namespace exphoton

EXPHOTON_MATERIAL("clay", "clay, measured")
