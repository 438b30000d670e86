// SPDX-License-Identifier: BSD-2-Clause
// EstimateIrradiance: M x N strata of equal cosine-weighted solid angle, M in the polar angle theta
// and N in the azimuth phi.
#include "integrators/irradiance/irradiance_estimate.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "core/math/sampling/sampling.h"

namespace exphoton {
namespace {

class Hemisphere {
 public:
  Hemisphere(const Normal3& n, int rays, Arena* arena)
      : frame_(Frame::FromZ(n)),
        m_(std::max(1, int(std::sqrt(double(rays) / 3.14159265)))),
        n_(std::max(1, rays / m_)),
        rays_(arena->MakeArray<IndirectRadiance::Incident>(std::size_t(m_) * std::size_t(n_))) {}

  void Trace(const SurfacePoint& surface, const IndirectRadiance& incident, RandomStream* random,
             LiContext& context) {
    const RaySpawner spawner(surface);
    const bool isFront = Dot(frame_.z, surface.ng) > 0;
    for (int k = 0; k < n_; ++k) {
      for (int j = 0; j < m_; ++j) {
        const Real sin2 = (Real(j) + random->Uniform()) / Real(m_);
        const Real phi = 2 * kPi * (Real(k) + random->Uniform()) / Real(n_);
        const Real cosTheta = std::max(SafeSqrt(1 - sin2), kMachineEpsilon);
        const Vector3 w = frame_.ToWorld(SphericalDirection(std::sqrt(sin2), cosTheta, phi));
        // The opposite of a direction behind the surface lies between the normals, with the same
        // absolute cosine.
        const bool isOutside = (Dot(w, surface.ng) > 0) == isFront;
        At(j, k) = incident.Along(spawner.Spawn(isOutside ? w : -w), random, context);
        // The stratum's middle, because the tangent of single rays has no bound.
        const Real middle = (Real(j) + Real(.5)) / Real(m_);
        AddRotation(At(j, k).radiance, SafeSqrt(middle / (1 - middle)), phi);
      }
    }
  }

  IrradianceEstimate Result() const {
    IrradianceEstimate result;
    const Real scale = kPi / Real(m_ * n_);
    double inverse = 0;
    for (const auto& ray : rays_) {
      result.irradiance += ray.radiance * scale;
      inverse += ray.distance > 0 ? 1 / double(ray.distance) : 0;
    }
    if (inverse > 0) result.meanDistance = Real(double(m_) * n_ / inverse);
    for (std::size_t c = 0; c < 3; ++c) {
      result.rotation[c] = frame_.ToWorld(rotation_[c] * scale);
      result.translation[c] = frame_.ToWorld(Translation(int(c)));
    }
    return result;
  }

 private:
  IndirectRadiance::Incident& At(int j, int k) { return rays_[std::size_t(k * m_ + j)]; }
  const IndirectRadiance::Incident& At(int j, int k) const {
    return rays_[std::size_t(k * m_ + j)];
  }

  // A turn about v changes the cosine of direction w by w . (v x n) = sin(theta) v . (n x u), where
  // u is the direction of azimuth phi in the tangent plane.
  void AddRotation(const Spectrum& radiance, Real tanTheta, Real phi) {
    const Vector3 across(-std::sin(phi), std::cos(phi), 0);
    for (std::size_t c = 0; c < 3; ++c) rotation_[c] += across * (radiance[int(c)] * tanTheta);
  }

  // When the point moves, the boundaries between strata sweep over the surfaces behind them. The
  // nearer of the two surfaces gives the speed (Ward and Heckbert 1992, eq. 12 and following).
  Vector3 Translation(int c) const {
    Vector3 sum;
    for (int k = 0; k < n_; ++k) {
      const Real phi = 2 * kPi * (Real(k) + Real(.5)) / Real(n_);
      const Real edge = 2 * kPi * Real(k) / Real(n_);
      const Vector3 along(std::cos(phi), std::sin(phi), 0);
      const Vector3 across(-std::sin(edge), std::cos(edge), 0);
      Real towards = 0, sideways = 0;
      for (int j = 0; j < m_; ++j) {
        const Real low = std::sqrt(Real(j) / Real(m_)), high = std::sqrt(Real(j + 1) / Real(m_));
        if (j > 0) towards += low * (1 - low * low) * Step(At(j - 1, k), At(j, k), c);
        if (n_ > 1) sideways += (high - low) * Step(At(j, (k + n_ - 1) % n_), At(j, k), c);
      }
      sum += along * (towards * 2 * kPi / Real(n_)) + across * sideways;
    }
    return sum;
  }
  static Real Step(const IndirectRadiance::Incident& from, const IndirectRadiance::Incident& to,
                   int c) {
    const Real nearest = std::min(from.distance, to.distance);
    return SafeDivide(to.radiance[c] - from.radiance[c], nearest, Real(0));
  }

  Frame frame_;
  int m_, n_;
  std::span<IndirectRadiance::Incident> rays_;  // by azimuth, then by polar angle
  std::array<Vector3, 3> rotation_{};
};

}  // namespace

IrradianceEstimate EstimateIrradiance(const IrradianceQuery& query,
                                      const IndirectRadiance& incident, RandomStream random,
                                      LiContext& context) {
  const Arena::Mark mark = context.arena.GetMark();
  Hemisphere hemisphere(query.n, query.rays, &context.arena);
  hemisphere.Trace(query.surface, incident, &random, context);
  const IrradianceEstimate result = hemisphere.Result();
  context.arena.Rewind(mark);
  return result;
}

}  // namespace exphoton
