// SPDX-License-Identifier: BSD-2-Clause
// The integrator "bidirectional" implements bidirectional path tracing: a path from the camera and
// a path from a light are joined at every pair of their vertices, and the power heuristic weights
// all techniques that make the same path (Veach 1997, chapter 10). Technique 0 hits the light,
// technique 1 is next event estimation, and the others join two surface points. No light path is
// joined to the camera itself, because a sample contributes to its own pixel only. With maxdepth d,
// light is collected at the first d + 1 surfaces of a joined path, as with "path". The estimate is
// unbiased.
#include "core/plugin.h"
#include "integrators/lightpaths/camera_path.h"

namespace exphoton {
namespace {

struct Settings {
  int maxDepth = 5;
};

const ParamTable<Settings>& Parameters() {
  static const ParamTable<Settings> table{
      Param("maxdepth", &Settings::maxDepth,
            "bounces after the first surface; 0: emission and direct light only")
          .Range(0, 1000)
          .WhenNamed(100)};
  return table;
}

constexpr std::uint64_t kCameraStream = 0x62646370, kLightStream = 0x62646c70;

class BidirectionalIntegrator final : public SurfaceIntegrator {
 public:
  explicit BidirectionalIntegrator(const Settings& settings) : maxDepth_(settings.maxDepth) {}

  void Preprocess(const Scene& scene, PreprocessContext&) override {
    lighting_.direct = scene.MakeLightSampler(LightSelection::Auto);
    lighting_.tracer = LightPathTracer(scene, true);
  }

  void RequestSamples(const Scene&, const Sampler&, SampleLayout* layout) override {
    for (VertexArrays& a : arrays_) {
      a = {layout->Request1D(1), layout->Request2D(1), layout->Request1D(1), layout->Request2D(1),
           layout->Request1D(1)};
    }
    emission_ = {layout->Request1D(1), layout->Request2D(1), layout->Request2D(1),
                 layout->Request1D(1)};
  }

  AovSet Aovs() const override { return kLightAovs; }

  FeatureSet ComputedFeatures() const override {
    return FeatureSet::All().Without(kPhotonMapFeatures);
  }

  std::vector<std::string> Explain(const Scene& scene) const override {
    if (!scene.Features().Needs(Feature::Indirect))
      return {"light paths   none: no indirect light"};
    return {"light paths   one per camera sample, joined at every pair of surface points"};
  }

  Spectrum Li(const RayDifferential& cameraRay, LiContext& context) const override {
    LightPath light;
    bool hasLight = false;
    CameraWalk walk{context, CameraPath(lighting_, light, maxDepth_, context),
                    context.Stream(kCameraStream), cameraRay};
    CameraPath& path = walk.path;
    RayDifferential& ray = walk.ray;
    for (int depth = 0;; ++depth) {
      const RayKind kind = depth == 0              ? RayKind::Camera
                           : path.IsLastSpecular() ? RayKind::Specular
                                                   : RayKind::Bsdf;
      const auto hit = context.Intersect(ray, kind);
      path.AddMedia(AlongMedia(ray, hit ? &hit->p : nullptr, context));
      if (!hit) {
        path.AddEscaped(ray.d);
        if (depth == 0) context.alpha = path.Sum().IsBlack() ? 0 : 1;
        break;
      }
      path.AddEmission(*hit);
      // The ray beyond the last vertex is traced only for the emission that it may hit.
      if (depth > maxDepth_) break;
      path.Append(*hit);
      const ShadingPoint point =
          MakeShadingPoint(*hit, ray, depth, TransportMode::Radiance, &context.arena);
      if (!hasLight && point.bsdf.Has(LobeSet::NonSpecular)) {
        TraceLightPath(cameraRay.time, context, &light);
        hasLight = true;
      }
      if (depth == maxDepth_) path.MeasureCutLight(point);
      if (!AddVertex(point, depth, &walk)) break;
    }
    return path.Sum();
  }

 private:
  static constexpr int kSampledVertices = 3;  // vertices that use the sampler, not a stream

  struct VertexArrays {
    int choice1D = -1, light2D = -1, part1D = -1, bsdf2D = -1, lobe1D = -1;
  };
  // CameraWalk is the path of a camera sample with what its next step needs.
  struct CameraWalk {
    LiContext& context;
    CameraPath path;
    RandomStream random;
    RayDifferential ray;  // towards the next vertex
  };
  struct EmissionArrays {
    int choice1D = -1, position2D = -1, direction2D = -1, part1D = -1;
  };

  void TraceLightPath(Real time, LiContext& context, LightPath* light) const {
    if (maxDepth_ < 1 || !context.scene.Features().Needs(Feature::Indirect)) return;
    const CameraSamples& samples = context.samples;
    lighting_.tracer.Trace(
        {samples.Array1D(emission_.choice1D)[0], samples.Array2D(emission_.position2D)[0],
         samples.Array2D(emission_.direction2D)[0], samples.Array1D(emission_.part1D)[0], time},
        maxDepth_, {context.Stream(kLightStream), &context.arena, &context.rays}, light);
  }

  // Collects light at a point and extends the path. Returns false if the path ends.
  bool AddVertex(const ShadingPoint& point, int depth, CameraWalk* walk) const {
    auto& [context, path, random, ray] = *walk;
    if (depth < kSampledVertices) {
      const VertexArrays& a = arrays_[std::size_t(depth)];
      const CameraSamples& s = context.samples;
      path.AddDirect(point, s.Array1D(a.choice1D)[0], s.Array2D(a.light2D)[0],
                     s.Array1D(a.part1D)[0]);
      path.AddConnections(point);
      return path.Continue(point, s.Array2D(a.bsdf2D)[0], s.Array1D(a.lobe1D)[0], random.Uniform(),
                           &ray);
    }
    Real u[7];
    for (Real& value : u) value = random.Uniform();
    path.AddDirect(point, u[0], {u[1], u[2]}, u[3]);
    path.AddConnections(point);
    return path.Continue(point, {u[4], u[5]}, u[6], random.Uniform(), &ray);
  }

  int maxDepth_;
  BidirectionalLighting lighting_;
  std::array<VertexArrays, kSampledVertices> arrays_;
  EmissionArrays emission_;
};

std::unique_ptr<SurfaceIntegrator> Create(const Settings& settings, const IntegratorContext&) {
  return std::make_unique<BidirectionalIntegrator>(settings);
}

}  // namespace
}  // namespace exphoton

EXPHOTON_INTEGRATOR("bidirectional",
                    "bidirectional path tracing, without bias; sees caustics as noisily as path")
