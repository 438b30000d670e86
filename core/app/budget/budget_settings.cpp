// SPDX-License-Identifier: BSD-2-Clause
#include "core/app/budget/budget_settings.h"

#include <cstdint>
#include <string>

namespace exphoton::cli {
namespace {

constexpr int kDefaultRays = 32;
constexpr int kDeep = 100;  // specular bounces in a row

LoadOptions With(LoadOptions options, const std::string& name, const std::string& value) {
  options.parameters.push_back({"SurfaceIntegrator", name, value});
  return options;
}

}  // namespace

double IntegratorNumber(const RenderSetup& setup, const std::string& name, double byDefault) {
  const ParsedParam* const given = setup.integratorParameters.Find(name);
  return given && !given->numbers.empty() ? given->numbers.front() : byDefault;
}

LoadOptions WithMoreRays(LoadOptions options, const RenderSetup& setup) {
  const double rays = IntegratorNumber(setup, "finalgathersamples", kDefaultRays);
  return With(std::move(options), "finalgathersamples",
              std::to_string(std::int64_t(rays) * kRayFactor));
}

LoadOptions WithoutSharing(LoadOptions options) {
  return With(std::move(options), "sharedgather", "false");
}

LoadOptions WithCausticPhotons(LoadOptions options, double photons) {
  return With(std::move(options), "causticphotons", std::to_string(std::int64_t(photons)));
}

LoadOptions WithDeepPaths(LoadOptions options, const RenderSetup& setup) {
  const bool hasOtherName = setup.integratorParameters.Find("maxspeculardepth") != nullptr;
  return With(std::move(options), hasOtherName ? "maxspeculardepth" : "maxdepth",
              std::to_string(kDeep));
}

LoadOptions WithAllEffects(LoadOptions options) {
  options.effects = "all";
  return options;
}

LoadOptions OfReference(LoadOptions options) {
  std::erase_if(options.parameters, [](const ParameterOverride& parameter) {
    return parameter.directive == "SurfaceIntegrator";
  });
  options.integrator = "guidedpath";
  options.effects = "auto";
  options.isStrict = false;
  return options;
}

}  // namespace exphoton::cli
