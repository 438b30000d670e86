// SPDX-License-Identifier: BSD-2-Clause
// StatisticsJson writes a RunRecord as one line of JSON (RFC 8259).
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string_view>

#include "core/app/output/run_record.h"

namespace exphoton::cli {
namespace {

// Returns the length of the UTF-8 sequence at the beginning of the text (RFC 3629); 0 if the text
// does not begin with one.
std::size_t Utf8Length(std::string_view text) {
  const auto byte = [text](std::size_t i) {
    return i < text.size() ? unsigned(static_cast<unsigned char>(text[i])) : 0u;
  };
  const unsigned lead = byte(0);
  if (lead < 0x80) return 1;
  if (lead < 0xc2 || lead > 0xf4) return 0;
  const std::size_t length = lead < 0xe0 ? 2 : lead < 0xf0 ? 3 : 4;
  for (std::size_t i = 1; i < length; ++i)
    if ((byte(i) & 0xc0) != 0x80) return 0;
  // Longer forms of small numbers, surrogates and numbers above 0x10ffff are no UTF-8.
  const bool isWrong = (lead == 0xe0 && byte(1) < 0xa0) || (lead == 0xed && byte(1) > 0x9f) ||
                       (lead == 0xf0 && byte(1) < 0x90) || (lead == 0xf4 && byte(1) > 0x8f);
  return isWrong ? 0 : length;
}

// Writes JSON members in sequence and inserts the commas.
class JsonWriter {
 public:
  void Open(char bracket) {
    Separate();
    text_ += bracket;
    isFirst_ = true;
  }
  void Close(char bracket) {
    text_ += bracket;
    isFirst_ = false;
  }
  void Key(const std::string& name) {
    Separate();
    AppendQuoted(name);
    text_ += ':';
    isFirst_ = true;
  }
  void Text(const std::string& value) {
    Separate();
    AppendQuoted(value);
  }
  void Bool(bool value) {
    Separate();
    text_ += value ? "true" : "false";
  }
  void Integer(long long value) {
    Separate();
    text_ += std::to_string(value);
  }
  void Number(double value) {
    Separate();
    char digits[40];
    std::snprintf(digits, sizeof digits, "%.17g", value);
    text_ += std::isfinite(value) ? digits : "null";
  }
  std::string Take() { return std::move(text_); }

 private:
  void Separate() {
    if (!isFirst_) text_ += ',';
    isFirst_ = false;
  }
  // Names of files may have any bytes, but JSON is UTF-8.
  void AppendQuoted(const std::string& value) {
    text_ += '"';
    for (std::size_t at = 0; at < value.size();) {
      const std::size_t length = Utf8Length(std::string_view(value).substr(at));
      const char c = value[at];
      if (c == '"' || c == '\\') text_ += '\\';
      if (length == 0)
        AppendEscape(0xfffd);
      else if (length == 1 && c < 32)
        AppendEscape(unsigned(c));
      else
        text_.append(value, at, length);
      at += std::max<std::size_t>(length, 1);
    }
    text_ += '"';
  }
  void AppendEscape(unsigned code) {
    char escape[12];
    std::snprintf(escape, sizeof escape, "\\u%04x", code);
    text_ += escape;
  }

  std::string text_;
  bool isFirst_ = true;
};

void AddScene(const RunRecord& run, JsonWriter* json) {
  const SceneRecord& scene = run.scene;
  json->Key("scene"), json->Text(scene.name);
  json->Key("sceneHash"), json->Text(HashText(scene.hash));
  json->Key("integrator"), json->Text(scene.integrator);
  json->Key("sampler"), json->Text(scene.sampler);
  json->Key("accelerator"), json->Text(scene.accelerator);
  json->Key("resolution"), json->Open('[');
  for (const int size : {scene.full.x1, scene.full.y1}) json->Integer(size);
  json->Close(']');
  json->Key("pixelBounds"), json->Open('[');
  for (const int edge : {scene.crop.x0, scene.crop.x1, scene.crop.y0, scene.crop.y1})
    json->Integer(edge);
  json->Close(']');
  json->Key("samplesPerPixel"), json->Integer(run.samplesPerPixel);
  if (run.footprintSamples > 0)
    json->Key("footprintSamplesPerPixel"), json->Integer(run.footprintSamples);
  json->Key("effects"), json->Open('{');
  for (const SceneRecord::Effect& effect : scene.effects) {
    json->Key(effect.name), json->Open('{');
    json->Key("on"), json->Bool(effect.on);
    json->Key("reason"), json->Text(effect.reason);
    json->Close('}');
  }
  json->Close('}');
}

void AddOptional(const char* key, const std::optional<double>& value, JsonWriter* json) {
  json->Key(key), json->Number(value.value_or(std::numeric_limits<double>::quiet_NaN()));
}

// Errors are roots of parts of relMSE, as in the message. The block's own estimate has its sign.
void AddCertificate(const Certificate& certificate, JsonWriter* json) {
  const auto add = [json](const char* key, double squared) {
    json->Key(key), json->Number(BlockBias::Root(squared));
  };
  const BlockBias& block = certificate.bias;
  json->Key("certificate"), json->Open('{');
  constexpr double kUnknown = std::numeric_limits<double>::infinity();  // written as null
  const bool isKnown = !certificate.SaysNothing();
  add("error", isKnown ? certificate.Error() : kUnknown);
  add("noise", certificate.noise);
  add("bias", isKnown ? certificate.Bias() : kUnknown);
  add("biasLower", certificate.LowerBias());
  add("biasUpper", certificate.UpperBias());
  add("smallestBias", block.smallest);
  json->Key("blockWidth"), json->Integer(block.blockWidth);
  json->Key("blocks"), json->Integer(block.blocks);
  json->Key("blockBiasSquared"), json->Number(block.squared);
  add("blockBiasLower", block.lower);
  add("blockBiasUpper", block.upper);
  json->Key("corrections"), json->Integer(certificate.corrections);
  json->Key("notCovered"), json->Open('[');
  for (const std::string& text : certificate.notCovered) json->Text(text);
  json->Close(']');
  json->Close('}');
}

void AddRays(const RayCounters& rays, JsonWriter* json) {
  json->Key("rays"), json->Open('{');
  for (int i = 0; i < kRayKindCount; ++i) {
    json->Key(RayKindName(RayKind(i)));
    json->Integer(static_cast<long long>(rays.counts[std::size_t(i)]));
  }
  json->Close('}');
}

void AddPilots(const PilotWork& pilots, JsonWriter* json) {
  json->Key("pilots"), json->Open('{');
  json->Key("renders"), json->Integer(pilots.renders);
  AddRays(pilots.rays, json);
  json->Key("directPhotons"), json->Number(pilots.direct);
  json->Key("causticPhotons"), json->Number(pilots.caustic);
  json->Key("indirectPhotons"), json->Number(pilots.indirect);
  json->Key("givesPhotons"), json->Bool(pilots.givesPhotons);
  json->Close('}');
}

// Errors are roots of parts of relMSE.
void AddAccuracy(const RunRecord& run, JsonWriter* json) {
  json->Key("accuracy"), json->Open('{');
  json->Key("wanted"), json->Number(*run.accuracy);
  if (!run.unseen.empty()) json->Key("notCovered"), json->Text(run.unseen.front());
  if (run.upperError) json->Key("upperError"), json->Number(std::sqrt(*run.upperError));
  json->Key("chosen"), json->Text(run.choice);
  json->Key("omitted"), json->Open('[');
  for (const OmittedEffect& effect : run.omitted) {
    json->Open('{');
    json->Key("effect"), json->Text(effect.name);
    json->Key("bound"), json->Number(effect.bound);
    json->Key("time"), json->Number(effect.time);
    json->Close('}');
  }
  json->Close(']');
  if (run.pilots) AddPilots(*run.pilots, json);
  json->Close('}');
}

// Writes the amount of rendering and the rule that stopped it.
void AddStopping(const RunRecord& run, JsonWriter* json) {
  json->Key("passes"), json->Integer(run.passes);
  json->Key("stoppedBy"), json->Text(run.stoppedBy);
  AddOptional("noise", run.noise, json);
  if (run.noise) json->Key("noiseError"), json->Number(run.noiseError);
  AddOptional("targetError", run.targetError, json);
  if (run.accuracy) AddAccuracy(run, json);
  AddOptional("timeLimit", run.timeLimit, json);
  if (run.lastDiskArea) json->Key("lastDiskArea"), json->Number(*run.lastDiskArea);
  json->Key("aovs"), json->Text(run.aovs);
}

void AddStatistics(const Statistics& statistics, JsonWriter* json) {
  json->Key("phases"), json->Open('[');
  for (const Statistics::Phase& phase : statistics.Phases()) {
    json->Open('{');
    json->Key("name"), json->Text(phase.name);
    json->Key("seconds"), json->Number(phase.wallSeconds);
    json->Key("cpuSeconds"), json->Number(phase.cpuSeconds);
    json->Close('}');
  }
  json->Close(']');
  AddRays(statistics.Rays(), json);
  json->Key("counters"), json->Open('{');
  for (const Statistics::Counter& counter : statistics.Counters())
    json->Key(counter.name), json->Number(counter.value);
  json->Close('}');
}

}  // namespace

std::string StatisticsJson(const RunRecord& run) {
  JsonWriter json;
  json.Open('{');
  AddScene(run, &json);
  json.Key("seed"), json.Text(std::to_string(run.seed));  // JSON numbers hold only 53 bits
  json.Key("threads"), json.Integer(run.threads);
  json.Key("complete"), json.Bool(run.isComplete);
  json.Key("nonFiniteSamples"), json.Integer(run.nonFiniteSamples);
  json.Key("renderSeconds"), json.Number(run.renderSeconds);
  json.Key("wallSeconds"), json.Number(run.wallSeconds);
  json.Key("cpuSeconds"), json.Number(run.cpuSeconds);
  json.Key("peakMemoryBytes"), json.Number(run.peakMemory);
  AddStopping(run, &json);
  if (run.certificate) AddCertificate(*run.certificate, &json);
  AddStatistics(run.statistics, &json);
  json.Close('}');
  return json.Take() + "\n";
}

}  // namespace exphoton::cli
