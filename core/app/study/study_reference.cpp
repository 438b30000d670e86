// SPDX-License-Identifier: BSD-2-Clause
// PrepareReference renders the reference of a study as two halves with independent random numbers.
// Each round is averaged into its half, weighted by sample counts. reference/state.txt records the
// progress. It is written last, so an interrupted reference continues after its last complete
// round.
#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <sstream>

#include "core/app/options/values.h"
#include "core/app/output/output_files.h"
#include "core/app/study/study_runner.h"
#include "core/base/error.h"
#include "core/base/log.h"
#include "core/imaging/files/exr.h"

namespace exphoton::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kState = "reference/state.txt";
constexpr int kRounds = 8;  // approximate number of rounds after the first

struct State {
  std::string key;
  int rounds = 0;
  double samples = 0;  // of one half
  double wallSeconds = 0, cpuSeconds = 0;
};

std::string StateText(const State& state) {
  char text[256];
  std::snprintf(text, sizeof text, "%s %d %.17g %.17g %.17g\n", state.key.c_str(), state.rounds,
                state.samples, state.wallSeconds, state.cpuSeconds);
  return text;
}

State ReadState(const std::string& path) {
  State state;
  std::istringstream text(ReadTextFile(path));
  text >> state.key >> state.rounds >> state.samples >> state.wallSeconds >> state.cpuSeconds;
  return text ? state : State();
}

// Returns (n old + m added) / (n + m) for each value.
Image Average(const Image& old, double n, const Image& added, double m) {
  Image mean = added;
  for (std::size_t i = 0; i < mean.pixels.size(); ++i)
    mean.pixels[i] = float((double(old.pixels[i]) * n + double(added.pixels[i]) * m) / (n + m));
  return mean;
}

class ReferenceMaker {
 public:
  ReferenceMaker(const StudyOptions& options, StudyRunner& runner)
      : options_(options),
        runner_(runner),
        scene_(options.referenceScene.empty() ? options.scene : options.referenceScene),
        setting_(study::ParseSetting(options.makeReference)),
        folder_(runner.Folder()) {}

  study::ReferenceRecord Make() {
    const SceneFacts facts = ExamineScene(scene_, options_);
    StudyOptions bare = options_;
    bare.threads = 0;
    const std::string key = HashOfText(
        facts.hash + CommandText(RenderArguments(bare, "", setting_, study::ReferenceSeed(0, 0))));
    MakeFolder(folder_.Path() + "/reference");
    state_ = ReadState(folder_.Path() + "/" + kState);
    const auto exists = [&](char which) { return fs::exists(folder_.Path() + "/" + Half(which)); };
    if (state_.key != key || !exists('a') || !exists('b')) {
      state_ = State();
      state_.key = key;
    }
    while (state_.rounds == 0 || state_.wallSeconds < .97 * options_.referenceSeconds) Round();
    return Record(facts);
  }

 private:
  // Returns a path relative to the study folder. Every round writes new files, so the files of the
  // recorded round are always complete.
  std::string Half(char which, int round) const {
    return std::string("reference/half-") + which + "-" + std::to_string(round) + ".exr";
  }
  std::string Half(char which) const { return Half(which, state_.rounds); }

  int NextSamples() const {
    if (state_.rounds == 0) return 16;
    const double left = options_.referenceSeconds - state_.wallSeconds;
    const double goal = std::min(left, options_.referenceSeconds / kRounds);
    const double samples = goal * state_.samples / std::max(state_.wallSeconds, 1e-3);
    return int(std::clamp(samples, 1., 65536.));
  }

  void Round() {
    const int samples = NextSamples();
    State next = state_;
    ++next.rounds;
    const char halves[] = {'a', 'b'};
    Image images[2];
    for (int i = 0; i < 2; ++i) {
      study::Setting setting = setting_;
      std::erase_if(setting.parameters, [](const auto& p) { return p.first == "spp"; });
      setting.parameters.emplace_back("spp", std::to_string(samples));
      const std::uint64_t seed = study::ReferenceSeed(state_.rounds, i);
      const RenderedPicture picture =
          runner_.Render(RenderArguments(options_, scene_, setting, seed));
      images[i] = ReadExr(picture.path);
      std::error_code ignored;
      fs::remove(picture.path, ignored);
      next.wallSeconds += picture.row.wallSeconds;
      next.cpuSeconds += picture.row.cpuSeconds;
      const double rendered = picture.row.samplesPerPixel;  // samplers round the requested number
      next.samples = state_.samples + rendered;
      if (state_.rounds > 0)
        images[i] = Average(ReadExr(folder_.Path() + "/" + Half(halves[i])), state_.samples,
                            images[i], rendered);
      images[i].attributes["samplesPerPixel"] = int(next.samples);
      images[i].attributes["seed"] = std::string("several: the mean of independent renders");
    }
    const State last = std::exchange(state_, next);
    for (int i = 0; i < 2; ++i) WriteExr(folder_.Claim(Half(halves[i])), images[i], false);
    WriteTextFile(folder_.Claim(kState), StateText(state_));
    for (const char which : halves) folder_.Remove(Half(which, last.rounds));
    char text[128];
    std::snprintf(text, sizeof text,
                  "reference: %.0f samples a pixel in two halves, %.0f of %.0f s", 2 * next.samples,
                  next.wallSeconds, options_.referenceSeconds);
    Say(options_, text);
  }

  study::ReferenceRecord Record(const SceneFacts& facts) const {
    study::ReferenceRecord record;
    record.a = Half('a');
    record.b = Half('b');
    record.scene = scene_;
    record.sceneHash = facts.hash;
    record.integrator = setting_.integrator + (setting_.parameters.empty() ? "" : " ") +
                        (setting_.parameters.empty() ? "" : setting_.Text());
    record.samplesPerPixel = 2 * state_.samples;
    record.seconds = state_.cpuSeconds;
    record.command =
        CommandText(RenderArguments(options_, scene_, setting_, study::ReferenceSeed(0, 0)));
    return record;
  }

  const StudyOptions& options_;
  StudyRunner& runner_;
  std::string scene_;
  study::Setting setting_;
  StudyFolder& folder_;
  State state_;
};

std::string StringAttribute(const Image& image, const char* attribute) {
  const auto found = image.attributes.find(attribute);
  const auto* value =
      found == image.attributes.end() ? nullptr : std::get_if<std::string>(&found->second);
  return value ? *value : std::string();
}

// Returns whether a picture has several passes. They derive seeds of their own.
bool HasPasses(const Image& image) {
  const auto found = image.attributes.find("passes");
  const int* const passes =
      found == image.attributes.end() ? nullptr : std::get_if<int>(&found->second);
  return passes && *passes > 1;
}

// Renders with equal seeds have noise in common, which would be missing from the errors. References
// that a study makes have seeds of their own.
void WarnOfCommonSeed(const StudyOptions& options, const std::string& path, const Image& image) {
  if (HasPasses(image)) return;
  const std::string text = StringAttribute(image, "seed");
  const char* const end = text.data() + text.size();
  std::uint64_t seed = 0;
  const auto [next, error] = std::from_chars(text.data(), end, seed);
  if (error != std::errc() || next != end) return;
  if (seed < 1 || seed > std::uint64_t(options.seeds)) return;
  Log log(options.isQuiet ? Log::Level::Quiet : Log::Level::Normal);
  log.Warning("the reference \"" + path + "\" was rendered with seed " + text +
                  ", as renders of this study are: errors may be too small",
              {}, "--seed 1001 gives a reference noise of its own");
}

}  // namespace

study::ReferenceRecord PrepareReference(const StudyOptions& options, StudyRunner& runner) {
  if (!options.makeReference.empty()) return ReferenceMaker(options, runner).Make();
  study::ReferenceRecord record;
  if (options.references.empty()) return record;
  record.a = fs::absolute(options.references[0]).lexically_normal().string();
  if (options.references.size() > 1)
    record.b = fs::absolute(options.references[1]).lexically_normal().string();
  const Image image = ReadImage(record.a);
  WarnOfCommonSeed(options, record.a, image);
  if (!record.b.empty()) {
    const Image other = ReadImage(record.b);
    WarnOfCommonSeed(options, record.b, other);
    if (other.pixels == image.pixels)
      throw Error(
          ExitStatus::CommandLine,
          "both halves of the reference have the same pixels, which would hide their noise: "
          "\"" +
              options.references[0] + "\" and \"" + options.references[1] + "\"",
          {}, "--reference takes two renders with different seeds, or one");
  }
  record.scene = StringAttribute(image, "scene");
  record.integrator = StringAttribute(image, "integrator");
  return record;
}

}  // namespace exphoton::cli
