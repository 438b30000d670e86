// SPDX-License-Identifier: BSD-2-Clause
#include "integrators/photon/shooting/radiance_site.h"

namespace exphoton {

RadiancePhotonSite RadianceSiteAt(const ShadingPoint& point, const RestPose& rest) {
  const Bsdf& bsdf = point.bsdf;
  RadiancePhotonSite site;
  site.p = rest.Point(point.surface.p);
  site.n = rest.Normal(FaceForward(point.surface.ng, point.Wo()));
  site.reflectance = bsdf.Rho(LobeSet::DiffuseReflection);
  site.transmittance = bsdf.Rho(LobeSet::DiffuseTransmission);
  const Real glossy = bsdf.Has(LobeSet::Glossy) ? bsdf.Rho(LobeSet::Glossy).Y() : Real(0);
  const Real all = glossy + (site.reflectance + site.transmittance).Y();
  site.glossyShare = SafeDivide(glossy, all, Real(0));
  site.isCoated = bsdf.IsCoated();
  site.normals = {rest.Normal(point.smooth), rest.Normal(bsdf.Ns())};
  return site;
}

}  // namespace exphoton
