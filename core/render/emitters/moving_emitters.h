// SPDX-License-Identifier: BSD-2-Clause
// MovingEmitters are the surfaces that emit light and move while the shutter is open. A camera
// sample sees them at a single time, so a small lamp that moves far is seen by few samples. The
// renderer therefore replaces their light, seen directly or over specular surfaces, by the mean
// over several times.
#pragma once

#include <vector>

#include "core/imaging/film/camera.h"
#include "core/render/emitters/emitted_light.h"

namespace exphoton {

class MovingEmitters {
 public:
  // The times of one camera sample, its own included. With 16, a lamp that covers a point for a
  // sixteenth of the exposure is seen by nearly all samples.
  static constexpr int kTimes = 16;

  // `depth` is SurfaceIntegrator::EmissionDepth. Empty if the camera moves. The scene must outlive
  // this object.
  MovingEmitters(const Scene& scene, const Camera& camera, std::optional<int> depth);

  // Returns whether the ray may hit one of the emitters at some time.
  bool MayMeet(const Ray& ray) const;
  // Returns whether specular rays count, and not only the camera ray.
  bool FollowsSpecularRays() const { return depth_ > 0 && !bounds_.empty(); }
  // Returns whether a surface moves while the shutter is open.
  bool Contain(const SurfaceInteraction& surface) const {
    return surface.motion && surface.motion->MovesWithin(shutter_);
  }
  // Traces the ray, and specular rays that follow from it. `rays` counts them.
  EmittedLight Along(const RayDifferential& ray, const LiContext& sample, RayCounters* rays) const {
    return LightAlong(ray, *this, depth_, sample, rays);
  }

 private:
  int depth_ = 0;
  Interval shutter_;
  std::vector<Bounds3> bounds_;  // each contains an emitter at all times
};

// EmissionMean is the mean over times u, u + 1/n, u + 2/n ... modulo 1, of which u is the sample's
// own. Only times at which the rays are near emitters count, and the sample itself is one of them.
// For a random u the expected value is the mean over all times, because the others are black.
class EmissionMean {
 public:
  explicit EmissionMean(const EmittedLight& own) : sum_(own) {}
  void Add(const EmittedLight& other) {
    if (!other.isNear) return;
    sum_.Add(other, 1);
    ++count_;
  }
  Spectrum First() const { return sum_.first / Real(count_); }
  Spectrum Specular() const { return sum_.specular / Real(count_); }

 private:
  EmittedLight sum_;
  int count_ = 1;
};

}  // namespace exphoton
