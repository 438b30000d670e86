// SPDX-License-Identifier: BSD-2-Clause
// These tests stop renders at chosen pixels, in process, and continue them from their state. The
// sums must be those of a render that nothing stopped.
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/render/certificate/corrections.h"
#include "core/render/passes/render_halves.h"
#include "core/render/sharing/shared_gathers.h"
#include "core/render/state/checkpoints.h"
#include "tests/support/process.h"
#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

// Stops a render, or lets it pause, after n camera samples, and writes the state.
class CheckpointAt : public Checkpoints {
 public:
  CheckpointAt(int sample, bool stops, std::string path)
      : sample_(sample), stops_(stops), path_(std::move(path)) {}

  void CountSample() {
    if (++samples_ == sample_ && stops_) stop = true;
  }
  bool IsDue() const override { return !stops_ && samples_ >= sample_ && !isTaken_; }
  void Take(const Checkpoint& checkpoint, bool isLast) override {
    EXPECT_EQ(isLast, stops_);
    isTaken_ = true;
    if (!checkpoint.hasWork) return;
    StateWriter writer(path_);
    checkpoint.save(&writer);
    writer.Commit();
    if (!isLast) picture = checkpoint.picture().film.ToImage(true).pixels;
  }

  std::atomic<bool> stop{false};
  std::vector<float> picture;

 private:
  const int sample_;
  const bool stops_;
  const std::string path_;
  std::atomic<int> samples_{0};
  std::atomic<bool> isTaken_{false};
};

// Another integrator that counts its camera samples.
class CountingIntegrator : public SurfaceIntegrator {
 public:
  CountingIntegrator(SurfaceIntegrator& other, CheckpointAt* checkpoint)
      : other_(other), checkpoint_(checkpoint) {}
  void Preprocess(const Scene& scene, PreprocessContext& context) override {
    other_.Preprocess(scene, context);
  }
  void RequestSamples(const Scene& scene, const Sampler& sampler, SampleLayout* layout) override {
    other_.RequestSamples(scene, sampler, layout);
  }
  AovSet Aovs() const override { return other_.Aovs(); }
  DepthParameters DepthLimits() const override { return other_.DepthLimits(); }
  bool FillsSignedLight() const override { return other_.FillsSignedLight(); }
  bool SharesGathers(const Scene& scene) const override { return other_.SharesGathers(scene); }
  Spectrum Li(const RayDifferential& ray, LiContext& context) const override {
    if (checkpoint_) checkpoint_->CountSample();
    return other_.Li(ray, context);
  }

 private:
  SurfaceIntegrator& other_;
  CheckpointAt* checkpoint_;
};

enum class Mode { Plain, Halves, Target, Accuracy };
struct Case {
  Mode mode;
  const char* options;
  AovSet aovs;
  double target = .01;  // or the accuracy
  bool certifies = false;
  bool stopsSharing = false;
  int rows = 14;  // more of them are shared in several bands
};
constexpr const char* kShared =
    R"(SurfaceIntegrator "exphotonmap" "integer indirectphotons" 2000 "integer causticphotons" 100
       "integer finalgathersamples" 4 "bool sharedgather" "true")";
constexpr const char* kSeenPhotons =
    R"(SurfaceIntegrator "photonmap" "integer indirectphotons" 5000 "integer causticphotons" 0
       "bool finalgather" "false")";
constexpr const char* kPath = R"(SurfaceIntegrator "path")";
constexpr const char* kGuided = R"(SurfaceIntegrator "guidedpath" "integer indirectphotons" 2000)";
constexpr const char* kSharedSplats =
    R"(SurfaceIntegrator "exphotonmap" "integer indirectphotons" 2000 "integer causticphotons" 100
       "integer finalgathersamples" 4 "bool sharedgather" "true" PixelFilter "mitchell")";
constexpr const char* kMitchell = R"(SurfaceIntegrator "path" PixelFilter "mitchell")";

const Case kCases[] = {
    {Mode::Plain, kPath, {}},
    {Mode::Plain, kMitchell, {Aov::Variance, Aov::Albedo, Aov::Samples}},
    {Mode::Plain, kShared, {Aov::Indirect, Aov::RadianceDistance}},
    {Mode::Halves, kPath, {Aov::Variance}},
    {Mode::Halves, kMitchell, {Aov::Normal}},
    {Mode::Target, kPath, {Aov::Variance, Aov::Direct}},
    {Mode::Target, kShared, {Aov::Indirect}},
    {Mode::Target, kSeenPhotons, {Aov::Variance}, .0005},  // later passes have several samples
    {Mode::Halves, kShared, {Aov::Indirect}, 0, true},
    {Mode::Halves, kSeenPhotons, {}, 0, true},
    {Mode::Target, kShared, {}, .01, true},
    {Mode::Accuracy, kPath, {Aov::Variance}, .04},
    {Mode::Accuracy, kGuided, {}, .04},
    {Mode::Accuracy, kShared, {Aov::Indirect, Aov::SharingBias}, .2, true},
    {Mode::Accuracy, kShared, {Aov::Indirect, Aov::SharingBias}, .03, true, true},
    {Mode::Accuracy, kShared, {Aov::Indirect}, .2, true, false, 80},
    {Mode::Accuracy, kSharedSplats, {Aov::Normal}, .1, true},
    {Mode::Plain, kShared, {}, 0, false, false, 80},
};

class ResumeTest : public testing::TestWithParam<int> {
 protected:
  static const Case& Param() { return kCases[GetParam()]; }

  struct Output {
    std::string sums;  // of the picture and its AOVs
    std::vector<float> variances;
    PassesResult result;
    std::string corrections;  // sums by group
    std::vector<Statistics::Counter> counters;
    std::vector<std::string> messages;
    friend bool operator==(const Output& a, const Output& b) {
      return a.sums == b.sums && a.variances == b.variances &&
             a.result.samplesPerPixel == b.result.samplesPerPixel &&
             a.result.noise == b.result.noise && a.result.upperError == b.result.upperError &&
             a.result.changes == b.result.changes && a.result.levels == b.result.levels &&
             a.corrections == b.corrections && CameraSamples(a) == CameraSamples(b);
    }
    static double CameraSamples(const Output& output) {
      for (const Statistics::Counter& counter : output.counters)
        if (counter.name == "render/camera samples") return counter.value;
      return -1;
    }
  };

  static LoadedScene Scene() {
    return LoadSceneText(TestHeader("\"path\"", 20, Param().rows, 4) + Param().options + R"(
      WorldBegin
      AttributeBegin AreaLightSource "area" "color L" [ 20 18 15 ]
        Translate 0 .9 2 Rotate 90 1 0 0 Shape "disk" "float radius" [ .3 ] AttributeEnd
      Shape "trianglemesh" "integer indices" [ 0 1 2 0 2 3 ]
        "point P" [ -1 -1 0  1 -1 0  1 -1 3  -1 -1 3 ]
      )" + Wall() + Slot() +
                         R"(
      Translate 0 -.5 2.5 Shape "sphere" "float radius" .5
      WorldEnd)");
  }

  // Returns a slot before the wall that is as wide as a pixel. Sharing spreads light into it.
  static std::string Slot() {
    return !Param().stopsSharing ? "" : R"(
      Shape "trianglemesh" "integer indices" [ 0 1 2 0 2 3  4 5 6 4 6 7 ]
        "point P" [ .02 -1 2.4  .02 1 2.4  .02 1 3  .02 -1 3
                    .19 -1 2.4  .19 1 2.4  .19 1 3  .19 -1 3 ]
)";
  }
  // Returns a wall behind the ball, for pictures with a slot, and so that tall pictures have
  // gathers in all rows.
  static std::string Wall() {
    return Param().rows > 14 || Param().stopsSharing
               ? R"(Shape "trianglemesh" "integer indices" [ 0 1 2 0 2 3 ]
        "point P" [ -9 -9 3  9 -9 3  9 9 3  -9 9 3 ])"
               : "";
  }

  Output Render(CheckpointAt* checkpoints, StateFile* resumed, int threads) {
    LoadedScene scene = Scene();
    RenderSetup& setup = *scene.setup;
    Film film(setup.film.Full(), setup.crop), halves[2] = {film, film};
    AovFilm aovs(setup.crop, Param().aovs);
    ThreadPool pool(threads);
    ProgressReporter progress(ProgressReporter::Mode::Quiet);
    Statistics statistics;
    RenderOptions options;
    options.seed = 7;
    if (Param().rows > 14) options.sharingMemory = 1;
    options.aovs = Param().aovs.IsEmpty() ? nullptr : &aovs;
    options.checkpoints = checkpoints;
    options.resumed = resumed;
    if (checkpoints) options.stop = &checkpoints->stop;
    Corrections corrections(setup.crop, .25);
    if (Param().certifies) options.corrections = &corrections;
    CountingIntegrator integrator(*setup.integrator, checkpoints);
    const RenderJob job{*setup.scene, integrator, *setup.sampler, *setup.filter, *setup.camera,
                        film,         pool,       *scene.log,     progress,      statistics};
    Output output;
    if (Param().mode == Mode::Plain) output.result.render = exphoton::Render(job, options);
    if (Param().mode == Mode::Halves)
      output.result = RenderTwoHalves(job, options, &halves[0], &halves[1]);
    const StoppingRule rule = Rule();
    if (rule.targetError || rule.accuracy) output.result = RenderInPasses(job, options, rule);
    output.variances = output.result.variances;
    output.counters = statistics.Counters();
    output.messages = scene.log->Messages();
    ByteArchive archive;
    film.Transfer(&archive);
    for (Film& half : halves) half.Transfer(&archive);
    if (options.aovs) aovs.Transfer(&archive);
    output.sums = archive.Take();
    output.corrections = SumsOf(corrections);
    return output;
  }

  static StoppingRule Rule() {
    StoppingRule rule;
    rule.maxSamples = 32;
    if (Param().mode == Mode::Target) rule.targetError = Param().target;
    if (Param().mode == Mode::Accuracy)
      rule.accuracy = StoppingRule::Accuracy{Param().target, 4, .125, 0, 0, true};
    return rule;
  }

  static std::string SumsOf(const Corrections& corrections) {
    ByteArchive archive;
    std::int64_t count = corrections.Count();
    double expected = corrections.ExpectedCount();
    archive.Values(&count, &expected);
    for (const Corrections::Group* group : corrections.Groups()) {
      std::vector<double> sums = corrections.SumsOf(*group);
      archive.List(&sums);
    }
    return archive.Take();
  }

  std::string Path() const { return folder_.File("a.state"); }

  const TestFolder folder_;
};

TEST_P(ResumeTest, AStoppedRenderEndsWithTheSameSums) {
  const Output whole = Render(nullptr, nullptr, 1);
  int resumed = 0;
  bool saysOnePass = false;
  for (const int sample : {5, 6, 243, 400, 1110, 1122, 1603, 2247, 2801, 4001, 4805, 8003, 12002}) {
    CheckpointAt stop(sample, true, Path());
    const Output part = Render(&stop, nullptr, 1);
    if (part.result.render.isComplete) break;  // fewer samples than that
    // A part of a pass says nothing about the bias of the picture.
    EXPECT_FALSE(Param().mode == Mode::Plain && part.result.render.sharingBias.has_value());
    StateFile state(Path());
    const Output again = Render(nullptr, &state, 2);
    EXPECT_TRUE(again.result.render.isComplete);
    EXPECT_TRUE(again == whole) << "stopped at sample " << sample;
    for (const std::string& message : again.messages)
      saysOnePass = saysOnePass || message.ends_with("\" after 1 pass\n");
    ++resumed;
  }
  EXPECT_GE(resumed, 3);
  EXPECT_TRUE(Param().rows == 14 || whole.result.render.sharingBias.has_value());
  const bool hasPasses = Param().mode == Mode::Target || Param().mode == Mode::Accuracy;
  EXPECT_EQ(saysOnePass, hasPasses);
  EXPECT_EQ(whole.result.changes.empty(), !Param().stopsSharing);
  EXPECT_EQ(whole.result.upperError.has_value(), Param().mode == Mode::Accuracy);
}

TEST_P(ResumeTest, APauseChangesNothing) {
  const Output whole = Render(nullptr, nullptr, 1);
  for (const int sample : {100, 700}) {
    CheckpointAt pause(sample, false, Path());
    EXPECT_TRUE(Render(&pause, nullptr, 2) == whole) << sample;
    ASSERT_FALSE(pause.picture.empty());
    EXPECT_EQ(pause.picture.size(), 20 * std::size_t(Param().rows) * 4);
    StateFile state(Path());
    EXPECT_TRUE(Render(nullptr, &state, 1) == whole) << sample;
  }
}

// A checksum does not protect against files that are made on purpose.
TEST_P(ResumeTest, ContradictoryStatesGiveErrorsOrPictures) {
  const bool hasBands = Param().rows > 14;
  // The second pass of an accuracy, so that the state has a complete one.
  // Bands have 16 rows or more, and the first one also gathers its margin.
  if (hasBands) ASSERT_LT(20 * 4 * (16 + SharingMargin()), 5200);
  const int samples = hasBands ? 5200 : Param().mode == Mode::Accuracy ? 2000 : 700;
  CheckpointAt stop(samples, true, Path());
  ASSERT_FALSE(Render(&stop, nullptr, 1).result.render.isComplete);
  const StateFile whole(Path());
  const std::vector<std::string> names = whole.Names();
  int errors = 0;
  std::uint64_t random = 1;
  for (const std::string& damaged : names) {
    if (damaged == "non-finite samples") continue;
    if (hasBands && damaged != "pass gathers") continue;                            // to save time
    if (damaged.starts_with("batch gathers") && !damaged.ends_with("7")) continue;  // to save time
    if (damaged.starts_with("joint gathers") && !damaged.ends_with("7")) continue;
    if (damaged.starts_with("corrections of group") && !damaged.ends_with("1")) continue;
    for (int i = 0; i < 12; ++i) {
      StateWriter writer(folder_.File("b.state"));
      for (const std::string& name : names) {
        std::string bytes(whole.Get(name));
        random = random * 6364136223846793005u + 1442695040888963407u;
        const std::size_t at = std::size_t(random >> 33) %
                               (i < 6 ? std::min<std::size_t>(bytes.size(), 48) : bytes.size());
        if (name == damaged && i % 3 == 0) bytes.resize(at);
        if (name == damaged && i % 3 != 0) bytes[at] = char(bytes[at] ^ (1 << (random >> 60) % 8));
        writer.Add(name, bytes);
      }
      writer.Commit();
      try {
        StateFile state(folder_.File("b.state"));
        Render(nullptr, &state, 1);
      } catch (const Error& error) {
        EXPECT_EQ(error.Status(), ExitStatus::File) << error.what();
        ++errors;
      }
    }
  }
  EXPECT_GE(errors, hasBands ? 5 : 10);
}

// A state that was written before renders of this kind could be continued has no such sections.
TEST_P(ResumeTest, StatesWithoutTheErrorAreRefused) {
  if (!Param().certifies && Param().mode != Mode::Accuracy) return;
  CheckpointAt stop(Param().mode == Mode::Accuracy ? 2000 : 700, true, Path());
  ASSERT_FALSE(Render(&stop, nullptr, 1).result.render.isComplete);
  const StateFile whole(Path());
  int refused = 0;
  for (const char* lacking :
       {"accuracy", "corrections", "corrections of the pass", "unshared", "unshared film",
        "unshared aovs", "pass sharing", "joint windows", "joint pass 0"}) {
    if (!whole.Has(lacking)) continue;
    StateWriter writer(folder_.File("b.state"));
    for (const std::string& name : whole.Names())
      if (name != lacking) writer.Add(name, whole.Get(name));
    writer.Commit();
    StateFile state(folder_.File("b.state"));
    try {
      Render(nullptr, &state, 1);
      ADD_FAILURE() << lacking;
    } catch (const Error& error) {
      const std::string text = "section \"" + std::string(lacking) + "\" is missing";
      EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << error.what();
      ++refused;
    }
  }
  EXPECT_GE(refused, 1);
}

TEST_P(ResumeTest, CorrectionsOfOtherPassesAreRefused) {
  if (!Param().certifies || Param().rows > 14) return;
  CheckpointAt stop(Param().mode == Mode::Accuracy ? 2000 : 700, true, Path());
  ASSERT_FALSE(Render(&stop, nullptr, 1).result.render.isComplete);
  const StateFile whole(Path());
  const std::string group = "corrections of group 0";
  ASSERT_TRUE(whole.Has(group));
  StateWriter writer(folder_.File("b.state"));
  for (const std::string& name : whole.Names()) {
    std::string bytes(whole.Get(name));
    if (name == group) ++bytes[0];  // the number of its samples
    writer.Add(name, bytes);
  }
  writer.Commit();
  StateFile state(folder_.File("b.state"));
  try {
    Render(nullptr, &state, 1);
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.Status(), ExitStatus::File);
    EXPECT_NE(std::string(error.what()).find("other passes"), std::string::npos) << error.what();
  }
}

INSTANTIATE_TEST_SUITE_P(Modes, ResumeTest, testing::Range(0, int(std::size(kCases))));

}  // namespace
}  // namespace exphoton
