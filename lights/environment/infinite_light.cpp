// SPDX-License-Identifier: BSD-2-Clause
// InfiniteLight emits radiance from all directions, uniform or from an environment map. Directions
// are sampled in proportion to the cells of the map. Photons start on a disk that covers the scene.
#include "lights/environment/infinite_light.h"

#include "core/math/sampling/sampling.h"
#include "lights/environment/environment_map.h"
#include "lights/environment/light_directions.h"
#include "lights/environment/map_texels.h"

namespace exphoton {
namespace {

class InfiniteLight final : public Light {
 public:
  // If map is null, the radiance is uniform.
  InfiniteLight(const Transform& lightToWorld, const Spectrum& radiance,
                std::unique_ptr<EnvironmentMap> map, int sampleCount)
      : directions_(lightToWorld),
        radiance_(radiance),
        map_(std::move(map)),
        sampleCount_(sampleCount) {}

  void Prepare(const Sphere3& world) override { world_ = world; }
  bool IsInfinite() const override { return true; }
  bool IsDistant() const override { return true; }
  bool IsProvablyBlack() const override {
    return radiance_.IsBlack() || (map_ && (radiance_ * map_->Largest()).IsBlack());
  }
  int SampleCount() const override { return sampleCount_; }
  Spectrum Power() const override {
    const Spectrum integral = map_ ? map_->CellIntegral() : Spectrum(4 * kPi);
    return radiance_ * integral * DiskArea();
  }

  Spectrum Le(const Vector3& w) const override {
    return map_ ? radiance_ * map_->Evaluate(directions_.ToLight(w)) : radiance_;
  }

  std::optional<LightLiSample> SampleDirect(const SurfacePoint& ref, Point2 u,
                                            Real) const override {
    const auto wi = SampleDirection(u);
    if (!wi) return std::nullopt;
    return LightLiSample{*wi, Le(*wi), DirectionPdf(*wi), SpawnRay(ref, *wi)};
  }
  Real PdfDirect(const SurfacePoint&, const Vector3& wi, const SurfacePoint* on) const override {
    return on ? 0 : DirectionPdf(wi);
  }

  // The density is DirectionPdf per solid angle times 1 / (pi r^2) per area of the disk.
  std::optional<LightLeSample> SampleEmission(Point2 uPosition, Point2 uDirection, Real,
                                              Real time) const override {
    const auto w = SampleDirection(uDirection);
    if (!w || !(world_.radius > 0)) return std::nullopt;
    const Point2 d = SampleDisk(uPosition);
    const Frame frame = Frame::FromZ(*w);
    // Start slightly outside the sphere, so that rounding never starts a photon inside a wall that
    // touches the sphere.
    const Vector3 offset = frame.x * d.x + frame.y * d.y + *w * Real(1.001);
    const Ray ray{world_.center + offset * world_.radius, -*w, kInfinity, time};
    const Real pdf = DirectionPdf(*w);
    return LightLeSample{ray, Le(*w) * (DiskArea() / pdf), 1 / DiskArea(), pdf};
  }
  std::optional<Real> EmissionBound() const override {
    if (!map_) return Power().Y();
    if (!directions_.KeepsSolidAngles()) return std::nullopt;
    return (radiance_ * map_->LargestWeight()).Y() * DiskArea();
  }
  EmissionPdf PdfEmission(const SurfacePoint&, const Vector3& w) const override {
    return {world_.radius > 0 ? 1 / DiskArea() : 0, DirectionPdf(-w)};
  }

 private:
  Real DiskArea() const { return kPi * world_.radius * world_.radius; }

  // Samples a world direction towards the light; nullopt if its density rounds to 0.
  std::optional<Vector3> SampleDirection(Point2 u) const {
    const Vector3 w = map_ ? directions_.ToWorld(map_->Sample(u)) : SampleUniformSphere(u);
    if (!(DirectionPdf(w) > 0)) return std::nullopt;
    return w;
  }
  // Returns the density per solid angle in world space.
  Real DirectionPdf(const Vector3& w) const {
    if (!map_) return kUniformSpherePdf;
    const Vector3 local = directions_.ToLight(w);
    return map_->Pdf(local) * directions_.DensityFactor(local);
  }

  LightDirections directions_;
  Spectrum radiance_;
  std::unique_ptr<EnvironmentMap> map_;
  int sampleCount_;
  Sphere3 world_;
};

}  // namespace

const ParamTable<InfiniteLightSettings>& InfiniteLightParameters() {
  using Settings = InfiniteLightSettings;
  static const ParamTable<Settings> table{
      Param("L", &Settings::radiance, "radiance, or factor on the map")
          .AtLeast(0)
          .Unit("W/(m^2 sr)"),
      Param("scale", &Settings::scale, "factor on L").AtLeast(0),
      Param("mapname", &Settings::mapName,
            "latitude-longitude map (an image file, as for imagemap); top row is +z of the light")
          .As(ParamType::File),
      Param("nsamples", &Settings::sampleCount, "shadow rays at a shading point")
          .Range(1, 1 << 20)};
  return table;
}

std::unique_ptr<Light> MakeInfiniteLight(const InfiniteLightSettings& settings,
                                         const LightContext& context) {
  Spectrum radiance = settings.radiance * settings.scale;
  std::unique_ptr<EnvironmentMap> map;
  if (!settings.mapName.empty()) {
    MapTexels texels = ReadMapTexels(settings.mapName, context);
    if (texels.IsUniform()) {
      const Spectrum colour = texels.texels.front();
      radiance *= colour;  // a map of one colour is a uniform light
      if (colour.IsBlack())
        context.log.Warning("\"" + settings.mapName + "\" is black: the light is off",
                            context.where);
    } else {
      map = std::make_unique<EnvironmentMap>(std::move(texels.texels), texels.width, texels.height);
    }
    if (!context.lightToWorld.SimilarityScale())
      context.log.Warning("the light's transformation is not a similarity; the map is stretched",
                          context.where);
  }
  return std::make_unique<InfiniteLight>(context.lightToWorld, radiance, std::move(map),
                                         settings.sampleCount);
}

}  // namespace exphoton
