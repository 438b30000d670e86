// SPDX-License-Identifier: BSD-2-Clause
// The integrator "debug" shows properties of the first surface as colours: parametric coordinates,
// normals and others. No light and no material plays a part, except that bump maps change the
// shading normal. Components of normals are mapped from [-1,1] to [0,1], because a picture has no
// negative values.
#include "core/plugin.h"
#include "core/transport/shading_point.h"

namespace exphoton {
namespace {

enum class Property {
  Zero,
  One,
  U,
  V,
  NormalX,
  NormalY,
  NormalZ,
  GeometricX,
  GeometricY,
  GeometricZ,
  X,
  Y,
  Z,
  Distance,
  Facing,
};

struct Settings {
  Property red = Property::U, green = Property::V, blue = Property::Zero;
};

Param<Settings, Property> Channel(const char* name, Property Settings::*member, const char* doc) {
  return Param(name, member, doc)
      .OneOf({{"zero", Property::Zero},
              {"one", Property::One},
              {"u", Property::U},
              {"v", Property::V},
              {"nx", Property::NormalX},
              {"ny", Property::NormalY},
              {"nz", Property::NormalZ},
              {"ngx", Property::GeometricX},
              {"ngy", Property::GeometricY},
              {"ngz", Property::GeometricZ},
              {"x", Property::X},
              {"y", Property::Y},
              {"z", Property::Z},
              {"distance", Property::Distance},
              {"facing", Property::Facing}});
}

const ParamTable<Settings>& Parameters() {
  static const ParamTable<Settings> table{
      Channel("red", &Settings::red,
              "property in the red channel: parametric coordinates, shading normal and geometric "
              "normal ((n + 1) / 2), position and distance in scene units, cosine to the viewer"),
      Channel("green", &Settings::green, "property in the green channel"),
      Channel("blue", &Settings::blue, "property in the blue channel")};
  return table;
}

Real Mapped(Real component) { return (component + 1) / 2; }

Real Value(Property property, const ShadingPoint& point, const Point3& eye) {
  const SurfaceInteraction& surface = point.surface;
  const Normal3& ns = surface.shading.n;
  switch (property) {
    case Property::Zero:
      return 0;
    case Property::One:
      return 1;
    case Property::U:
      return surface.uv.x;
    case Property::V:
      return surface.uv.y;
    case Property::NormalX:
      return Mapped(ns.x);
    case Property::NormalY:
      return Mapped(ns.y);
    case Property::NormalZ:
      return Mapped(ns.z);
    case Property::GeometricX:
      return Mapped(surface.ng.x);
    case Property::GeometricY:
      return Mapped(surface.ng.y);
    case Property::GeometricZ:
      return Mapped(surface.ng.z);
    case Property::X:
      return surface.p.x;
    case Property::Y:
      return surface.p.y;
    case Property::Z:
      return surface.p.z;
    case Property::Distance:
      return Distance(eye, surface.p);
    case Property::Facing:
      return AbsDot(ns, surface.wo);
  }
  return 0;
}

class DebugIntegrator final : public SurfaceIntegrator {
 public:
  explicit DebugIntegrator(const Settings& settings) : settings_(settings) {}

  std::vector<std::string> Explain(const Scene&) const override {
    return {"light         none: properties of the first surface as colours"};
  }

  FeatureSet ComputedFeatures() const override {
    return {Feature::Filtering, Feature::Lens, Feature::Motion};
  }

  Spectrum Li(const RayDifferential& ray, LiContext& context) const override {
    const auto hit = context.Intersect(ray, RayKind::Camera);
    if (!hit) {
      context.alpha = 0;
      return {};
    }
    const ShadingPoint point =
        MakeShadingPoint(*hit, ray, 0, TransportMode::Radiance, &context.arena);
    return {Value(settings_.red, point, ray.o), Value(settings_.green, point, ray.o),
            Value(settings_.blue, point, ray.o)};
  }

 private:
  Settings settings_;
};

std::unique_ptr<SurfaceIntegrator> Create(const Settings& settings, const IntegratorContext&) {
  return std::make_unique<DebugIntegrator>(settings);
}

}  // namespace
}  // namespace exphoton

EXPHOTON_INTEGRATOR("debug", "properties of the first surface as colours, for inspection")
