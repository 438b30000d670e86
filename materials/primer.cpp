// SPDX-License-Identifier: BSD-2-Clause
// The material "primer" is grey primer, with strong reflection at grazing angles.
// lafortune_material.h names the source.
#include "materials/common/lafortune_material.h"

namespace exphoton {
namespace {

const LafortuneFit& Fit() {
  static const LafortuneFit fit{{{Real(-.399286), Real(-1.033473), Real(-1.058104)},
                                 {Real(.167504), Real(.009545), Real(-.068002)},
                                 {Real(2.466633), Real(7.637253), Real(8.117645)}},
                                {{Real(-1.041861), Real(-1.100108), Real(-1.087779)},
                                 {Real(.014375), Real(-.198147), Real(-.053605)},
                                 {Real(7.993722), Real(29.446268), Real(41.988990)}},
                                {{Real(-1.098605), Real(-.379883), Real(-.449038)},
                                 {Real(-.145110), Real(.159127), Real(.173224)},
                                 {Real(31.899719), Real(2.372852), Real(2.636161)}}};
  return fit;
}

const ParamTable<SurfaceSettings>& Parameters() { return SurfaceParameters(); }

std::unique_ptr<Material> Create(const SurfaceSettings& settings, const MaterialContext&) {
  return std::make_unique<LafortuneMaterial>(
      settings, Spectrum(Real(.118230), Real(.121218), Real(.133209)), Fit());
}

}  // namespace
}  // namespace exphoton

EXPHOTON_MATERIAL("primer", "grey primer, measured")
