// SPDX-License-Identifier: BSD-2-Clause
// CameraPath makes the contributions of one camera sample of bidirectional path tracing: hits of
// lights, next event estimation, and connections to the points of a light path, each with its
// weight (Veach 1997, sections 10.2 and 10.3).
#pragma once

#include <span>
#include <vector>

#include "core/lights/selection/light_selection.h"
#include "core/transport/volume_integrator.h"
#include "integrators/lightpaths/light_path.h"
#include "integrators/lightpaths/path_weight.h"

namespace exphoton {

// The kind of a whole path decides its AOV, and whether a required feature covers it.
struct PathKind {
  int bounces = 0;      // surface points between camera and light
  int scatterings = 0;  // non-specular bounces
  bool isFirstSpecular = false, isLastSpecular = false;

  explicit PathKind(std::span<const VertexDensities> path) : bounces(int(path.size()) - 1) {
    for (int i = 0; i < bounces; ++i) scatterings += !path[std::size_t(i)].isSpecular;
    if (bounces == 0) return;
    isFirstSpecular = path.front().isSpecular;
    isLastSpecular = path[std::size_t(bounces - 1)].isSpecular;
  }
  bool IsNeeded(const RequiredFeatures& features) const {
    if (scatterings >= 2 && !features.Needs(Feature::Indirect)) return false;
    return scatterings == 0 || !isLastSpecular || features.Needs(Feature::Caustics);
  }
  Spectrum& In(AovSample& aovs) const {
    if (bounces == 0) return aovs.emission;
    if (isFirstSpecular) return aovs.specular;
    if (bounces == 1) return aovs.direct;
    return scatterings == 1 ? aovs.caustic : aovs.indirect;
  }
};

// The parts of an integrator that are the same for all samples.
struct BidirectionalLighting {
  std::unique_ptr<const LightSampler> direct;  // technique 1
  LightPathTracer tracer;                      // techniques from 2 on
};

// CameraPath makes all contributions of one camera sample.
class CameraPath {
 public:
  CameraPath(const BidirectionalLighting& lighting, const LightPath& light, int maxDepth,
             LiContext& context)
      : lighting_(lighting),
        light_(light),
        maxDepth_(maxDepth),
        context_(context),
        lobes_(context.scene.Features().Needs(Feature::Specular) ? LobeSet::All
                                                                 : LobeSet::NonSpecular),
        hasLightPaths_(context.scene.Features().Needs(Feature::Indirect)) {}

  const Spectrum& Sum() const { return sum_; }

  void AddMedia(const MediaSegment& media);

  // Technique 0: the ray from the last vertex escapes.
  void AddEscaped(const Vector3& w);
  // Technique 0: the ray from the last vertex hits a light.
  void AddEmission(const SurfaceInteraction& hit);

  // Appends a surface point that the ray from the last vertex hit.
  void Append(const SurfaceInteraction& hit);

  // Technique 1: next event estimation at the last vertex.
  void AddDirect(const ShadingPoint& point, Real uChoice, Point2 u, Real uPart);

  // Techniques from 2 on: joins the last vertex to all points of the light path.
  void AddConnections(const ShadingPoint& point);

  // Measures the light beyond the last vertex, which the depth limit leaves out.
  void MeasureCutLight(const ShadingPoint& point) const;

  // Extends the path by one BSDF sample. Returns false if it ends. The last vertex takes the ray.
  bool Continue(const ShadingPoint& point, Point2 u, Real uLobe, Real uRoulette,
                RayDifferential* ray);
  bool IsLastSpecular() const { return count_ > 0 && path_[std::size_t(count_ - 1)].isSpecular; }

 private:
  static constexpr int kRouletteDepth = 4;
  static constexpr Real kMaxSurvival = Real(.98);

  static double ToArea(const Vector3& w, const Normal3& ng, Real distance) {
    return double(AbsDot(w, ng)) / (double(distance) * double(distance));
  }
  VertexDensities& Vertex(int i) {
    if (std::size_t(i) >= path_.size()) path_.resize(std::size_t(i) + 1);
    return path_[std::size_t(i)];
  }
  // Returns whether any required feature covers a path that ends at the last vertex's direct light.
  bool IsNeededWithDirect() const {
    return scatterings_ == 0 || context_.scene.Features().Needs(Feature::Indirect);
  }
  double DirectDensity(const Light& light, const SurfacePoint& from, const Vector3& w,
                       const SurfacePoint* on, double toArea) const;
  // Sets the densities of the camera path's last two vertices for a light path that arrives at the
  // last one from direction w. `next` is the density of the last one.
  void SetFromLight(const ShadingPoint& point, const Vector3& w, double next);

  // Adds a contribution of technique s, of the path made of the first `length` vertices.
  void Add(const Spectrum& contribution, int s, int length, double direct, bool isDelta);

  // Adds the emission at the end of the camera path; the end's density fromCamera is set.
  void AddHit(const Light& light, const SurfacePoint* on, const Vector3& w, double toArea,
              const Spectrum& radiance);

  void Connect(const ShadingPoint& point, int m);

  const BidirectionalLighting& lighting_;
  const LightPath& light_;
  int maxDepth_;
  LiContext& context_;
  LobeSet lobes_;
  bool hasLightPaths_;
  std::vector<VertexDensities> path_;  // the camera path, then scratch space
  int count_ = 0;                      // surface points of the camera path
  SurfacePoint last_;                  // its last point
  double toPrevious_ = 1;              // from its last point to the one before
  double bsdfPdf_ = 1;                 // of the ray that leaves its last point, per solid angle
  int scatterings_ = 0;                // non-specular bounces
  Spectrum beta_{1}, sum_;
  Real etaScale_ = 1;
};

}  // namespace exphoton
