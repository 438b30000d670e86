// SPDX-License-Identifier: BSD-2-Clause
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/app/dial/dial.h"
#include "core/app/options/options.h"
#include "core/base/log.h"

namespace exphoton::cli {
namespace {

// A command whose dial chose this number of times the scene's 1000 photons.
RenderCommand ChosenWith(double photons) {
  RenderCommand command;
  command.load.parameters.push_back({"SurfaceIntegrator", "maxdepth", "7"});
  DialSettings settings;
  settings.indirectPhotons = 1000;
  settings.photons = photons;
  for (const ParameterOverride& parameter : settings.Overrides())
    command.load.parameters.push_back(parameter);
  command.dial.emplace();
  command.dial->photonSamples = 2;
  command.dial->settings = settings;
  command.dial->mayRaisePhotons = true;
  return command;
}

std::vector<std::string> ValuesOf(const RenderCommand& command) {
  std::vector<std::string> values;
  for (const ParameterOverride& parameter : command.load.parameters)
    values.push_back(parameter.value);
  return values;
}

// The scene's own number needs no parameter, so the smaller number must not stay.
TEST(RaisePhotons, ReplacesFewPhotonsByThoseOfTheScene) {
  Log log(Log::Level::Quiet, Log::Sink::Memory);
  RenderCommand command = ChosenWith(.25);
  EXPECT_EQ(ValuesOf(command), (std::vector<std::string>{"7", "250"}));
  ASSERT_TRUE(RaisePhotons(2, &command, log));
  EXPECT_EQ(ValuesOf(command), std::vector<std::string>{"7"});
  EXPECT_EQ(command.dial->settings.photons, 1);
  ASSERT_TRUE(RaisePhotons(3, &command, log));
  EXPECT_EQ(ValuesOf(command), (std::vector<std::string>{"7", "4000"}));
}

// The text has the final numbers, whatever was chosen first.
TEST(RaisePhotons, ChangesTheNumbersInTheTextOfTheChoice) {
  Log log(Log::Level::Quiet, Log::Sink::Memory);
  RenderCommand command = ChosenWith(.25);
  const std::string integrator = "integrator path -> exphotonmap", rays = ", gather rays 8 -> 16";
  command.dial->text = integrator + ", indirect photons 1000 -> 250" + rays;
  ASSERT_TRUE(RaisePhotons(2, &command, log));
  EXPECT_EQ(command.dial->text, integrator + rays);
  ASSERT_TRUE(RaisePhotons(3, &command, log));
  EXPECT_EQ(command.dial->text, integrator + rays + ", indirect photons 1000 -> 4000");
  ASSERT_TRUE(RaisePhotons(4, &command, log));
  EXPECT_EQ(command.dial->text, integrator + rays + ", indirect photons 1000 -> 16000");
}

// The next render counts the looks so far, and knows that photons cost more.
TEST(RaisePhotons, InformsTheNextRender) {
  Log log(Log::Level::Quiet, Log::Sink::Memory);
  RenderCommand command = ChosenWith(1);
  ASSERT_TRUE(RaisePhotons(2, &command, log));
  EXPECT_EQ(command.dial->earlierLooks, 2);
  EXPECT_EQ(command.dial->photonSamples, 8);
}

// With 4 times the photons, the picture is expected to cost as much as 4 * 2 + 10 samples.
TEST(TooManySamples, AreMoreThanTwiceThoseOfARival) {
  RenderCommand command = ChosenWith(1);
  command.dial->expectedSamples = 10;
  EXPECT_FALSE(TooManySamples(command));  // no rival
  command.dial->rivalSamples = 9.1;
  EXPECT_FALSE(TooManySamples(command));
  command.dial->rivalSamples = 8.9;
  EXPECT_EQ(TooManySamples(command), 16);  // without the photons so far
  command.timeLimit = 60;
  EXPECT_FALSE(TooManySamples(command));
  command.timeLimit.reset();
  command.dial->mayRaisePhotons = false;  // for example with --keep
  EXPECT_FALSE(TooManySamples(command));
}

TEST(RaisePhotons, EndsWithTooManyPhotons) {
  Log log(Log::Level::Quiet, Log::Sink::Memory);
  RenderCommand command = ChosenWith(64);
  ASSERT_TRUE(RaisePhotons(2, &command, log));
  EXPECT_FALSE(command.dial->mayRaisePhotons);
  EXPECT_FALSE(RaisePhotons(3, &command, log));
  EXPECT_EQ(command.dial->settings.photons, 256);
}

}  // namespace
}  // namespace exphoton::cli
