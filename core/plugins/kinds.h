// SPDX-License-Identifier: BSD-2-Clause
// PluginKind lists the kinds of plugin. PluginTraits defines the product of each kind and the
// context that its factory receives besides the parameters.
#pragma once

#include <memory>
#include <string>

#include "core/base/error.h"
#include "core/geometry/shape.h"
#include "core/geometry/triangle_mesh.h"
#include "core/imaging/film/camera.h"
#include "core/lights/light.h"
#include "core/math/transform.h"
#include "core/plugins/shared_cache.h"
#include "core/sampling/filter.h"
#include "core/sampling/sampler.h"
#include "core/scattering/material.h"
#include "core/scattering/medium.h"
#include "core/scattering/texture.h"
#include "core/scene/aggregate.h"
#include "core/transport/integrator.h"
#include "core/transport/volume_integrator.h"

namespace exphoton {

class Log;

enum class PluginKind {
  Integrator,
  Accelerator,
  Shape,
  Light,
  AreaLight,
  Material,
  FloatTexture,
  ColorTexture,
  Sampler,
  Filter,
  Camera,
  Volume,
  VolumeIntegrator,
};
inline constexpr int kPluginKindCount = 13;
const char* PluginKindName(PluginKind kind);  // for messages, such as "area light"
// Returns the name of the folder that holds the sources and, under plugins/, the built plugins of a
// kind, for example "lights".
const char* PluginKindFolder(PluginKind kind);

struct NoContext {};

struct SamplerContext {
  Log& log;
  SourceLocation where;
};

struct IntegratorContext {
  Log& log;
};
struct AcceleratorContext {
  const PrimitiveSet& primitives;  // outlives the accelerator
  Log& log;
  int threads = 1;  // that may build it; 0: one per core
};
struct ShapeContext {
  Transform objectToWorld;
  bool reverseOrientation = false;
  Log& log;
  SourceLocation where;  // location of the Shape directive, for warnings

  // Returns whether Cross(dpdu, dpdv) must be negated to point outside.
  bool FlipsNormal() const { return reverseOrientation != objectToWorld.SwapsHandedness(); }
};
struct LightContext {
  Transform lightToWorld;
  Log& log;
  SourceLocation where;
};
struct AreaLightContext {
  std::shared_ptr<const EmitterSurface> surface;
  Log& log;
  SourceLocation where;
};
struct MaterialContext {
  Log& log;
  SourceLocation where;
  const MaterialLookup* named = nullptr;  // null: the material can refer to no others
  SharedCache* shared = nullptr;          // shared by all materials of the scene; null: none
};
struct MediumContext {
  Transform mediumToWorld;
  Log& log;
  SourceLocation where;
};
struct TextureContext {
  Transform textureToWorld;
  Log& log;
  SourceLocation where;
  SharedCache& shared;  // shared by all textures of the scene
};

template <PluginKind>
struct PluginTraits;
template <class P, class C>
struct PluginTraitsOf {
  using Product = P;
  using Context = C;
};
template <>
struct PluginTraits<PluginKind::Integrator> : PluginTraitsOf<SurfaceIntegrator, IntegratorContext> {
};
template <>
struct PluginTraits<PluginKind::Accelerator> : PluginTraitsOf<Aggregate, AcceleratorContext> {};
template <>
struct PluginTraits<PluginKind::Shape> : PluginTraitsOf<ShapeGeometry, ShapeContext> {};
template <>
struct PluginTraits<PluginKind::Light> : PluginTraitsOf<Light, LightContext> {};
template <>
struct PluginTraits<PluginKind::AreaLight> : PluginTraitsOf<AreaLight, AreaLightContext> {};
template <>
struct PluginTraits<PluginKind::Material> : PluginTraitsOf<Material, MaterialContext> {};
template <>
struct PluginTraits<PluginKind::FloatTexture> : PluginTraitsOf<FloatTexture, TextureContext> {};
template <>
struct PluginTraits<PluginKind::ColorTexture> : PluginTraitsOf<ColorTexture, TextureContext> {};
template <>
struct PluginTraits<PluginKind::Sampler> : PluginTraitsOf<Sampler, SamplerContext> {};
template <>
struct PluginTraits<PluginKind::Filter> : PluginTraitsOf<Filter, NoContext> {};
template <>
struct PluginTraits<PluginKind::Camera> : PluginTraitsOf<Camera, CameraContext> {};
template <>
struct PluginTraits<PluginKind::Volume> : PluginTraitsOf<Medium, MediumContext> {};
template <>
struct PluginTraits<PluginKind::VolumeIntegrator> : PluginTraitsOf<VolumeIntegrator, NoContext> {};

}  // namespace exphoton
