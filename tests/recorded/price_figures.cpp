// SPDX-License-Identifier: BSD-2-Clause
// PriceFigures: prices of accuracies for invented pilots, and the passes that a render with
// invented times and noise would take.
#include <sstream>

#include "core/app/quote/price_model.h"
#include "core/app/quote/quote_text.h"
#include "core/render/passes/pass_plan.h"
#include "tests/recorded/figures.h"

namespace exphoton::recorded {
namespace {

using namespace cli;

const std::vector<std::vector<Pilot>> kPilots{
    {{4, .05}},
    {{4, .05}, {16, .012}},
    {{4, .05}, {16, .008}, {64, .0015}},
    {{4, .06}, {16, .025}, {64, .0166}, {256, .0142}},
    {{2, .3}, {8, .09}, {32, .031}},
    {{2, .3}, {8, .1}, {32, .001}},
    {{4, .02}, {16, .0051}, {64, .0011}},
    {{4, .02}, {16, 0}, {64, .0011}},
    {{4, .05}, {16, 0}},
    {{1, .02}, {2, .04}},
    {{4, .04, .003, false}, {16, .009, .001, false}, {16, .02, .002}},
    {{4, .05, .004, false}, {32, .003, .0004, false}, {32, .0034, .0004}},
};

PriceModel ModelOf(std::size_t pilots, bool hasPhotons) {
  PriceModel model;
  model.hasPhotons = hasPhotons;
  model.bias = .013 + .004 * double(pilots);
  model.biasUpper = .035 + .002 * double(pilots);
  model.fixed = .7;
  model.maps = .3 + .1 * double(pilots);
  model.sample = .05;
  model.FitNoise(kPilots[pilots]);
  return model;
}

void AddModels(FigureLines* lines) {
  for (std::size_t i = 0; i < kPilots.size(); ++i) {
    for (const bool hasPhotons : {false, true}) {
      const PriceModel model = ModelOf(i, hasPhotons);
      const std::string name = "price " + std::to_string(i) + (hasPhotons ? " photons" : "");
      lines->Add(name, model.camera, model.slope, model.photonNoise);
      for (const double error : {.3, .1, .05, .03, .02, .004}) {
        for (const int groups : {1, 2, 8}) {
          const auto price = PriceOf(model, {error, groups});
          if (price)
            lines->Add(name + " of", error, double(groups), price->samples, price->photons,
                       price->seconds, price->least, price->most);
          else
            lines->Add(name + " of", error, double(groups), "none");
        }
      }
    }
  }
}

void AddQuotes(FigureLines* lines) {
  std::vector<Quote> quotes;
  for (const std::size_t i : {1, 3, 4, 6}) {
    Quote quote;
    quote.integrator = i == 3 ? "exphotonmap" : "other" + std::to_string(i);
    quote.model = ModelOf(i, i == 3);
    quote.light = {i == 6 ? .7 : 1 + .01 * double(i), .01};
    quote.memory = 12.3e6 * double(i);
    if (i == 3) quote.settings = {100000, 20000};
    if (i == 3) quote.notCovered = {"paths with more than 5 bounces", "blur"};
    quotes.push_back(quote);
  }
  quotes.push_back({"slow", {}, {}, 0, {}, {}, {}, "renders longer than a pilot may"});
  QuoteScene plain{"room.pbrt", {}}, other{"a room.pbrt", {}};
  for (const Quote& quote : quotes) {
    plain.options[quote.integrator] = {};
    other.options[quote.integrator] = {"--set", "Camera.fov=30", "--resolution", "64x48"};
  }
  for (const QuoteScene& scene : {plain, other}) {
    std::istringstream text(QuoteText(scene, quotes, {.2, .05, .018, .001}));
    for (std::string line; std::getline(text, line);) lines->Add("quote:" + line);
  }
}

// Takes passes until the plan has nothing left, for noise that falls in a given way.
void AddPasses(const std::string& name, const PassPlan::Limits& limits, double noiseOfOne,
               FigureLines* lines) {
  PassPlan plan(limits);
  PassPlan::State state;
  state.preprocess = 1.7;
  state.sample = .3;
  for (int i = 0; i < 12; ++i) {
    const auto left = plan.SecondsLeft(state);
    const PassPlan::Step step = plan.Next(state);
    lines->Add(name, step.isNewGroup ? "new" : "same", double(step.size), left ? *left : -1.,
               double(plan.Groups()));
    if (step.size == 0) return;
    plan.Take(step);
    state.samples += step.size;
    state.elapsed += state.sample * double(step.size) + (step.isNewGroup ? state.preprocess : 0);
    if (plan.Groups() > 1) state.noise = noiseOfOne / double(state.samples);
    if (state.samples > 3 && limits.targetError)
      state.enough = noiseOfOne / *limits.targetError * 1.1;
    if (limits.firstSamples > 0 && plan.Groups() > 1) state.needed = 300;
    if (limits.targetError && state.noise && *state.noise < *limits.targetError) return;
    if (state.samples >= limits.maxSamples) return;
  }
}

void AddPlans(FigureLines* lines) {
  PassPlan::Limits limits;
  limits.maxSamples = 1 << 20;
  for (const double target : {.2, .01, .0007}) {
    limits.targetError = target;
    AddPasses("passes to a target", limits, .9, lines);
  }
  limits.timeLimit = 20;
  AddPasses("passes to a target in 20 s", limits, .9, lines);
  limits.targetError.reset();
  for (const double seconds : {1.8, 3., 9., 55.5}) {
    limits.timeLimit = seconds;
    AddPasses("passes in seconds", limits, .9, lines);
  }
  limits.passSamples = 6;
  AddPasses("passes of six samples", limits, .9, lines);
  limits.timeLimit.reset();
  limits.targetError = .02;
  AddPasses("passes of six samples to a target", limits, .9, lines);
  limits.passSamples = 0;
  limits.maxSamples = 37;
  limits.targetError = .0001;
  AddPasses("passes of at most 37 samples", limits, .9, lines);
  limits.maxSamples = 5000;
  limits.targetError.reset();
  limits.firstSamples = 16;
  AddPasses("passes to an accuracy", limits, .9, lines);
}

}  // namespace

std::vector<std::string> PriceFigures() {
  FigureLines lines;
  AddModels(&lines);
  AddQuotes(&lines);
  AddPlans(&lines);
  return lines.Take();
}

}  // namespace exphoton::recorded
