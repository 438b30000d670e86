// SPDX-License-Identifier: BSD-2-Clause
// These tests compare the forms of a RunRecord with their whole text: the table of --stats, the
// line of --stats-json, the line on stopping rules, the text of --explain, and the picture's
// attributes.
#include "core/app/output/run_record.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "core/app/analysis/results.h"
#include "tests/support/test_scene.h"

namespace exphoton::cli {
namespace {

constexpr const char* kScene = R"(
    Film "image" "integer xresolution" 20 "integer yresolution" 10
    Sampler "stratified" "integer xsamples" 3 "integer ysamples" 1
    PixelFilter "triangle"
    Accelerator "kdtree"
    SurfaceIntegrator "directlighting"
    LookAt 1 2 3  1 2 5  0 1 0
    Camera "orthographic" "float hither" 1 "float yon" 3
    WorldBegin LightSource "point" Shape "sphere" Shape "sphere" WorldEnd)";

class RunRecordTest : public testing::Test {
 protected:
  RunRecordTest() : scene_(LoadSceneText(kScene)), run(*scene_.setup, statistics) {
    run.seed = 18446744073709551615u;
    run.threads = 3;
    run.renderSeconds = 1.5, run.wallSeconds = 2.5, run.cpuSeconds = 4.25;
    run.peakMemory = 1024;
    run.nonFiniteSamples = 7;
    run.samplesPerPixel = 12;
    run.passes = 4;
    run.stoppedBy = "samples";
    run.commandLine = "exphoton a.pbrt";
  }
  std::string Effects() const { return scene_.setup->scene->Features().Describe(); }
  RenderSetup& Loaded() { return *scene_.setup; }

 private:
  LoadedScene scene_;

 protected:
  Statistics statistics;
  RunRecord run;
};

TEST_F(RunRecordTest, SaysWhatItIsInATable) {
  statistics.AddPhase("parse", .25, .5);
  statistics.AddPhase("own phase", 1, 2);
  RayCounters rays;
  rays.counts = {1, 20, 300, 4000, 50000, 600000};
  statistics.AddRays(rays);
  statistics.SetCounter("things", 12345678, "that were counted");
  statistics.SetCounter("parts", 1. / 3, "of a whole");
  run.noise = .01234;
  EXPECT_EQ(StatisticsTable(run),
            R"(scene         test.pbrt
integrator    directlighting
picture       20 x 10
samples       12 a pixel in 4 passes
threads       3
noise         0.0123 of relMSE, estimated between passes (bias not included)

phase              time    CPU time   share  meaning
parse           0.250 s     0.500 s  10.0 %  reading the scene: files, plugins,
                                             textures, meshes
own phase       1.000 s     2.000 s  40.0 %  
all            2.500 s     4.250 s  100.0 %  from reading the scene to writing
                                             the picture

rays                 count   share  meaning
camera                  1    0.0 %  from the camera
shadow                 20    0.0 %  from a surface to a point on a light
bsdf                  300    0.0 %  from a surface, in a direction sampled from
                                    its BSDF
specular            4,000    0.6 %  over mirrors and through glass, on the
                                    camera's side
gather             50,000    7.6 %  of the final gather, over the hemisphere of
                                    a surface
photon            600,000   91.7 %  that carried a photon
all               654,321  100.0 %  rays that were traced, 436,214 per second

counter                           value  meaning
things                       12,345,678  that were counted
parts                          0.333333  of a whole
)");
  run.passes = 1;
  run.noise.reset();
  run.scene.crop = {2, 3, 8, 7};
  const std::string one = StatisticsTable(run);
  EXPECT_NE(one.find("\nsamples       12 a pixel in 1 pass\nthreads "), std::string::npos);
  EXPECT_NE(one.find("\npicture       20 x 10, of which x 2 to 7, y 3 to 6\n"), std::string::npos);
  EXPECT_EQ(one.find("noise"), std::string::npos);
}

TEST_F(RunRecordTest, ExplainsEveryPhaseOfTheRenderer) {
  for (const char* name :
       {"parse", "accelerator", "shoot", "photon maps", "radiance", "render", "write"})
    statistics.AddPhase(name, 1, 2);
  const std::string table = StatisticsTable(run);
  for (const char* row :
       {"40.0 %  building the acceleration structure\n",
        "40.0 %  tracing photons from the lights\n", "40.0 %  sorting photons for searching, and",
        "40.0 %  computing the radiance at radiance", "40.0 %  camera rays and all rays that",
        "40.0 %  writing the picture\n"})
    EXPECT_NE(table.find(row), std::string::npos) << row;
}

TEST_F(RunRecordTest, IsALineOfJson) {
  run.scene.name = "a\"b\\c\n.pbrt";
  run.scene.hash = 0xabcdef;
  run.scene.crop = {2, 3, 8, 7};
  statistics.AddPhase("parse", .25, .5);
  statistics.AddPhase("write", 1, 2);
  RayCounters rays;
  rays.counts = {1, 2, 3, 4, 5, 6};
  statistics.AddRays(rays);
  statistics.SetCounter("things", .5, "");
  run.footprintSamples = 5;
  run.isComplete = false;
  run.targetError = .125;
  run.aovs = "N";
  std::string effects;
  for (int i = 0; i < kFeatureCount; ++i) {
    const auto& row = Loaded().scene->Features().Get(Feature(i));
    effects += std::string(i ? "," : "") + '"' + FeatureName(Feature(i)) +
               "\":{\"on\":" + (row.on ? "true" : "false") + ",\"reason\":\"" + row.reason + "\"}";
  }
  EXPECT_EQ(StatisticsJson(run),
            "{\"scene\":\"a\\\"b\\\\c\\u000a.pbrt\",\"sceneHash\":\"0000000000abcdef\","
            "\"integrator\":\"directlighting\",\"sampler\":\"stratified\","
            "\"accelerator\":\"kdtree\",\"resolution\":[20,10],\"pixelBounds\":[2,8,3,7],"
            "\"samplesPerPixel\":12,\"footprintSamplesPerPixel\":5,\"effects\":{" +
                effects +
                "},\"seed\":\"18446744073709551615\",\"threads\":3,\"complete\":false,"
                "\"nonFiniteSamples\":7,\"renderSeconds\":1.5,\"wallSeconds\":2.5,"
                "\"cpuSeconds\":4.25,\"peakMemoryBytes\":1024,\"passes\":4,"
                "\"stoppedBy\":\"samples\",\"noise\":null,\"targetError\":0.125,"
                "\"timeLimit\":null,\"aovs\":\"N\",\"phases\":[{\"name\":\"parse\","
                "\"seconds\":0.25,\"cpuSeconds\":0.5},{\"name\":\"write\",\"seconds\":1,"
                "\"cpuSeconds\":2}],\"rays\":{\"camera\":1,\"shadow\":2,\"bsdf\":3,"
                "\"specular\":4,\"gather\":5,\"photon\":6},\"counters\":{\"things\":0.5}}\n");
  run.footprintSamples = 0;
  run.isComplete = true;
  run.noise = .25, run.noiseError = .0625, run.timeLimit = 9;
  run.accuracy = .5, run.upperError = .0625, run.choice = "more";
  run.omitted = {{"glossy", .125, .75}};
  const std::string other = StatisticsJson(run);
  EXPECT_EQ(other.find("footprint"), std::string::npos);
  EXPECT_NE(other.find("\"complete\":true,"), std::string::npos);
  EXPECT_NE(other.find("\"noise\":0.25,\"noiseError\":0.0625,\"targetError\":0.125,"
                       "\"accuracy\":{\"wanted\":0.5,\"upperError\":0.25,\"chosen\":\"more\","
                       "\"omitted\":[{\"effect\":\"glossy\",\"bound\":0.125,\"time\":0.75}]},"
                       "\"timeLimit\":9,"),
            std::string::npos)
      << other;
}

// Names of files may have any bytes.
TEST_F(RunRecordTest, WritesJsonOfUtf8Only) {
  run.scene.name =
      "\xe9t\xc3\xa9 \xe2\x82\xac\xf0\x9f\x98\x80 \xed\xa0\x80 \xc0\x80 \xf4\x90\x80\x80 \xe2\x82";
  const std::string bad = "\\ufffd", json = StatisticsJson(run);
  EXPECT_TRUE(json.starts_with("{\"scene\":\"" + bad + "t\xc3\xa9 \xe2\x82\xac\xf0\x9f\x98\x80 " +
                               bad + bad + bad + " " + bad + bad + " " + bad + bad + bad + bad +
                               " " + bad + bad + "\","))
      << json;
  study::RunRow row;
  EXPECT_NO_THROW(study::AddRunStatistics(json, &row));
}

TEST_F(RunRecordTest, SaysWhichRuleStoppedIt) {
  run.noise = .0004;
  const std::string noise = "; noise \u00b12 % (bias not included), relMSE of the noise 0.0004";
  EXPECT_EQ(StoppingText(run), "two independent halves: 12 samples a pixel in 4 passes" + noise);
  run.timeLimit = 90.5;
  EXPECT_EQ(StoppingText(run),
            "stopped at the limit of samples: 12 samples a pixel in 4 passes" + noise);
  run.stoppedBy = "time-limit";
  EXPECT_EQ(StoppingText(run),
            "stopped at the last whole pass within 90.5 s: 12 samples a pixel "
            "in 4 passes" +
                noise);
  run.timeLimit.reset();
  run.stoppedBy = "samples";
  run.targetError = .01;
  EXPECT_EQ(StoppingText(run),
            "stopped at the limit of samples: 12 samples a pixel in 4 passes" + noise);
  run.stoppedBy = "target-error";
  run.passes = 1;
  run.noise.reset();
  EXPECT_EQ(StoppingText(run),
            "reached the target error 0.01: 12 samples a pixel in 1 pass, which "
            "give no estimate of the noise");
  run.isComplete = false;
  EXPECT_EQ(StoppingText(run),
            "stopped by a signal: 12 samples a pixel in 1 pass, which give no "
            "estimate of the noise");
  run.samplesPerPixel = 1;
  EXPECT_TRUE(StoppingText(run).starts_with("stopped by a signal: 1 sample a pixel in 1 pass"));
}

TEST_F(RunRecordTest, HasTheErrorOfAnAccuracyInPlainNumbers) {
  run.accuracy = .05;
  run.stoppedBy = "accuracy";
  run.upperError = 0;
  run.noise = 0;
  EXPECT_EQ(StoppingText(run),
            "the estimated error is 0: 12 samples a pixel in 4 passes; noise \u00b10 % (bias not "
            "included), relMSE of the noise 0");
  run.upperError = .0016;
  EXPECT_TRUE(StoppingText(run).starts_with("the error lies below 4 % (at a level of 95 %): 12 "))
      << StoppingText(run);
  run.upperError = 250;
  run.omitted = {{"glossy", 1.234, .75}};
  run.stoppedBy = "time-limit";
  EXPECT_TRUE(StoppingText(run).starts_with(
      "the error lies below 1580 % (at a level of 95 %), of which effects left out are at most "
      "120 %, which is not the accuracy of 5 %: "))
      << StoppingText(run);
}

TEST_F(RunRecordTest, ExplainsTheScene) {
  Loaded().sceneHash = 0xabcdef;
  Loaded().plugins = {"filters/triangle", "shapes/sphere"};
  EXPECT_EQ(ExplainText(Loaded()),
            "scene         test.pbrt\n"
            "hash          0000000000abcdef\n"
            "integrator    directlighting\n"
            "sampler       stratified\n"
            "samples       3 a pixel\n"
            "filter        triangle\n"
            "camera        orthographic\n"
            "accelerator   kdtree\n"
            "picture       20 x 10\n"
            "primitives    2\n" +
                Effects() + "plugins       2 loaded: filters/triangle, shapes/sphere\n");
}

TEST_F(RunRecordTest, IsInTheAttributesOfThePicture) {
  const auto attributes = PictureAttributes(run, true);
  const auto text = [&](const char* name) { return std::get<std::string>(attributes.at(name)); };
  EXPECT_EQ(text("scene"), "test.pbrt");
  EXPECT_EQ(text("sceneHash"), HashText(Loaded().sceneHash));
  EXPECT_EQ(text("integrator"), "directlighting");
  EXPECT_EQ(text("effects"), run.scene.EffectNames());
  EXPECT_EQ(text("seed"), "18446744073709551615");
  EXPECT_EQ(text("stoppedBy"), "samples");
  EXPECT_EQ(text("comments"), "sampler stratified, filter triangle, camera orthographic");
  EXPECT_EQ(std::get<int>(attributes.at("samplesPerPixel")), 12);
  EXPECT_EQ(std::get<int>(attributes.at("passes")), 4);
  EXPECT_EQ(std::get<std::vector<float>>(attributes.at("chromaticities")),
            (std::vector<float>{.64f, .33f, .3f, .6f, .15f, .06f, .3127f, .329f}));
  EXPECT_EQ(std::get<float>(attributes.at("whiteLuminance")), 179.f);
  EXPECT_EQ(std::get<float>(attributes.at("expTime")), 1.f);
  // Row vectors: the translation is in the last row. The camera looks along +z from (1, 2, 3), and
  // LookAt of version 1 turns x round.
  EXPECT_EQ(std::get<std::vector<float>>(attributes.at("worldToCamera")),
            (std::vector<float>{-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1, -2, -3, 1}));
  // Widths 4 by 2, and depths from 1 to 3 behind the camera.
  EXPECT_EQ(std::get<std::vector<float>>(attributes.at("worldToNDC")),
            (std::vector<float>{-.5, 0, 0, 0, 0, 1, 0, 0, 0, 0, .5, 0, .5, -2, -2, 1}));
  for (const char* name :
       {"footprintSamplesPerPixel", "noise", "targetError", "timeLimit", "capDate", "utcOffset",
        "owner", "commandLine", "time/parse", "cpuTime/parse", "renderTimeSeconds", "threads"})
    EXPECT_FALSE(attributes.contains(name)) << name;
}

TEST_F(RunRecordTest, HasTimesInTheAttributesUnlessReproducible) {
  const char* const user = std::getenv("USER");
  const std::string old = user ? user : "";
  setenv("USER", "somebody", 1);
  statistics.AddPhase("parse", .25, .5);
  statistics.AddPhase("write", 1, 2);
  run.isComplete = false;
  run.footprintSamples = 5;
  run.noise = .5, run.targetError = .25, run.timeLimit = 9;
  const auto attributes = PictureAttributes(run, false);
  const auto text = [&](const char* name) { return std::get<std::string>(attributes.at(name)); };
  const auto number = [&](const char* name) { return std::get<float>(attributes.at(name)); };
  EXPECT_EQ(text("comments"),
            "incomplete: interrupted; sampler stratified, filter triangle, camera orthographic");
  EXPECT_EQ(number("time/parse"), .25f);
  EXPECT_EQ(number("cpuTime/parse"), .5f);
  EXPECT_EQ(number("time/write"), 1.f);
  EXPECT_EQ(number("cpuTime/write"), 2.f);
  EXPECT_EQ(text("commandLine"), "exphoton a.pbrt");
  EXPECT_EQ(text("owner"), "somebody");
  EXPECT_EQ(number("renderTimeSeconds"), 1.5f);
  EXPECT_EQ(number("noise"), .5f);
  EXPECT_EQ(number("targetError"), .25f);
  EXPECT_EQ(number("timeLimit"), 9.f);
  EXPECT_EQ(std::get<int>(attributes.at("footprintSamplesPerPixel")), 5);
  EXPECT_EQ(std::get<int>(attributes.at("threads")), 3);
  const std::time_t now = std::time(nullptr);
  EXPECT_EQ(number("utcOffset"), float(-std::localtime(&now)->tm_gmtoff));
  EXPECT_EQ(text("capDate").size(), 19u);
  if (user)
    setenv("USER", old.c_str(), 1);
  else
    unsetenv("USER");
}

// An interval from 0 to the size of the picture leaves the error unknown, whatever its estimate is.
TEST_F(RunRecordTest, GivesNoErrorWhereACertificateSaysNothing) {
  for (const bool isKnown : {true, false}) {
    Certificate certificate;
    certificate.noise = .0025;
    certificate.bias.squared = .0016;
    certificate.bias.upper = isKnown ? .04 : 4;
    run.certificate = certificate;
    const std::string json = StatisticsJson(run);
    EXPECT_EQ(json.find("\"error\":null") == std::string::npos, isKnown) << json;
    EXPECT_EQ(json.find("\"bias\":null") == std::string::npos, isKnown) << json;
    EXPECT_NE(json.find("\"noise\":0.05"), std::string::npos) << json;
    const auto attributes = PictureAttributes(run, true);
    EXPECT_EQ(attributes.contains("certificate/error"), isKnown);
    EXPECT_EQ(attributes.contains("certificate/bias"), isKnown);
    EXPECT_TRUE(attributes.contains("certificate/biasUpper"));
  }
}

}  // namespace
}  // namespace exphoton::cli
