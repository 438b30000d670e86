// SPDX-License-Identifier: BSD-2-Clause
// This file converts Results to JSON (RFC 8259, with nlohmann's library).
#include "core/app/analysis/results.h"

#include <cmath>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace exphoton::study {
namespace {

// Keeps the members in insertion order.
using Json = nlohmann::ordered_json;
constexpr int kFormat = 1;

Json FromValues(const NamedValues& values) {
  Json json = Json::object();
  for (const auto& [name, value] : values) json[name] = value;
  return json;
}

NamedValues ToValues(const Json& json) {
  NamedValues values;
  for (const auto& [name, value] : json.items())
    if (value.is_number()) values.emplace_back(name, value.get<double>());
  return values;
}

// Read members that can be missing, or null because a number was not finite.
double Number(const Json& json, const char* name) {
  const auto found = json.find(name);
  return found != json.end() && found->is_number() ? found->get<double>() : 0;
}
std::string Text(const Json& json, const char* name) {
  const auto found = json.find(name);
  return found != json.end() && found->is_string() ? found->get<std::string>() : "";
}

Json FromSetting(const Setting& setting) {
  Json parameters = Json::array();
  for (const auto& [name, value] : setting.parameters) parameters.push_back({name, value});
  return {{"label", setting.label}, {"integrator", setting.integrator}, {"parameters", parameters}};
}

Setting ToSetting(const Json& json) {
  Setting setting{Text(json, "label"), Text(json, "integrator"), {}};
  for (const Json& pair : json.at("parameters"))
    setting.parameters.emplace_back(pair.at(0).get<std::string>(), pair.at(1).get<std::string>());
  return setting;
}

// Writes the values that do not depend on the study.
Json FromRun(const RunRow& row) {
  Json json = {{"key", row.key},
               {"seed", row.seed},
               {"threads", row.threads},
               {"samplesPerPixel", row.samplesPerPixel},
               {"complete", row.isComplete},
               {"wallSeconds", row.wallSeconds},
               {"cpuSeconds", row.cpuSeconds},
               {"peakMemoryBytes", row.peakMemory},
               {"phases", FromValues(row.phases)},
               {"phaseWallSeconds", FromValues(row.phaseWall)},
               {"rays", FromValues(row.rays)},
               {"counters", FromValues(row.counters)},
               {"image", row.image},
               {"command", row.command}};
  if (!row.certificate.empty()) json["certificate"] = FromValues(row.certificate);
  if (!row.warnings.empty()) json["warnings"] = row.warnings;
  if (row.IsOfTask())
    json.update({{"node", row.node}, {"processor", row.processor}, {"alone", row.isAlone}});
  return json;
}

Json FromRow(const RunRow& row, const Results& results) {
  const Setting& setting = results.settings.at(row.setting);
  Json json = {{"scene", results.title},
               {"setting", row.setting},
               {"label", setting.label},
               {"integrator", setting.integrator},
               {"parameters", setting.Text()}};
  json.update(FromRun(row));
  if (row.hasMetrics) json["metrics"] = FromValues(MetricValues(row));
  return json;
}

RunRow ToRow(const Json& json) {
  RunRow row;
  row.key = Text(json, "key");
  row.setting = json.value("setting", std::size_t(0));
  row.seed = json.at("seed").get<std::uint64_t>();
  row.threads = int(Number(json, "threads"));
  row.samplesPerPixel = Number(json, "samplesPerPixel");
  row.isComplete = json.value("complete", true);
  row.wallSeconds = Number(json, "wallSeconds");
  row.cpuSeconds = Number(json, "cpuSeconds");
  row.peakMemory = Number(json, "peakMemoryBytes");
  row.phases = ToValues(json.value("phases", Json::object()));
  row.phaseWall = ToValues(json.value("phaseWallSeconds", Json::object()));
  row.rays = ToValues(json.value("rays", Json::object()));
  row.counters = ToValues(json.value("counters", Json::object()));
  row.certificate = ToValues(json.value("certificate", Json::object()));
  row.image = Text(json, "image");
  row.command = Text(json, "command");
  row.warnings = json.value("warnings", std::vector<std::string>());
  row.node = Text(json, "node");
  row.processor = Text(json, "processor");
  row.isAlone = json.value("alone", false);
  return row;  // metrics are measured again from the pictures
}

Json FromReference(const ReferenceRecord& reference) {
  return {{"a", reference.a},
          {"b", reference.b},
          {"scene", reference.scene},
          {"sceneHash", reference.sceneHash},
          {"integrator", reference.integrator},
          {"samplesPerPixel", reference.samplesPerPixel},
          {"cpuSeconds", reference.seconds},
          {"command", reference.command}};
}

ReferenceRecord ToReference(const Json& json) {
  ReferenceRecord reference;
  reference.a = Text(json, "a");
  reference.b = Text(json, "b");
  reference.scene = Text(json, "scene");
  reference.sceneHash = Text(json, "sceneHash");
  reference.integrator = Text(json, "integrator");
  reference.samplesPerPixel = Number(json, "samplesPerPixel");
  reference.seconds = Number(json, "cpuSeconds");
  reference.command = Text(json, "command");
  return reference;
}

// JSON has no infinity. An interval without an upper end has no member "most".
Json FromPrediction(const Prediction& prediction) {
  Json points = Json::array();
  for (const Prediction::Point& point : prediction.points) {
    points.push_back(
        {{"relMSE", point.error}, {"cpuSeconds", point.seconds}, {"least", point.least}});
    if (std::isfinite(point.most)) points.back()["most"] = point.most;
  }
  return {{"integrator", prediction.integrator},
          {"failure", prediction.failure},
          {"points", std::move(points)}};
}

Prediction ToPrediction(const Json& json) {
  Prediction prediction{Text(json, "integrator"), Text(json, "failure"), {}};
  for (const Json& point : json.at("points"))
    prediction.points.push_back({Number(point, "relMSE"), Number(point, "cpuSeconds"),
                                 Number(point, "least"),
                                 point.value("most", std::numeric_limits<double>::infinity())});
  return prediction;
}

Json FromBudget(const BudgetRecord& budget) {
  Json rows = Json::array();
  for (const BudgetRecord::Row& row : budget.rows)
    rows.push_back({{"name", row.name},
                    {"relMSE", row.value},
                    {"halfWidth", row.halfWidth},
                    {"share", row.share},
                    {"halving", row.halving}});
  return {{"integrator", budget.integrator},
          {"headline", budget.headline},
          {"rows", std::move(rows)},
          {"notes", budget.notes}};
}

BudgetRecord ToBudget(const Json& json) {
  BudgetRecord budget{Text(json, "integrator"),
                      Text(json, "headline"),
                      {},
                      json.at("notes").get<std::vector<std::string>>()};
  for (const Json& row : json.at("rows"))
    budget.rows.push_back({Text(row, "name"), Text(row, "relMSE"), Text(row, "halfWidth"),
                           Text(row, "share"), Text(row, "halving")});
  return budget;
}

Results Parse(const std::string& text) {
  const Json json = Json::parse(text);
  if (json.at("format").get<int>() != kFormat)
    throw std::runtime_error("results.json was written by another version of the program");
  Results results;
  results.program = Text(json, "program");
  results.fingerprint = Text(json, "fingerprint");
  results.processor = Text(json, "processor");
  results.system = Text(json, "system");
  results.cores = int(Number(json, "cores"));
  results.title = Text(json, "title");
  results.scene = Text(json, "scene");
  results.sceneHash = Text(json, "sceneHash");
  results.command = Text(json, "command");
  results.clock = Text(json, "clock");
  results.photonFile = json.value("photonFile", "");
  results.seeds = int(Number(json, "seeds"));
  results.targets = json.at("targets").get<std::vector<double>>();
  results.crops = json.at("crops").get<std::vector<std::array<double, 4>>>();
  for (const Json& setting : json.at("settings")) results.settings.push_back(ToSetting(setting));
  results.reference = ToReference(json.at("reference"));
  for (const Json& prediction : json.value("predictions", Json::array()))
    results.predictions.push_back(ToPrediction(prediction));
  for (const Json& budget : json.value("budgets", Json::array()))
    results.budgets.push_back(ToBudget(budget));
  const auto check = [&](std::size_t setting) {
    if (setting >= results.settings.size())
      throw std::runtime_error("results.json: a run names a setting that is not there");
  };
  for (const Json& bound : json.value("lowerBounds", Json::array())) {
    const auto setting = bound.at("setting").get<std::size_t>();
    check(setting);
    results.lowerBounds.push_back({setting, Number(bound, "cpuSeconds"),
                                   Number(bound, "wallSeconds"), Text(bound, "command")});
  }
  for (const Json& map : json.at("maps"))
    results.maps.push_back(
        {Text(map, "image"), Text(map, "channel"), Text(map, "title"), Text(map, "unit")});
  for (const Json& row : json.at("runs")) {
    results.runs.push_back(ToRow(row));
    check(results.runs.back().setting);
  }
  return results;
}

// Returns the JSON as text. Bytes that are not UTF-8, as names of files may have, are replaced.
std::string Written(const Json& json) {
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

std::string PathOf(const std::string& folder, const std::string& name) {
  return std::filesystem::path(name).is_absolute() ? name : folder + "/" + name;
}

double ValueOf(const NamedValues& values, const std::string& name, double missing) {
  for (const auto& value : values)
    if (value.first == name) return value.second;
  return missing;
}

double RunRow::Counter(const std::string& name) const { return ValueOf(counters, name); }

NamedValues MetricValues(const RunRow& row) {
  const ImageDifference& m = row.metrics;
  return {{"relMSE", m.relMse},
          {"trimmedRelMSE", m.trimmedRelMse},
          {"MSE", m.mse},
          {"meanError", m.meanError},
          {"meanReference", m.meanReference},
          {"relativeMeanError", m.relativeMeanError},
          {"p99", m.p99},
          {"FLIP", row.flip},
          {"nonFinitePixels", double(m.nonFinitePixels)}};
}

double RunRow::PhotonsStored() const {
  double sum = 0;
  for (const auto& [name, value] : counters)
    if (name.starts_with("photons/") && name.ends_with(" stored")) sum += value;
  return sum;
}

double RunRow::PhotonPaths() const {
  double most = 0;  // all maps are filled from the same paths
  for (const auto& [name, value] : counters)
    if (name.starts_with("photons/") && name.ends_with(" paths")) most = std::max(most, value);
  return most;
}

std::string ToJson(const Results& results) {
  Json json = {{"format", kFormat},
               {"program", results.program},
               {"fingerprint", results.fingerprint},
               {"processor", results.processor},
               {"system", results.system},
               {"cores", results.cores},
               {"title", results.title},
               {"scene", results.scene},
               {"sceneHash", results.sceneHash},
               {"command", results.command},
               {"clock", results.clock},
               {"photonFile", results.photonFile},
               {"seeds", results.seeds},
               {"targets", results.targets},
               {"crops", results.crops}};
  json["reference"] = FromReference(results.reference);
  for (const Prediction& prediction : results.predictions)
    json["predictions"].push_back(FromPrediction(prediction));
  for (const BudgetRecord& budget : results.budgets) json["budgets"].push_back(FromBudget(budget));
  for (const LowerBound& bound : results.lowerBounds)
    json["lowerBounds"].push_back({{"setting", bound.setting},
                                   {"cpuSeconds", bound.cpuSeconds},
                                   {"wallSeconds", bound.wallSeconds},
                                   {"command", bound.command}});
  json["settings"] = Json::array();
  for (const Setting& setting : results.settings) json["settings"].push_back(FromSetting(setting));
  json["maps"] = Json::array();
  for (const MapRecord& map : results.maps)
    json["maps"].push_back(
        {{"image", map.image}, {"channel", map.channel}, {"title", map.title}, {"unit", map.unit}});
  json["runs"] = Json::array();
  for (const RunRow& row : results.runs) json["runs"].push_back(FromRow(row, results));
  return Written(json);
}

// Describes the fault of a text of JSON, without the words of the library.
static std::string JsonFault(const nlohmann::json::exception& error) {
  if (const auto* syntax = dynamic_cast<const nlohmann::json::parse_error*>(&error))
    return "is cut off or damaged at byte " + std::to_string(syntax->byte);
  return "lacks a value, or has one of another kind";
}

Results FromJson(const std::string& text) {
  try {
    return Parse(text);
  } catch (const nlohmann::json::exception& error) {
    throw std::runtime_error("results.json " + JsonFault(error));
  }
}

std::vector<std::string> WarningSet::Add(const std::vector<std::string>& warnings) {
  std::vector<std::string> added;
  for (const std::string& warning : warnings) {
    std::string words = warning;
    // Not every render states the standard error, in parentheses.
    if (const std::size_t at = words.find(" ("), end = words.find(')', at); end < words.size())
      words.erase(at, end + 1 - at);
    std::erase_if(words, [](char c) { return (c >= '0' && c <= '9') || c == '.'; });
    if (known_.insert(words).second) added.push_back(warning);
  }
  return added;
}

std::string RowToJson(const RunRow& row) { return Written(FromRun(row)); }

RunRow RowFromJson(const std::string& text) {
  try {
    return ToRow(Json::parse(text));
  } catch (const nlohmann::json::exception& error) {
    throw std::runtime_error("the record of a run " + JsonFault(error));
  }
}

void AddRunStatistics(const std::string& text, RunRow* row) {
  try {
    const Json json = Json::parse(text);
    row->threads = int(Number(json, "threads"));
    row->samplesPerPixel = Number(json, "samplesPerPixel");
    row->isComplete = json.value("complete", true);
    if (const auto phases = json.find("phases"); phases != json.end() && phases->is_array()) {
      for (const Json& phase : *phases) {
        row->phases.emplace_back(Text(phase, "name"), Number(phase, "cpuSeconds"));
        row->phaseWall.emplace_back(Text(phase, "name"), Number(phase, "seconds"));
      }
    }
    row->rays = ToValues(json.value("rays", Json::object()));
    row->counters = ToValues(json.value("counters", Json::object()));
    row->certificate = ToValues(json.value("certificate", Json::object()));
  } catch (const nlohmann::json::exception& error) {
    throw std::runtime_error("the text with the statistics of a run " + JsonFault(error));
  }
}

}  // namespace exphoton::study
