// SPDX-License-Identifier: BSD-2-Clause
// Bsdf holds the lobes of a surface at one point, in world space. The lobes live in the caller's
// arena. The side of wi relative to the *geometric* normal decides between reflection and
// transmission. The shading normal gives the frame and the cosines.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "core/geometry/interaction.h"
#include "core/scattering/bxdf.h"

namespace exphoton {

struct BsdfSample {
  Vector3 wi;           // unit, world
  Spectrum throughput;  // f |wi.ns| / pdf; finite
  Real pdf = 0;         // per solid angle over the masked lobes; a specular lobe's probability
  LobeSet lobe = LobeSet::None;
  Real eta = 1;  // of a specular transmission: index on wo's side / index on wi's side

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
  std::span<const Bxdf* const> Lobes() const { return {lobes_.data(), std::size_t(count_)}; }
  const Normal3& Ns() const { return frame_.z; }
  const Normal3& Ng() const { return ng_; }

  // Returns the sum over the non-specular masked lobes, per steradian. It does not depend on the
  // transport mode; only specular refraction does.
  Spectrum f(const Vector3& wo, const Vector3& wi, LobeSet mask = LobeSet::All) const;
  // Returns the mean of the masked lobes' densities, per solid angle. Specular lobes in the mask
  // count with density 0, so pass the same mask to f, Pdf and Sample.
  Real Pdf(const Vector3& wo, const Vector3& wi, LobeSet mask = LobeSet::All) const;
  // Returns f and Pdf together, at little more than the cost of one.
  BsdfValue Evaluate(const Vector3& wo, const Vector3& wi, LobeSet mask) const;
  // Picks one masked lobe uniformly by uLobe. If it is specular, a second choice picks a specular
  // lobe in proportion to its coefficient. Returns nullopt if there is no sample (absorbed). If wo
  // lies between the two normals, specular lobes reflect about the geometric normal.
  // In Importance mode, wo points to the origin of a photon, and smooth lobes scatter by f(wi, wo).
  // This differs from f(wo, wi) if the two normals disagree: only diffuse lobes scatter light from
  // behind the shading normal, but all scatter to every direction in front of the geometric normal.
  // The throughput is f(wi, wo) |wi.ns| / pdf, without the ShadingNormalFactor.
  std::optional<BsdfSample> Sample(const Vector3& wo, Point2 u, Real uLobe,
                                   LobeSet mask = LobeSet::All,
                                   TransportMode mode = TransportMode::Radiance) const;
  // Returns a bound on the throughput of every Sample(wo, ..., mask, mode) for each channel, or
  // nullopt if a lobe knows none. A sample in Importance mode whose direction was on different
  // sides of the two normals may exceed it.
  std::optional<Spectrum> ThroughputBound(const Vector3& wo, LobeSet mask) const;
  // Returns the sum of the hemispherical-hemispherical reflectances of the masked lobes.
  Spectrum Rho(LobeSet mask) const;
  // Returns whether all diffuse lobes are Lambertian (Bxdf::IsLambertian).
  bool IsLambertian() const { return isLambertian_; }
  // Returns whether the diffuse lobes are coated (Bxdf::IsCoated): if one is, all are.
  bool IsCoated() const { return isCoated_; }

 private:
  template <class Visit>
  void VisitMatching(const Vector3& wo, const Vector3& wi, LobeSet mask, const Visit& visit) const;

  Frame frame_;
  Normal3 ng_;
  std::array<const Bxdf*, kMaxLobes> lobes_{};
  int count_ = 0;
  LobeSet present_ = LobeSet::None;
  bool isLambertian_ = true, isCoated_ = false;
};

}  // namespace exphoton
