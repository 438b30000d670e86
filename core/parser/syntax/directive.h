// SPDX-License-Identifier: BSD-2-Clause
// DirectiveSpec describes the syntax of each directive: its arguments and the scope that allows it.
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
  Attribute,
  AttributeBegin,
  AttributeEnd,
  Camera,
  ColorSpace,
  ConcatTransform,
  CoordSysTransform,
  CoordinateSystem,
  Film,
  Identity,
  Import,
  Include,
  Integrator,
  LightSource,
  LookAt,
  MakeNamedMaterial,
  MakeNamedMedium,
  Material,
  MediumInterface,
  NamedMaterial,
  ObjectBegin,
  ObjectEnd,
  ObjectInstance,
  Option,
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

// Early is the grammar of versions 1 and 2, and Later is the grammar of versions 3 and 4.
enum class SceneGrammar { Early, Later };

enum class DirectiveScope { Anywhere, Options, World };  // Options: before WorldBegin

struct DirectiveSpec {
  std::string_view name;
  DirectiveId id;
  DirectiveScope scope = DirectiveScope::Anywhere;
  int numbers = 0;  // count of numbers; brackets around them are optional
  int strings = 0;  // count of quoted strings before any parameters
  bool hasParameters = false;
  bool hasWord = false;  // an unquoted word, as in ActiveTransform All
};

// Directive is one parsed directive of a file.
struct Directive {
  const DirectiveSpec* spec = nullptr;
  std::vector<double> numbers;
  std::vector<std::string> strings;  // includes the unquoted word
  ParamSet params;                   // params.where is the location of the directive

  const SourceLocation& Where() const { return params.where; }
};

// Returns nullptr if the grammar has no directive of that name.
const DirectiveSpec* FindDirective(std::string_view name,
                                   SceneGrammar grammar = SceneGrammar::Early);
std::vector<std::string> DirectiveNames(SceneGrammar grammar = SceneGrammar::Early);
// Returns "4" or "3 or 4" for a directive of these later versions alone, "" for any other word.
std::string_view LaterVersionOf(std::string_view name);
// Returns the error about a scene of a later version that `sign` (such as: Film "rgb") shows.
Error LaterVersionError(std::string_view version, const std::string& sign,
                        const SourceLocation& where);

}  // namespace exphoton
