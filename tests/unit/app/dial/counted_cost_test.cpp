// SPDX-License-Identifier: BSD-2-Clause
// These tests count the cost of a render whose statistics are known.
#include "core/app/dial/pilots/counted_cost.h"

#include <gtest/gtest.h>

#include "core/app/dial/dial_settings.h"

namespace exphoton::cli {
namespace {

void FillIn(Statistics* statistics) {
  RayCounters rays;
  rays.counts[std::size_t(RayKind::Camera)] = 300;
  rays.counts[std::size_t(RayKind::Gather)] = 1000;
  rays.counts[std::size_t(RayKind::Photon)] = 400;
  statistics->AddRays(rays);
  const auto set = [&](const char* name, double value) { statistics->SetCounter(name, value, ""); };
  set("render/camera samples", 100);
  set("photons/shot", 500);
  set("photons/skipped", 100);
  set("photons/indirect paths", 300);
  set("photons/caustic stored", 10);
  set("photons/indirect stored", 200);
}

// 200 of the camera rays average emission at the edges of lamps. They cost .9 instead of 1.15.
TEST(CountedCost, ChargesLessForRaysThatReadOnlyEmission) {
  Statistics statistics;
  FillIn(&statistics);
  EXPECT_NEAR(CostOf(statistics, "exphotonmap").samples, 1100 * 1.15 + 200 * .9, 1e-9);
}

// A quarter of the 400 traced paths and all skipped ones are for the caustic map alone.
TEST(CountedCost, KnowsThePartOfTheCausticMap) {
  Statistics statistics;
  FillIn(&statistics);
  const CountedCost cost = CostOf(statistics, "exphotonmap");
  EXPECT_NEAR(cost.maps, 400 * 1.35 + 100 * .3 + 210 * .6, 1e-9);
  EXPECT_NEAR(cost.causticMaps, 100 * 1.35 + 100 * .3 + 10 * .6, 1e-9);
}

// Each of 150 paths has a first ray for the direct map, and 50 photons are stored there.
TEST(CountedCost, KnowsThePartOfTheDirectMap) {
  Statistics statistics;
  FillIn(&statistics);
  statistics.SetCounter("photons/direct paths", 150, "");
  statistics.SetCounter("photons/direct stored", 50, "");
  EXPECT_NEAR(CostOf(statistics, "exphotonmap").directMaps, 150 * 1.35 + 50 * .6, 1e-9);
}

TEST(PilotWork, AddsUpRenders) {
  Statistics statistics;
  FillIn(&statistics);
  PilotWork work;
  work.Add(statistics), work.Add(statistics);
  EXPECT_EQ(work.renders, 2);
  EXPECT_EQ(work.rays.Total(), 3400u);
  EXPECT_EQ(work.caustic, 20);
  EXPECT_EQ(work.indirect, 400);
}

// Fewer photons would blur caustics, so only indirect photons become fewer.
TEST(DialSettings, KeepCausticPhotonsWhereOthersBecomeFewer) {
  DialSettings settings{1000, 400, .25, 0};
  std::vector<ParameterOverride> overrides = settings.Overrides();
  ASSERT_EQ(overrides.size(), 1u);
  EXPECT_EQ(overrides[0].parameter, "indirectphotons");
  EXPECT_EQ(overrides[0].value, "250");
  settings.photons = 4;
  overrides = settings.Overrides();
  ASSERT_EQ(overrides.size(), 2u);
  EXPECT_EQ(overrides[1].parameter, "causticphotons");
  EXPECT_EQ(overrides[1].value, "1600");
}

}  // namespace
}  // namespace exphoton::cli
