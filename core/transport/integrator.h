// SPDX-License-Identifier: BSD-2-Clause
// SurfaceIntegrator is the interface of light transport algorithms (plugins). The contexts hold the
// data that the renderer passes to them. All threads share one integrator, so Li is const.
#pragma once

#include <atomic>
#include <cstddef>
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
#include "core/transport/correction_sample.h"
#include "core/transport/gather_record.h"
#include "core/transport/pixel_state.h"
#include "core/transport/thread_state.h"

namespace exphoton {

class Camera;
class Log;
class ThreadPool;
class ProgressReporter;
class VolumeIntegrator;
struct PhotonFileUse;

// Preprocess throws this when a stop is requested. The renderer catches it.
struct PreprocessStopped {};

// The data that the renderer passes to Preprocess.
struct PreprocessContext {
  ThreadPool& threads;
  std::uint64_t seed = 0;
  Log& log;
  ProgressReporter& progress;  // one bar per phase
  Statistics& statistics;
  bool isStrict = false;                      // if true, a non-finite value throws Error(Internal)
  const Camera* camera = nullptr;             // for view-dependent work; null: no such work
  Point2i resolution;                         // of the full image, regardless of the crop window
  const VolumeIntegrator* volume = nullptr;   // in-scattered and emitted light of media; null: none
  const std::atomic<bool>* stop = nullptr;    // set externally; null: cannot be stopped
  const PhotonFileUse* photonFile = nullptr;  // see photon_file_use.h; null: no file is used
  // The area of the disks of density estimates, relative to a render that is not progressive; in
  // (0,1].
  double diskArea = 1;
  // The point of the exposure, in [0,1), at which all photons start; nullopt: at any.
  std::optional<Real> time{};

  // Long work must call this regularly. Throws PreprocessStopped.
  void CheckStop() const {
    if (stop && stop->load(std::memory_order_relaxed)) throw PreprocessStopped();
  }
};

// The data of one camera sample. It lives on the stack of the rendering thread.
struct LiContext {
  const Scene& scene;
  const CameraSamples& samples;
  Arena& arena;       // the renderer resets it before each camera sample
  RayCounters& rays;  // of this thread
  std::uint64_t key;  // hash of (seed, pixel, sample index)
  Real alpha = 1;     // Li sets it to 0 if the camera ray escapes and sees no light
  // Li writes its AOVs here. Null if no AOV is requested.
  AovSample* aovs = nullptr;
  // Li hands over the diffuse part of final gathers here and leaves it out of its result. Null if
  // gathers are not shared.
  GatherRecords* gathers = nullptr;
  // Li adds the correction of this sample here. Null if the bias is not certified.
  CorrectionSample* correction = nullptr;
  // Li adds its result as it would be if the photons of each path had a random sign. The expected
  // value is 0. The variance shows the noise that photons cause (docs/theory/exphotonmap.md,
  // section 5.3). Null if it is not wanted.
  Spectrum* signedLight = nullptr;
  PixelState* pixelState = nullptr;          // of the pixel; null: no state is kept
  ThreadState* threadState = nullptr;        // of this thread; null: no state is kept
  const VolumeIntegrator* volume = nullptr;  // light from media; null: none
  std::uint64_t mediaSegments = 0;           // ray segments through media so far
  // Whether Li measures the light that its depth limit cuts (cut_light.h), and the luminance that
  // it found so far.
  bool measuresCutLight = false;
  double cutLight = 0;
  // Whether this is one of the SurfaceIntegrator::EdgeSamples() samples that divide the work of
  // one.
  bool isDivided = false;

  // Returns random numbers for one purpose of this sample. `stream` is a constant that the
  // integrator chooses for the purpose.
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
  // Returns the transmittance along a shadow ray; 0 if a surface blocks it.
  Spectrum Unoccluded(const Ray& ray) {
    return Occluded(ray) ? Spectrum() : scene.Transmittance(ray);
  }
};

// The names of the parameters that limit the length of camera paths and of the paths that gather
// indirect light, for warnings.
struct DepthParameters {
  const char* camera = "maxdepth";
  const char* gather = "maxdepth";
};

// What the corrections of an integrator (correction_sample.h) do not cover, as phrases.
struct CertificationLimits {
  std::vector<std::string> notCovered;
};

// A stored photon, for inspection by the user.
struct StoredPhoton {
  Point3 p;
  Vector3 wi;  // unit direction towards its origin
  Spectrum power;
  Real distance = 0;  // from the query point
};

class SurfaceIntegrator {
 public:
  virtual ~SurfaceIntegrator() = default;

  // Does the work before the first camera ray, such as photon maps. The renderer calls it again
  // with another seed for each independent pass over the image. Each call replaces earlier results.
  virtual void Preprocess(const Scene& scene, PreprocessContext& context) {
    (void)scene, (void)context;
  }
  // Requests the sample arrays that Li needs. It is idempotent: it may be called any number of
  // times, each time with a fresh layout.
  virtual void RequestSamples(const Scene& scene, const Sampler& sampler, SampleLayout* layout) {
    (void)scene, (void)sampler, (void)layout;
  }
  // Returns the effects that this integrator computes where a scene needs them. The plan of a
  // render switches the others off, and says so.
  virtual FeatureSet ComputedFeatures() const { return FeatureSet::All(); }
  // Describes the work for this scene in lines such as "photons       100000 indirect", for
  // `exphoton explain`.
  virtual std::vector<std::string> Explain(const Scene& scene) const;
  // Returns the AOVs that Li fills if LiContext::aovs is not null. The renderer itself fills
  // kRendererAovs. The light AOVs must sum to the result of Li, up to rounding.
  virtual AovSet Aovs() const { return {}; }
  virtual DepthParameters DepthLimits() const { return {}; }
  // Returns the number of specular bounces after which Li contains emission as a SpecularTree of
  // this depth finds it, in the AOVs emission and specular. 0: only the emission of the first
  // surface. The renderer may replace this light by a better estimate
  // (core/render/emitters/moving_emitters.h).
  virtual std::optional<int> EmissionDepth() const { return std::nullopt; }
  // Returns whether Li takes much longer than several camera rays. The renderer then spends such
  // rays on the edges of lamps (core/render/emitters/still_emitters.h).
  virtual bool HasCostlySamples() const { return false; }
  // Returns the number of camera samples that the renderer takes for one where a pixel shows more
  // than one surface. Li divides most of its work among them, by LiContext::isDivided. 1: no more
  // than elsewhere.
  virtual int EdgeSamples() const { return 1; }
  // Returns whether Li fills LiContext::gathers.
  virtual bool SharesGathers(const Scene& scene) const {
    (void)scene;
    return false;
  }
  // Returns nullopt if Li does not fill LiContext::correction.
  virtual std::optional<CertificationLimits> Certification(const Scene& scene) const {
    (void)scene;
    return std::nullopt;
  }
  // Returns phrases for light that Li never finds, however many samples there are, such as
  // "caustics of a light without a size".
  virtual std::vector<std::string> UnseenLight(const Scene& scene) const {
    (void)scene;
    return {};
  }
  // Returns whether Li fills LiContext::signedLight.
  virtual bool FillsSignedLight() const { return false; }
  // Returns the radiance along the camera ray.
  virtual Spectrum Li(const RayDifferential& ray, LiContext& context) const = 0;

  // Returns whether Preprocess obeys PreprocessContext::photonFile.
  virtual bool KeepsPhotons() const { return false; }
  // Returns the names of the photon maps, the most interesting first. The result is empty if the
  // integrator has none.
  virtual std::vector<std::string> PhotonMapNames() const;
  // Returns the photons nearest to p, nearest first, in the map with this index in
  // PhotonMapNames(). The result is empty if the map is. Preprocess must have run.
  virtual std::vector<StoredPhoton> PhotonsNear(const Point3& p, std::size_t map, int count) const;
};

}  // namespace exphoton
