// SPDX-License-Identifier: BSD-2-Clause
// SurfaceIntegrator: the interface of light transport algorithms (plugins), and the contexts that
// the renderer hands them. One object serves all threads: Li is const.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/arena.h"
#include "core/base/statistics.h"
#include "core/imaging/film/aovs.h"
#include "core/math/sampling/random.h"
#include "core/sampling/sampler.h"
#include "core/scene/scene.h"
#include "core/transport/pixel_state.h"
#include "core/transport/thread_state.h"

namespace exphoton {

class Camera;
class Log;
class ThreadPool;
class ProgressReporter;
class VolumeIntegrator;

// Thrown by Preprocess where it was asked to stop; the renderer catches it.
struct PreprocessStopped {};

// What Preprocess works with.
struct PreprocessContext {
  ThreadPool& threads;
  std::uint64_t seed = 0;
  Log& log;
  ProgressReporter& progress;  // one bar a phase
  Statistics& statistics;
  bool isStrict = false;           // what is not finite ends the render: throw Error(Internal)
  const Camera* camera = nullptr;  // for what depends on the view; null: nothing may
  Point2i resolution;              // of the full image, whatever part of it is rendered
  const VolumeIntegrator* volume = nullptr;  // light that media add; null: none
  const std::atomic<bool>* stop = nullptr;   // set from outside; null: cannot be stopped

  // To be called now and then by long work. Throws PreprocessStopped.
  void CheckStop() const {
    if (stop && stop->load(std::memory_order_relaxed)) throw PreprocessStopped();
  }
};

// What one camera sample works with; lives on the stack of the thread that renders it.
struct LiContext {
  const Scene& scene;
  const CameraSamples& samples;
  Arena& arena;       // reset by the renderer after each camera sample
  RayCounters& rays;  // this thread's
  std::uint64_t key;  // of (seed, pixel, sample index)
  Real alpha = 1;     // set to 0 by Li where the camera ray escapes and sees nothing
  // Where Li leaves what it says of layers besides the radiance; null where no layer was asked for.
  AovSample* aovs = nullptr;
  PixelState* notes = nullptr;               // of the pixel; null: nothing is kept
  ThreadState* threadState = nullptr;        // of this thread; null: nothing is kept
  const VolumeIntegrator* volume = nullptr;  // light that media add; null: none
  std::uint64_t mediaSegments = 0;           // stretches of rays through media so far

  // Random numbers for one purpose (`stream`: a constant of the integrator's) at this sample.
  RandomStream Stream(std::uint64_t stream) const { return RandomStream(HashKey({key, stream})); }

  std::optional<SurfaceInteraction> Intersect(const RayDifferential& ray, RayKind kind) {
    rays.Count(kind);
    return scene.Intersect(ray);
  }
  std::optional<Scene::HitPoint> IntersectPoint(const Ray& ray, RayKind kind) {
    rays.Count(kind);
    return scene.IntersectPoint(ray);
  }
  bool Occluded(const Ray& ray) {
    rays.Count(RayKind::Shadow);
    return scene.Occluded(ray);
  }
  // What part of the light gets through along a shadow ray: 0 where a surface blocks it.
  Spectrum Unoccluded(const Ray& ray) {
    return Occluded(ray) ? Spectrum() : scene.Transmittance(ray);
  }
};

// A photon that an integrator has stored, for people to look at.
struct StoredPhoton {
  std::string map;  // "indirect"
  Point3 p;
  Vector3 wi;  // where it came from
  Spectrum power;
  Real distance = 0;  // from the point that was asked about
};

class SurfaceIntegrator {
 public:
  virtual ~SurfaceIntegrator() = default;

  // Work before the first camera ray (photon maps). Called again, with another seed, for each of
  // several independent passes over the image: what it made before is to be replaced.
  virtual void Preprocess(const Scene& scene, PreprocessContext& context) {
    (void)scene, (void)context;
  }
  // Says which sample arrays Li wants. Idempotent: may be called any number of times, each time
  // with a fresh layout.
  virtual void RequestSamples(const Scene& scene, const Sampler& sampler, SampleLayout* layout) {
    (void)scene, (void)sampler, (void)layout;
  }
  // What it will compute for this scene, one line a thing ("photons       100000 indirect"), for
  // `exphoton explain`.
  virtual std::vector<std::string> Explain(const Scene& scene) const {
    (void)scene;
    return {};
  }
  // The layers that Li fills where LiContext::layers is there. Those of kRendererLayers need no
  // integrator. Light layers must sum to what Li returns, to rounding.
  virtual AovSet Aovs() const { return {}; }
  // Radiance arriving along the camera ray.
  virtual Spectrum Li(const RayDifferential& ray, LiContext& context) const = 0;

  // The photons of a map ("direct", "caustic" or "indirect") nearest to a point, nearest first,
  // after Preprocess. Empty where there are none.
  virtual std::vector<StoredPhoton> PhotonsNear(const Point3& p, const std::string& map,
                                                int count) const {
    (void)p, (void)map, (void)count;
    return {};
  }
};

}  // namespace exphoton
