// SPDX-License-Identifier: BSD-2-Clause
// ParameterScenes makes scenes from the declarations of all plugins of a kind: one without
// parameters, and one for each value of each parameter. The values are those of
// parameter_values.txt, or else are made from the declaration (type, default, range, choices).
// Combined scenes have several of these values at once.
#include <algorithm>
#include <cmath>
#include <map>

#include "core/params/param_reader.h"
#include "core/params/param_text.h"
#include "tests/recorded/draw.h"
#include "tests/recorded/scene_list.h"
#include "tests/support/test_plugin.h"

namespace exphoton::recorded {
namespace {

// The lines of parameter_values.txt by "base PLUGIN.PARAMETER".
using Table = std::multimap<std::string, std::string>;
Table ReadTable() {
  Table table;
  for (const std::string& line : LinesOf("parameter_values.txt")) {
    const std::size_t end = line.find(' ', line.find(' ') + 1);
    table.emplace(line.substr(0, end), line.substr(end + 1));
  }
  return table;
}

bool IsInRange(const ParamDecl& decl, double v) {
  return (!decl.min || v > *decl.min || (v == *decl.min && !decl.minExcluded)) &&
         (!decl.max || v < *decl.max || (v == *decl.max && !decl.maxExcluded));
}

// Returns two legal numbers that differ from the number at hand. NaN: there is none.
std::vector<double> OtherNumbers(const ParamDecl& decl, double number) {
  std::vector<double> candidates{number * 1.4, number * .6, number + .3, number - .3, .4, 1.5};
  if (decl.type == ParamType::Integer)
    candidates = {number + 1, std::floor(number / 2), number * 2, 3, 40, 2, 1};
  std::vector<double> numbers;
  for (const double v : candidates)
    if (numbers.size() < 2 && std::isfinite(v) && v != number && IsInRange(decl, v) &&
        std::find(numbers.begin(), numbers.end(), v) == numbers.end())
      numbers.push_back(v);
  return numbers;
}

// Returns the number at the end of a parameter's text, or NaN.
double NumberIn(const std::string& text) {
  const std::size_t begin = text.rfind(' ') + 1;
  char* end = nullptr;
  const double number = std::strtod(text.c_str() + begin, &end);
  return end == text.c_str() + text.size() && !text.empty() ? number : double(NAN);
}

std::string Written(const ParamDecl& decl, const std::string& type, const std::string& value) {
  return "\"" + type + " " + decl.name + "\" " + value;
}

// Returns values of a parameter as texts. `given` is what the plugin has without them.
std::vector<std::string> ValuesOf(const ParamDecl& decl, const std::string& given) {
  std::vector<std::string> texts;
  const std::string type(AcceptedTypes(decl.type)[0]);
  switch (decl.type) {
    case ParamType::Integer:
    case ParamType::Float:
      for (const double number : OtherNumbers(decl, NumberIn(given)))
        texts.push_back(Written(decl, type, NumberText(number)));
      break;
    case ParamType::Bool:
      texts.push_back(Written(decl, type, given == "\"true\"" ? "\"false\"" : "\"true\""));
      break;
    case ParamType::Choice:
      for (const std::string& choice : decl.choices)
        if ("\"" + choice + "\"" != given)
          texts.push_back(Written(decl, type, "\"" + choice + "\""));
      break;
    case ParamType::Color:
      texts.push_back(Written(decl, "color", "[.2 .5 .7]"));
      break;
    case ParamType::Point:
    case ParamType::Vector:
    case ParamType::Normal:
      texts.push_back(Written(decl, type, "[.3 .7 -.5]"));
      break;
    case ParamType::FloatTexture:
      texts.push_back(Written(decl, "float", ".3"));
      texts.push_back(Written(decl, "texture", "\"tf\""));
      break;
    case ParamType::ColorTexture:
      texts.push_back(Written(decl, "color", "[.2 .5 .7]"));
      texts.push_back(Written(decl, "texture", "\"tc\""));
      break;
    default:  // in the table
      break;
  }
  return texts;
}

bool IsOfMappings(const std::string& parameter) {
  const std::vector<std::string> names{"mapping", "uscale", "vscale", "udelta",
                                       "vdelta",  "v1",     "v2"};
  return std::find(names.begin(), names.end(), parameter) != names.end();
}

std::uint64_t SeedOf(const std::string& name) {
  std::uint64_t seed = 0;
  for (const char c : name) seed = seed * 131 + static_cast<unsigned char>(c);
  return seed;
}

// The scenes of one plugin.
class PluginScenes {
 public:
  PluginScenes(const Table& table, const std::string& kind, const std::string& plugin,
               const ParamTableBase& parameters)
      : table_(table), kind_(kind), plugin_(plugin), declarations_(parameters.Declarations()) {}

  // Calls add(name, plugin with parameters) for each.
  template <class Add>
  void ForEach(const Add& add) const {
    add(plugin_, "\"" + plugin_ + "\"" + Base("", {}));
    for (const ParamDecl& decl : declarations_) {
      std::vector<std::string> with = Entries("with", decl.name);
      std::string others;
      for (const std::string& text : with) others += " " + text;
      for (const std::string& name : Entries("without", decl.name))
        with.push_back(" " + name + "\"");
      for (const std::string& value : Values(decl))
        add(plugin_ + "." + decl.name + "=" + value.substr(value.find("\" ") + 2),
            "\"" + plugin_ + "\"" + Base(decl.name, with) + others + " " + value);
    }
  }

  // The same for plugins with about half of their parameters set at once. Parameters that need or
  // exclude others are left out.
  template <class Add>
  void ForEachCombination(int count, const Add& add) const {
    for (int i = 0; i < count; ++i) {
      Draw draw(SeedOf(kind_ + plugin_) + std::uint64_t(i));
      std::vector<std::string> chosen;
      for (const ParamDecl& decl : declarations_) {
        const std::vector<std::string> values = Values(decl);
        const bool isAlone =
            Entries("with", decl.name).empty() && Entries("without", decl.name).empty();
        if (draw.Below(2) == 0 && isAlone && !values.empty()) chosen.push_back(draw.From(values));
      }
      std::string words = "\"" + plugin_ + "\"" + Base("", chosen);
      for (const std::string& value : chosen) words += " " + value;
      if (chosen.size() > 1) add(plugin_ + " combined " + std::to_string(i + 1), words);
    }
  }

 private:
  // Returns what the table has for this plugin, or else for all plugins.
  std::vector<std::string> Entries(const std::string& word, const std::string& parameter) const {
    std::vector<std::string> texts;
    for (const std::string& name : {kind_ + "/" + plugin_, plugin_, std::string("*")}) {
      const auto [begin, end] = table_.equal_range(word + " " + name + "." + parameter);
      for (auto i = begin; i != end; ++i) texts.push_back(i->second);
      if (!texts.empty()) break;
    }
    return texts;
  }
  std::vector<std::string> Values(const ParamDecl& decl) const {
    const std::vector<std::string> chosen = Entries("value", decl.name);
    // Textures of both kinds share the code of mappings.
    if (kind_ == "float texture" && IsOfMappings(decl.name)) return {};
    if (!chosen.empty() || decl.isIgnored) return chosen;
    const std::vector<std::string> base = Entries("base", decl.name);
    return ValuesOf(decl, base.empty() ? decl.defaultText : base[0]);
  }
  // Returns the base parameters, except those that are set otherwise.
  std::string Base(const std::string& except, const std::vector<std::string>& with) const {
    std::string text;
    for (const ParamDecl& decl : declarations_) {
      const auto sets = [&](const std::string& t) {
        return t.find(" " + decl.name + "\"") != t.npos;
      };
      if (decl.name == except || std::any_of(with.begin(), with.end(), sets)) continue;
      for (const std::string& entry : Entries("base", decl.name)) text += " " + entry;
    }
    return text;
  }

  const Table& table_;
  std::string kind_, plugin_;
  const std::vector<ParamDecl>& declarations_;
};

struct BaseScene {
  std::string kind, variant, text;
};
std::vector<BaseScene> ReadBaseScenes() {
  std::vector<BaseScene> scenes;
  for (const std::string& line : LinesOf("base_scenes.txt")) {
    if (line.starts_with("== ")) {
      const std::size_t colon = std::min(line.find(": "), line.size());
      scenes.push_back({line.substr(3, colon - 3), "", ""});
      if (colon < line.size()) scenes.back().variant = ", " + line.substr(colon + 2);
    } else {
      scenes.at(scenes.size() - 1).text += line + "\n";
    }
  }
  return scenes;
}

void AddScenes(const BaseScene& base, const PluginScenes& plugin, int combinations,
               std::vector<RecordedScene>* all) {
  const auto add = [&](const std::string& name, const std::string& words) {
    RecordedScene scene{base.kind + " " + name + base.variant, base.text, {}};
    const std::size_t at = scene.text.find('@');
    scene.text.replace(at, 1, words);
    all->push_back(scene);
  };
  if (combinations > 0)
    plugin.ForEachCombination(combinations, add);
  else
    plugin.ForEach(add);
}

}  // namespace

std::vector<RecordedScene> ParameterScenes(const std::string& kinds, int combinations) {
  const Table table = ReadTable();
  TestPlugins plugins;
  std::vector<RecordedScene> scenes;
  for (const BaseScene& base : ReadBaseScenes()) {
    if ((", " + kinds + ",").find(", " + base.kind + ",") == std::string::npos) continue;
    for (int k = 0; k < kPluginKindCount; ++k) {
      const auto kind = static_cast<PluginKind>(k);
      if (PluginKindName(kind) != base.kind) continue;
      for (const std::string& name : plugins.Registry().Available(kind)) {
        if (name == "embree") continue;  // not in every build
        AddScenes(base,
                  {table, base.kind, name, *plugins.Registry().Find(kind, name, {}).parameters},
                  combinations, &scenes);
      }
    }
  }
  return scenes;
}

}  // namespace exphoton::recorded
