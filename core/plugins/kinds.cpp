// SPDX-License-Identifier: BSD-2-Clause
// Names and folders of the plugin kinds.
#include "core/plugins/kinds.h"

namespace exphoton {

const char* PluginKindName(PluginKind kind) {
  switch (kind) {
    case PluginKind::Integrator:
      return "integrator";
    case PluginKind::Accelerator:
      return "accelerator";
    case PluginKind::Shape:
      return "shape";
    case PluginKind::Light:
      return "light";
    case PluginKind::AreaLight:
      return "area light";
    case PluginKind::Material:
      return "material";
    case PluginKind::FloatTexture:
      return "float texture";
    case PluginKind::ColorTexture:
      return "color texture";
    case PluginKind::Sampler:
      return "sampler";
    case PluginKind::Filter:
      return "filter";
    case PluginKind::Camera:
      return "camera";
    case PluginKind::Volume:
      return "volume";
    case PluginKind::VolumeIntegrator:
      return "volume integrator";
  }
  return "";
}

const char* PluginKindFolder(PluginKind kind) {
  switch (kind) {
    case PluginKind::Integrator:
      return "integrators";
    case PluginKind::Accelerator:
      return "accelerators";
    case PluginKind::Shape:
      return "shapes";
    case PluginKind::Light:
    case PluginKind::AreaLight:
      return "lights";
    case PluginKind::Material:
      return "materials";
    case PluginKind::FloatTexture:
    case PluginKind::ColorTexture:
      return "textures";
    case PluginKind::Sampler:
      return "samplers";
    case PluginKind::Filter:
      return "filters";
    case PluginKind::Camera:
      return "cameras";
    case PluginKind::Volume:
      return "volumes";
    case PluginKind::VolumeIntegrator:
      return "volumeintegrators";
  }
  return "";
}

}  // namespace exphoton
