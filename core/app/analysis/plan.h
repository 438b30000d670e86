// SPDX-License-Identifier: BSD-2-Clause
// StudyPlan: what a study renders: settings (an integrator with parameters), each with several
// seeds. Pure data: reading options is the command line's affair, rendering a child process's.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace exphoton::study {

// ("spp", "16"), ("time", "4" in seconds), ("maxdepth", "100" of the surface integrator), or with
// a directive's name: ("Sampler.pixelsamples", "4").
using Parameter = std::pair<std::string, std::string>;

// One way to render the scene.
struct Setting {
  std::string label;  // the line of the charts that it belongs to; by default the integrator's name
  std::string integrator;
  std::vector<Parameter> parameters;

  std::string Text() const;  // "indirectphotons=40000 spp=4"
  const std::string* Find(const std::string& parameter) const;
  friend bool operator==(const Setting&, const Setting&) = default;
};

// A parameter with the values to try.
struct Knob {
  std::string integrator;  // or label; "": all that have the parameter
  std::string parameter;
  std::vector<std::string> values;
};

struct StudyPlan {
  std::vector<Setting> bases;  // integrators, and settings given word by word
  std::vector<Knob> knobs;
  std::vector<double> budgets;  // seconds; empty: no runs that are stopped by time
};

// "[LABEL:] INTEGRATOR [name=value ...]". Throws std::invalid_argument that says what is wrong.
Setting ParseSetting(const std::string& text);
// "[INTEGRATOR:]name=value,value,...". The same.
Knob ParseKnob(const std::string& text);
// "1,4,16,64s": seconds; "30m", "2h" too. The same.
std::vector<double> ParseBudgets(const std::string& text);
double ParseSeconds(const std::string& text);
std::vector<std::string> SplitList(const std::string& text);  // at commas; empty parts left out

// Which integrators have which parameter.
class ParameterOracle {
 public:
  virtual ~ParameterOracle() = default;
  virtual bool Has(const std::string& integrator, const std::string& parameter) const = 0;
};

// Every base with every combination of the knobs that apply to it and every budget. A knob for one
// integrator takes the place of the one for all; a parameter that the base gives stays as it is.
// Throws std::invalid_argument where a knob applies to nothing.
std::vector<Setting> ExpandPlan(const StudyPlan& plan, const ParameterOracle& oracle);

// Seeds of the runs of a setting are 1, 2, ...; the two halves of a reference have others in every
// round, so that they are independent of each other and of the runs. half: 0 or 1.
constexpr std::uint64_t ReferenceSeed(int round, int half) {
  return 1000001 + 2 * std::uint64_t(round) + std::uint64_t(half);
}

}  // namespace exphoton::study
