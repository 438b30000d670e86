// SPDX-License-Identifier: BSD-2-Clause
// PassProgress shows the passes of a picture as one bar, whose length is the expected time. The
// estimate of the time left combines the plan of the passes with the speed of the current one. It
// is rough, and shown as such, until enough is known. docs/decisions/0085-first-estimates.md has
// the reasons and measurements.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/render/passes/pass_plan.h"
#include "core/render/passes/pass_sum.h"
#include "core/render/passes/render_passes.h"

namespace exphoton {

class AccuracyRule;

// TimeForecast estimates the time until a picture is finished, from the state of its current pass.
class TimeForecast {
 public:
  struct Scene {
    std::size_t pixels = 0;
    bool sharesGathers = false;  // between pixels, which makes the noise predictable
    double photonSamples = 0;    // as in PassPlan::Limits; 0: not known
  };
  // The current pass: how much is done, and the seconds since it began.
  struct Pass {
    ProgressReporter::Part part;
    double seconds = 0;
    double renderSeconds = 0;  // of earlier passes
    double rays = 0;           // of one sample of a pixel; 0: not known
  };
  struct Estimate {
    double left = 0;  // seconds
    bool isRough = false;
  };

  TimeForecast(const StoppingRule& rule, const Scene& scene) : rule_(rule), scene_(scene) {}

  // Begins a pass, which is the next step of the plan. `state` is the state before it.
  void Begin(const PassPlan& plan, const PassPlan::Step& step, const PassPlan::State& state);
  // Returns nullopt as long as nothing is known.
  std::optional<Estimate> Left(const Pass& pass) const;

 private:
  std::optional<Estimate> LeftWhilePreparing(const Pass& pass, double limit) const;
  std::optional<Estimate> LeftAfter(PassPlan::State state, double rays) const;

  const StoppingRule& rule_;
  Scene scene_;
  std::optional<PassPlan> after_;  // the plan after the current pass
  PassPlan::Step step_;
  PassPlan::State before_;
};

class PassProgress {
 public:
  PassProgress(ProgressReporter* shown, const StoppingRule& rule, const TimeForecast::Scene& scene);
  PassProgress(const PassProgress&) = delete;
  PassProgress& operator=(const PassProgress&) = delete;

  // The reporter for the passes. It hides their phases, which would be many lines.
  ProgressReporter& OfPasses() { return quiet_; }

  void Begin();
  void BeginPass(const PassPlan& plan, const PassPlan::Step& step, const PassPlan::State& state,
                 double renderSeconds);
  // Shows what is known after a pass. `accuracy` may be null.
  void ShowPasses(const PassSum& sum, const AccuracyRule* accuracy);
  void End(bool isWhole);

 private:
  using Clock = std::chrono::steady_clock;
  void Update();
  TimeForecast::Pass CurrentPass(Clock::time_point now);

  ProgressReporter* shown_;
  const StoppingRule& rule_;
  ProgressReporter quiet_;
  TimeForecast forecast_;
  const double pixels_;
  double renderSeconds_ = 0, samples_ = 0;  // of earlier passes, and of the current one
  std::atomic<std::uint64_t> rays_{0};      // of the samples of the current pass
  Clock::time_point begin_, passBegin_, lastUpdate_;
  std::mutex mutex_;
};

}  // namespace exphoton
