// SPDX-License-Identifier: BSD-2-Clause
// The material "bluepaint" is light blue house paint, which reflects backwards as well.
// lafortune_material.h names the source.
#include "materials/common/lafortune_material.h"

namespace exphoton {
namespace {

const LafortuneFit& Fit() {
  static const LafortuneFit fit{{{Real(.870567), Real(.857255), Real(.670982)},
                                 {Real(.803624), Real(.774290), Real(.586674)},
                                 {Real(21.820103), Real(18.597755), Real(7.472717)}},
                                {{Real(-.451218), Real(-.406681), Real(-.477976)},
                                 {Real(.023123), Real(.017625), Real(.227295)},
                                 {Real(2.774499), Real(2.581499), Real(3.677653)}},
                                {{Real(-1.031545), Real(-1.029426), Real(-1.026588)},
                                 {Real(.706734), Real(.696530), Real(.687715)},
                                 {Real(66.899060), Real(63.767912), Real(57.489181)}}};
  return fit;
}

const ParamTable<SurfaceSettings>& Parameters() { return SurfaceParameters(); }

std::unique_ptr<Material> Create(const SurfaceSettings& settings, const MaterialContext&) {
  return std::make_unique<LafortuneMaterial>(
      settings, Spectrum(Real(.3094), Real(.39667), Real(.70837)), Fit());
}

}  // namespace
}  // namespace exphoton

EXPHOTON_MATERIAL("bluepaint", "light blue paint, measured")
