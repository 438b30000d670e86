// SPDX-License-Identifier: BSD-2-Clause
// The directives of the scene language as data: what follows each name, and where it may stand.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/params/param_set.h"

namespace exphoton {

enum class DirectiveId {
  Accelerator,
  ActiveTransform,
  AreaLightSource,
  AttributeBegin,
  AttributeEnd,
  Camera,
  ConcatTransform,
  CoordSysTransform,
  CoordinateSystem,
  Film,
  Identity,
  Include,
  LightSource,
  LookAt,
  MakeNamedMaterial,
  Material,
  NamedMaterial,
  ObjectBegin,
  ObjectEnd,
  ObjectInstance,
  PixelFilter,
  Renderer,
  ReverseOrientation,
  Rotate,
  Sampler,
  Scale,
  SearchPath,
  Shape,
  SurfaceIntegrator,
  Texture,
  Transform,
  TransformBegin,
  TransformEnd,
  TransformTimes,
  Translate,
  Volume,
  VolumeIntegrator,
  WorldBegin,
  WorldEnd,
};

enum class DirectiveScope { Anywhere, Options, World };  // Options: before WorldBegin

struct DirectiveSpec {
  std::string_view name;
  DirectiveId id;
  DirectiveScope scope = DirectiveScope::Anywhere;
  int numbers = 0;  // that follow; brackets round them are allowed
  int strings = 0;  // quoted, before any parameters
  bool hasParameters = false;
  bool hasWord = false;  // a bare word: ActiveTransform All
};

// One directive as a file says it.
struct Directive {
  const DirectiveSpec* spec = nullptr;
  std::vector<double> numbers;
  std::vector<std::string> strings;  // the bare word too
  ParamSet params;                   // params.where: of the directive

  const SourceLocation& Where() const { return params.where; }
};

// nullptr where there is none of that name.
const DirectiveSpec* FindDirective(std::string_view name);
std::vector<std::string> DirectiveNames();
// "pbrt-v4" for a directive of a later version, "" for any other word.
std::string_view LaterVersionOf(std::string_view name);

}  // namespace exphoton
