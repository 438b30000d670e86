// SPDX-License-Identifier: BSD-2-Clause
// RenderDirectives stores the directives before WorldBegin that say how to render, and makes the
// objects from them at WorldEnd.
#pragma once

#include <string>

#include "core/parser/builder/error_collector.h"
#include "core/parser/builder/moving_transform.h"
#include "core/parser/builder/world_builder.h"
#include "core/parser/render_setup.h"
#include "core/parser/syntax/directive.h"
#include "core/plugins/registry.h"

namespace exphoton {

class RenderDirectives {
 public:
  RenderDirectives(const LoadOptions& options, Dialect dialect);

  // Stores Camera, Film, Sampler and so on. The last directive of each kind wins.
  void Handle(Directive directive, const MovingTransform& current);
  // Sets the times of the start and end transformations, for the whole scene.
  void SetTransformTimes(Interval times) { transformTimes_ = times; }
  Interval TransformTimes() const { return transformTimes_; }

  // Sets the location that errors report for directives that the file leaves out.
  void SetDefaultLocation(const SourceLocation& where);

  AcceleratorSpec Accelerator(PluginRegistry& registry) const;

  // Makes everything except the scene. Errors go to `errors`; the objects that they concern are
  // not made.
  void Create(PluginRegistry& registry, Log& log, bool hasMedia, RenderSetup* setup,
              ErrorCollector* errors);

 private:
  struct Choice {
    std::string name;
    ParamSet params;
    bool isGiven = false;
    bool isReplaced = false;  // by a plugin that the command line names
  };

  void OverrideIntegrator();
  // Removes parameters of the file's integrator that mean something else in the chosen one.
  void KeepSharedParameters(PluginRegistry& registry, Log& log);
  // Replaces the plugin of the file by the one that the command line names, if it is another one.
  void OverridePlugin(Choice* choice, const std::optional<std::string>& name, const char* option);
  void OverridePlugins();
  ParamSet KnownParameters(const Choice& choice, const std::vector<ParamDecl>& declared) const;
  // Chooses the integrator that takes the place of a renderer of version 2 that is not available.
  void ReplaceRenderer(Log& log);
  // Returns whether only other integrators that are compared declare a parameter of --set.
  bool IsOfAnotherIntegrator(const ParameterOverride& set, PluginRegistry& registry) const;
  ParamSet Overridden(const char* directive, const Choice& choice, PluginKind kind,
                      PluginRegistry& registry) const;
  BindContext Bind(PluginKind kind, const std::string& name, Log& log) const;
  void CheckRenderer(Log& log) const;  // its parameters; the renderer itself has no effect
  void CreateFilm(Log& log, RenderSetup* setup) const;
  void CreateCamera(PluginRegistry& registry, Log& log, RenderSetup* setup) const;
  void CreateFilter(PluginRegistry& registry, Log& log, RenderSetup* setup) const;
  std::int64_t SceneSamples(PluginRegistry& registry) const;
  void CreateSampler(PluginRegistry& registry, Log& log, RenderSetup* setup) const;
  void CreateIntegrator(PluginRegistry& registry, Log& log, RenderSetup* setup) const;
  void CreateVolumeIntegrator(PluginRegistry& registry, Log& log, bool hasMedia,
                              RenderSetup* setup) const;

  const LoadOptions& options_;
  Dialect dialect_;
  Choice filter_{"mitchell", {}}, film_{"image", {}}, sampler_{"lowdiscrepancy", {}},
      accelerator_{"bvh", {}}, integrator_{"directlighting", {}}, volumeIntegrator_{"emission", {}},
      camera_{"perspective", {}}, renderer_{"sampler", {}};
  std::string fileIntegrator_;  // the integrator that the file names; "" without --integrator
  MovingTransform worldToCamera_;
  Choice sceneSampler_;  // the file's sampler, if the command line names another one
  Interval transformTimes_{0, 1};
};

}  // namespace exphoton
