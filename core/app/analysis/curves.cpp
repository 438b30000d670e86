// SPDX-License-Identifier: BSD-2-Clause
// This file computes Pareto fronts, log-log interpolation and the effect of doubling a parameter.
#include "core/app/analysis/curves.h"

#include <algorithm>
#include <charconv>
#include <map>
#include <optional>

namespace exphoton::study {
namespace {

bool IsUsable(const CostPoint& point) {
  return std::isfinite(point.seconds.value) && point.seconds.value > 0 &&
         std::isfinite(point.error.value) && point.error.value > 0;
}

double RelativeError(const Measured& m) { return std::isfinite(m.error) ? m.error / m.value : 0; }

std::optional<double> ToNumber(const std::string& text) {
  double value = 0;
  const char* const end = text.data() + text.size();
  const auto [next, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || next != end || !(value > 0)) return std::nullopt;
  return value;
}

// Returns a key that is equal for settings that differ only in `parameter`.
std::string Others(const Setting& setting, const std::string& parameter) {
  std::string text = setting.label + "|" + setting.integrator;
  for (const auto& [name, value] : setting.parameters)
    if (name != parameter) text += "|" + name + "=" + value;
  return text;
}

struct Step {
  double value;
  std::size_t point;
};

// EffectSum adds up the pairs of one parameter. Neighbouring pairs share a setting, so each
// setting's weight is summed first: the mean is linear in the seconds and the logarithms of errors.
class EffectSum {
 public:
  explicit EffectSum(const std::vector<CostPoint>& points) : points_(points) {}
  void Add(const Step& from, const Step& to) {
    const double doublings = std::log2(to.value / from.value);
    if (!(doublings > 0)) return;
    weights_[to.point] += 1 / doublings;
    weights_[from.point] -= 1 / doublings;
    ++pairs_;
  }
  int Pairs() const { return pairs_; }
  void Store(DoublingEffect* effect) const {
    double seconds = 0, logs = 0, secondsVariance = 0, logVariance = 0;
    for (const auto& [point, sum] : weights_) {
      const CostPoint& cost = points_[point];
      const double weight = sum / pairs_;
      seconds += weight * cost.seconds.value;
      logs += weight * std::log(cost.error.value);
      secondsVariance += std::pow(weight * cost.seconds.error, 2);
      logVariance += std::pow(weight * cost.error.error / cost.error.value, 2);
    }
    const double factor = std::exp(logs);
    effect->secondsPerDoubling = {seconds, std::sqrt(secondsVariance)};
    effect->errorFactor = {factor, factor * std::sqrt(logVariance)};
    effect->pairs = pairs_;
  }

 private:
  const std::vector<CostPoint>& points_;
  std::map<std::size_t, double> weights_;
  int pairs_ = 0;
};

}  // namespace

std::vector<std::size_t> ParetoFront(const std::vector<CostPoint>& points) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (IsUsable(points[i])) order.push_back(i);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    if (points[a].seconds.value != points[b].seconds.value)
      return points[a].seconds.value < points[b].seconds.value;
    return points[a].error.value < points[b].error.value;
  });
  std::vector<std::size_t> front;
  for (const std::size_t i : order)
    if (front.empty() || points[i].error.value < points[front.back()].error.value)
      front.push_back(i);
  return front;
}

TimeToError FindTimeToError(const std::vector<CostPoint>& points, double error) {
  TimeToError result;
  const std::vector<std::size_t> front = ParetoFront(points);
  if (front.empty()) return result;
  result.best = points[front.back()];
  if (points[front.front()].error.value <= error) {
    const CostPoint& first = points[front.front()];
    const bool isExact = first.error.value == error;
    result.kind = isExact ? TimeToError::Kind::Reached : TimeToError::Kind::AtMost;
    result.seconds = first.seconds;
    return result;
  }
  for (std::size_t i = 1; i < front.size(); ++i) {
    const CostPoint &a = points[front[i - 1]], &b = points[front[i]];
    if (b.error.value > error) continue;
    const double length = std::log(b.error.value / a.error.value);
    const double t = std::log(error / a.error.value) / length;
    const double rise = std::log(b.seconds.value / a.seconds.value);
    result.kind = TimeToError::Kind::Reached;
    result.seconds.value = a.seconds.value * std::exp(t * rise);
    // The error propagates to first order:
    // d ln seconds = (1-t) d ln s_a + t d ln s_b - rise / length ((1-t) d ln e_a + t d ln e_b)
    const double slope = rise / length;
    const double fromA =
        (1 - t) * std::hypot(RelativeError(a.seconds), slope * RelativeError(a.error));
    const double fromB = t * std::hypot(RelativeError(b.seconds), slope * RelativeError(b.error));
    result.seconds.error = result.seconds.value * std::hypot(fromA, fromB);
    return result;
  }
  return result;
}

Measured Ratio(const Measured& a, const Measured& b) {
  const double value = a.value / b.value;
  return {value, value * std::hypot(RelativeError(a), RelativeError(b))};
}

std::vector<DoublingEffect> FindDoublingEffects(const std::vector<Setting>& settings,
                                                const std::vector<CostPoint>& points) {
  // Maps (label, parameter) to groups of settings that differ only in the parameter.
  std::map<std::pair<std::string, std::string>, std::map<std::string, std::vector<Step>>> all;
  for (std::size_t i = 0; i < settings.size(); ++i) {
    if (!IsUsable(points[i])) continue;
    for (const auto& [name, text] : settings[i].parameters)
      if (const auto value = ToNumber(text))
        all[{settings[i].label, name}][Others(settings[i], name)].push_back({*value, i});
  }
  std::vector<DoublingEffect> costs;
  for (auto& [key, groups] : all) {
    EffectSum sum(points);
    for (auto& group : groups) {
      std::vector<Step>& steps = group.second;
      std::sort(steps.begin(), steps.end(),
                [](const Step& a, const Step& b) { return a.value < b.value; });
      for (std::size_t i = 1; i < steps.size(); ++i) sum.Add(steps[i - 1], steps[i]);
    }
    if (sum.Pairs() == 0) continue;
    costs.push_back({key.first, key.second, {}, {}, 0});
    sum.Store(&costs.back());
  }
  return costs;
}

}  // namespace exphoton::study
