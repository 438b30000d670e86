// SPDX-License-Identifier: BSD-2-Clause
// Bsdf: the lobes of a surface at one point, in world space. Lobes live in the caller's arena.
// The side of wi against the *geometric* normal decides between reflection and transmission; the
// shading normal gives the frame and the cosines.
#pragma once

#include <array>
#include <optional>

#include "core/geometry/interaction.h"
#include "core/scattering/bxdf.h"

namespace exphoton {

struct BsdfSample {
  Vector3 wi;           // unit, world
  Spectrum throughput;  // f |wi.ns| / pdf; finite
  Real pdf = 0;         // per solid angle over the masked lobes; a specular lobe: its probability
  LobeSet lobe = LobeSet::None;
  Real eta = 1;  // of a specular transmission: index on wo's side over that on wi's side

  bool IsSpecular() const { return Intersects(lobe, LobeSet::Specular); }
  bool IsTransmission() const { return Intersects(lobe, LobeSet::Transmission); }
};

struct BsdfValue {
  Spectrum f;
  Real pdf = 0;
};

class Bsdf {
 public:
  static constexpr int kMaxLobes = 8;

  // The frame is taken from si.shading.
  explicit Bsdf(const SurfaceInteraction& si);

  void Add(const Bxdf* lobe);  // null is ignored; more than kMaxLobes throws Error(Internal)

  bool Has(LobeSet mask) const { return Intersects(present_, mask); }
  int Count(LobeSet mask = LobeSet::All) const;
  const Normal3& Ns() const { return frame_.z; }
  const Normal3& Ng() const { return ng_; }

  // Sum over the non-specular masked lobes; per steradian, symmetric in mode except for refraction.
  Spectrum f(const Vector3& wo, const Vector3& wi, LobeSet mask = LobeSet::All) const;
  // Mean of the masked lobes' densities, per solid angle. Specular lobes in the mask count in the
  // mean with density 0: pass the same mask to f, Pdf and Sample.
  Real Pdf(const Vector3& wo, const Vector3& wi, LobeSet mask = LobeSet::All) const;
  // Both, for the price of little more than one.
  BsdfValue Evaluate(const Vector3& wo, const Vector3& wi, LobeSet mask) const;
  // Picks one masked lobe by uLobe, uniformly; if a specular one, then again among the specular
  // ones in proportion to what they carry. nullopt: no sample (absorbed).
  // Importance: wo points to where a photon came from, and smooth lobes scatter by f(wi, wo). Where
  // the normals differ that is not f(wo, wi): light from behind the shading normal is not scattered
  // but scattered light goes there, to every direction before the geometric normal. The throughput
  // is f(wi, wo) |wi.ns| / pdf, still without the ShadingNormalFactor.
  std::optional<BsdfSample> Sample(const Vector3& wo, Point2 u, Real uLobe,
                                   LobeSet mask = LobeSet::All,
                                   TransportMode mode = TransportMode::Radiance) const;
  // Sum of hemispherical-hemispherical reflectances of the masked lobes.
  Spectrum Rho(LobeSet mask) const;
  // Whether the diffuse reflection is Bxdf::IsCoated.
  bool IsCoated() const { return isCoated_; }

 private:
  template <class Visit>
  void VisitServing(const Vector3& wo, const Vector3& wi, LobeSet mask, const Visit& visit) const;

  Frame frame_;
  Normal3 ng_;
  std::array<const Bxdf*, kMaxLobes> lobes_{};
  int count_ = 0;
  LobeSet present_ = LobeSet::None;
  bool isCoated_ = false;
};

}  // namespace exphoton
