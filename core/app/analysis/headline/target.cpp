// SPDX-License-Identifier: BSD-2-Clause
// The choice of the headline's error counts contenders, not settings, so that many settings of one
// integrator have no more weight than one.
#include "core/app/analysis/headline/target.h"

#include <algorithm>
#include <tuple>

namespace exphoton::study {
namespace {

using Kind = TimeToError::Kind;

const std::string& IntegratorOf(const Line& line) {
  return line.integrator.empty() ? line.label : line.integrator;
}

// Support counts the contenders that reach an error.
struct Support {
  int reached = 0, exact = 0;  // exact: the time is interpolated, not only bounded
  bool hasRatio = false;       // a contender other than the fastest has an exact time
  bool isDecided = true;       // no contender other than the fastest has a bound only, which would
                               // leave open whether it is faster
};

Support SupportOf(const Analysis& analysis, double error) {
  Support support;
  const std::size_t count = analysis.contenders.size();
  std::vector<TimeToError> times;
  for (const Contender& contender : analysis.contenders)
    times.push_back(FindTimeToError(analysis.Points(contender.settings), error));
  double fastest = 1e300;
  for (const TimeToError& time : times) {
    if (time.kind == Kind::Never) continue;
    ++support.reached;
    support.exact += time.kind == Kind::Reached;
    fastest = std::min(fastest, time.seconds.value);
  }
  for (const TimeToError& time : times) {
    const bool isSlower = time.seconds.value > fastest;
    if (time.kind == Kind::Reached && (count == 1 || isSlower)) support.hasRatio = true;
    if (time.kind == Kind::AtMost && isSlower) support.isDecided = false;
  }
  return support;
}

std::optional<double> BestOf(const Analysis& analysis, const std::vector<double>& errors) {
  std::optional<double> best;
  std::tuple<bool, int, int, double> most;
  for (const double error : errors) {
    if (!(error > 0) || ReferenceShortfall(analysis.reference, error) > 1) continue;
    const Support support = SupportOf(analysis, error);
    if (!support.hasRatio) continue;
    const std::tuple rank{support.isDecided, support.reached, support.exact, -error};
    if (best && rank <= most) continue;
    best = error;
    most = rank;
  }
  return best;
}

}  // namespace

std::vector<double> RoundErrors() {
  std::vector<double> errors;
  for (double power = 1; power > 1e-8; power /= 10)
    for (const double digit : {1., .5, .3, .2}) errors.push_back(digit * power);
  return errors;
}

std::vector<Contender> FindContenders(const Analysis& analysis) {
  std::vector<Contender> contenders;
  const auto& lines = analysis.lines;
  const bool isOneIntegrator = std::all_of(lines.begin(), lines.end(), [&](const Line& line) {
    return IntegratorOf(line) == IntegratorOf(lines.front());
  });
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::string name = isOneIntegrator ? lines[i].label : IntegratorOf(lines[i]);
    auto found = std::find_if(contenders.begin(), contenders.end(),
                              [&](const Contender& contender) { return contender.name == name; });
    if (found == contenders.end())
      found = contenders.insert(contenders.end(), Contender{name, i, {}, {}, {}});
    if (lines[i].label == name) found->line = i;
    found->variants.push_back(i);
  }
  // Without a line of the integrator's name, its lines stand for it together.
  for (Contender& contender : contenders) {
    const bool hasMain = lines[contender.line].label == contender.name;
    const std::vector<std::size_t> all = contender.variants;
    for (const std::size_t i : all)
      if (!hasMain || i == contender.line)
        contender.settings.insert(contender.settings.end(), lines[i].settings.begin(),
                                  lines[i].settings.end());
    std::erase_if(contender.variants,
                  [&](std::size_t i) { return !hasMain || i == contender.line; });
  }
  return contenders;
}

std::optional<double> ChooseTarget(const Results& results, const Analysis& analysis) {
  std::vector<double> useful = RoundErrors(), least;
  useful.insert(useful.end(), results.targets.begin(), results.targets.end());
  std::erase_if(useful, [&](double error) { return error > analysis.usefulError; });
  for (const Contender& contender : analysis.contenders)
    least.push_back(FindTimeToError(analysis.Points(contender.settings), 0).best.error.value);
  const std::optional<double> round = BestOf(analysis, useful);
  return round ? round : BestOf(analysis, least);
}

}  // namespace exphoton::study
