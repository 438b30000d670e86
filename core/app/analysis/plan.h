// SPDX-License-Identifier: BSD-2-Clause
// StudyPlan lists the settings that a study renders: integrators with parameters. It is pure data.
// Other files parse the options and start the renders.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace exphoton::study {

// A Parameter is a name and a value: ("spp", "16"), ("time", "4") in seconds, ("maxdepth", "100")
// of the surface integrator, or, with a directive's name, ("Sampler.pixelsamples", "4").
using Parameter = std::pair<std::string, std::string>;

// Setting is one way to render the scene.
struct Setting {
  std::string label;  // line of the charts; default: the integrator's name
  std::string integrator;
  std::vector<Parameter> parameters;

  std::string Text() const;  // "indirectphotons=40000 spp=4"
  const std::string* Find(const std::string& parameter) const;
  friend bool operator==(const Setting&, const Setting&) = default;
};

// VariedParameter holds a parameter and the values to try.
struct VariedParameter {
  std::string integrator;  // integrator or label; "": all integrators with the parameter
  std::string parameter;
  std::vector<std::string> values;
};

struct StudyPlan {
  std::vector<Setting> bases;  // integrators, and settings given explicitly
  std::vector<VariedParameter> varied;
  std::vector<double> budgets;  // seconds; empty: no time-limited runs
};

// Parses "[LABEL:] INTEGRATOR [name=value ...]". Throws std::invalid_argument with an explanation.
Setting ParseSetting(const std::string& text);
// Parses "[INTEGRATOR:]name=value,value,...". Throws std::invalid_argument.
VariedParameter ParseVariedParameter(const std::string& text);
// Parses "1,4,16,64s", also with units m and h, to seconds. Throws std::invalid_argument.
std::vector<double> ParseBudgets(const std::string& text);
std::vector<std::string> SplitList(const std::string& text);  // at commas; drops empty parts

// ParameterLookup says which integrators have which parameters.
class ParameterLookup {
 public:
  virtual ~ParameterLookup() = default;
  virtual bool Has(const std::string& integrator, const std::string& parameter) const = 0;
  // Returns the integrator's parameters, for "did you mean".
  virtual std::vector<std::string> Names(const std::string& /*integrator*/) const { return {}; }
};

// Returns every base in every combination of its varied parameters and of the budgets. A varied
// parameter for one integrator overrides a general one. A parameter given by the base is not
// varied. Throws std::invalid_argument if a varied parameter applies to no base.
std::vector<Setting> ExpandPlan(const StudyPlan& plan, const ParameterLookup& oracle);

// Returns the name of a run's files, without an ending: "path_maxdepth=100_spp=16_seed=1". Settings
// with different integrators or parameters have different names, also where a value has characters
// that are replaced because file names should not contain them.
std::string RunName(const Setting& setting, std::uint64_t seed);

// Returns the seed of a reference half (0 or 1) in a round. Runs of a setting have the seeds 1, 2
// and so on, so the halves are independent of each other and of the runs.
constexpr std::uint64_t ReferenceSeed(int round, int half) {
  return 1000001 + 2 * std::uint64_t(round) + std::uint64_t(half);
}

}  // namespace exphoton::study
