// SPDX-License-Identifier: BSD-2-Clause
// The integrator "irradiancecache" interpolates indirect diffuse light between irradiance records
// (Ward, Rubinstein and Clear 1988) with gradients (Ward and Heckbert 1992). Direct light and
// specular recursion are as in "directlighting". Glossy lobes take one path for each point. All
// records are placed before the first pixel, so the picture depends on no order of pixels. The
// picture is biased: interpolation blurs indirect light within the error bound.
#include "core/plugin.h"
#include "core/transport/direct_lighting.h"
#include "core/transport/specular/specular_tree.h"
#include "integrators/irradiance/record_placement.h"
#include "integrators/photon/maps/rest_pose.h"

namespace exphoton {
namespace {

const ParamTable<IrradianceSettings>& Parameters() {
  using Settings = IrradianceSettings;
  static const ParamTable<Settings> table{
      Param("maxerror", &Settings::maxError,
            "a record is valid up to this share of the distance to the surroundings")
          .Range(1e-4, 100),
      Param("maxspeculardepth", &Settings::maxSpecularDepth, "specular bounces followed")
          .Range(0, 1000),
      Param("maxindirectdepth", &Settings::maxIndirectDepth,
            "bounces of indirect light; 0: none is computed")
          .Range(0, 1000),
      Param("nsamples", &Settings::rays, "rays of an irradiance record").Range(1, 65536),
      Param("minweight", &Settings::minWeight,
            "a visible point gets a record of its own if the weights of the valid ones sum to less")
          .Range(0, 100),
      Param("minpixelspacing", &Settings::minPixelSpacing, "smallest radius of a record")
          .Range(0, 1000)
          .Unit("pixels"),
      Param("maxpixelspacing", &Settings::maxPixelSpacing, "largest radius of a record")
          .Range(0, 1e6)
          .Unit("pixels"),
      Param("maxangledifference", &Settings::maxAngleDifference,
            "a record is valid for normals that differ by less than this angle")
          .Above(0)
          .AtMost(90)
          .Unit("degrees")};
  return table;
}

constexpr std::uint64_t kGlossyStream = 0x6963676c, kFreshStream = 0x69636672;
// Rays of a point without a valid record, as a part of a record's rays. The noise of such points
// averages out over the samples of a pixel.
constexpr int kFreshShare = 64;

class IrradianceCacheIntegrator final : public SurfaceIntegrator {
 public:
  explicit IrradianceCacheIntegrator(const IrradianceSettings& settings) : settings_(settings) {}

  void Preprocess(const Scene& scene, PreprocessContext& context) override {
    cache_ = {};
    incident_ = IndirectRadiance(scene, settings_.maxIndirectDepth);
    if (!incident_.IsNeeded()) return;
    const PhaseTimer timer(context.statistics, "irradiance records");
    cache_ = PlaceRecords(scene, settings_, incident_, context);
    context.statistics.SetCounter("irradiance/records", double(cache_.Size()),
                                  "irradiance records placed before rendering");
  }

  void RequestSamples(const Scene& scene, const Sampler& sampler, SampleLayout* layout) override {
    direct_.RequestSamples(scene, sampler, layout);
  }

  DepthParameters DepthLimits() const override { return {"maxspeculardepth", "maxindirectdepth"}; }

  AovSet Aovs() const override { return kLightAovs; }

  std::optional<int> EmissionDepth() const override { return 0; }
  FeatureSet ComputedFeatures() const override {
    const FeatureSet some = FeatureSet::All().Without(kPhotonMapFeatures);
    return settings_.maxIndirectDepth > 0 ? some : some.Without(kInterreflection);
  }

  std::vector<std::string> Explain(const Scene& scene) const override {
    if (!IndirectRadiance(scene, settings_.maxIndirectDepth).IsNeeded())
      return {"irradiance    none: no indirect light"};
    return {"irradiance    records of " + std::to_string(settings_.rays) +
            " rays, placed from all pixels; caustics are interpolated too"};
  }

  Spectrum Li(const RayDifferential& ray, LiContext& context) const override {
    std::uint64_t points = 0;
    return SpecularTree(settings_.maxSpecularDepth, context, incident_.Lights())
        .Radiance(ray, [&](const ShadingPoint& point) {
          SurfaceLight light{point.Le(), direct_.AllLights(point, context), {}, {}};
          const std::uint64_t number = points++;
          if (incident_.IsNeeded())
            light.indirect = Diffuse(point, number, context) + Glossy(point, number, context);
          return light.Collect(point, context);
        });
  }

 private:
  // Returns the indirect light that the diffuse lobes scatter towards wo.
  Spectrum Diffuse(const ShadingPoint& point, std::uint64_t number, LiContext& context) const {
    const IrradianceSides sides(point);
    Spectrum sum;
    if (sides.reflection) {
      Spectrum rho = point.bsdf.Rho(LobeSet::DiffuseReflection);
      if (point.bsdf.IsCoated()) rho *= CoatTransmission(AbsDot(point.bsdf.Ns(), point.Wo()));
      sum += rho * Irradiance(point, *sides.reflection, 2 * number, context);
    }
    if (sides.transmission) {
      const Spectrum rho = point.bsdf.Rho(LobeSet::DiffuseTransmission);
      sum += rho * Irradiance(point, *sides.transmission, 2 * number + 1, context);
    }
    return sum * kInvPi;
  }

  Spectrum Irradiance(const ShadingPoint& point, const Normal3& n, std::uint64_t number,
                      LiContext& context) const {
    const RestPose rest(point.surface);
    const auto found = cache_.Find(rest.Point(point.surface.p), rest.Normal(n));
    if (found.weight > 0) return found.irradiance;
    const int rays = std::max(settings_.rays / kFreshShare, 1);
    return EstimateIrradiance({point.surface, n, rays}, incident_,
                              context.Stream(HashKey({kFreshStream, number})), context)
        .irradiance;
  }

  // Returns an unbiased estimate of the indirect light that the glossy lobes scatter towards wo.
  Spectrum Glossy(const ShadingPoint& point, std::uint64_t number, LiContext& context) const {
    if (!point.bsdf.Has(LobeSet::Glossy)) return {};
    RandomStream random = context.Stream(HashKey({kGlossyStream, number}));
    const Point2 u{random.Uniform(), random.Uniform()};
    const auto sample = point.bsdf.Sample(point.Wo(), u, random.Uniform(), LobeSet::Glossy);
    if (!sample || sample->throughput.IsBlack()) return {};
    const Ray ray = SpawnRay(point.surface, sample->wi);
    return sample->throughput * incident_.Along(ray, &random, context).radiance;
  }

  IrradianceSettings settings_;
  DirectLighting direct_;
  IndirectRadiance incident_;
  IrradianceCache cache_;
};

std::unique_ptr<SurfaceIntegrator> Create(const IrradianceSettings& settings,
                                          const IntegratorContext&) {
  return std::make_unique<IrradianceCacheIntegrator>(settings);
}

}  // namespace
}  // namespace exphoton

EXPHOTON_INTEGRATOR("irradiancecache", "indirect diffuse light interpolated between cached records")
