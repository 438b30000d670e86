// SPDX-License-Identifier: BSD-2-Clause
// The material "felt" is black felt, which is brightest at grazing angles. lafortune_material.h
// names the source.
#include "materials/common/lafortune_material.h"

namespace exphoton {
namespace {

const LafortuneFit& Fit() {
  static const LafortuneFit fit{{{Real(-.304075), Real(-.304075), Real(-.304075)},
                                 {Real(-.065992), Real(-.065992), Real(-.065992)},
                                 {Real(3.047892), Real(3.047892), Real(3.047892)}},
                                {{Real(-.749561), Real(-.749561), Real(-.749561)},
                                 {Real(-1.167929), Real(-1.167929), Real(-1.167929)},
                                 {Real(6.931827), Real(6.931827), Real(6.931827)}},
                                {{Real(1.004921), Real(1.004921), Real(1.004921)},
                                 {Real(-.205529), Real(-.205529), Real(-.205529)},
                                 {Real(94.117332), Real(94.117332), Real(94.117332)}}};
  return fit;
}

const ParamTable<SurfaceSettings>& Parameters() { return SurfaceParameters(); }

std::unique_ptr<Material> Create(const SurfaceSettings& settings, const MaterialContext&) {
  return std::make_unique<LafortuneMaterial>(
      settings, Spectrum(Real(.025865), Real(.025865), Real(.025865)), Fit());
}

}  // namespace
}  // namespace exphoton

EXPHOTON_MATERIAL("felt", "dark felt, measured")
