// SPDX-License-Identifier: BSD-2-Clause
// The functions of numbers.h use the minus sign (U+2212) and superscript digits of Unicode.
#include "core/app/analysis/numbers.h"

#include <algorithm>
#include <cmath>

#include "core/base/format.h"

namespace exphoton::study {
namespace {

int Magnitude(double value) { return int(std::floor(std::log10(value))); }

// Returns the number with these decimals and a minus sign. Negative decimals round to tens,
// hundreds and so on.
std::string Fixed(double value, int decimals) {
  const double unit = std::pow(10., -decimals);
  const double rounded = decimals < 0 ? std::round(value / unit) * unit : value;
  const std::string text = Format("%.*f", std::max(0, decimals), std::abs(rounded));
  const bool isZero = text.find_first_not_of("0.") == std::string::npos;
  return (value < 0 && !isZero ? "−" : "") + text;
}

std::string WithSign(const std::string& number) {
  const bool isZero = number.find_first_not_of("0.") == std::string::npos;
  return (isZero || number.starts_with("−") ? "" : "+") + number;
}

std::string WithError(const std::string& value, const std::string& error) {
  return error.empty() ? value : value + " ± " + error;
}

// Returns the decimals at which both numbers are rounded.
int CommonDecimals(const Measured& m) {
  constexpr int kMostDigits = 5;
  int place = Magnitude(m.error);
  if (std::round(m.error / std::pow(10., place)) >= 10) ++place;
  if (m.value != 0) place = std::max(place, Magnitude(std::abs(m.value)) - (kMostDigits - 1));
  return -place;
}

}  // namespace

std::string SecondsText(double seconds) {
  if (seconds < 9.95) return Format("%.2g s", seconds);
  if (seconds < 99.5) return Format("%.0f s", seconds);
  if (seconds < 5940) return Format("%.1f min", seconds / 60);
  return Format("%.1f h", seconds / 3600);
}

std::string Superscript(int number) {
  constexpr const char* kDigits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text;
  for (const char c : std::to_string(number)) text += c == '-' ? "⁻" : kDigits[c - '0'];
  return text;
}

std::string ShortNumber(double value, int digits) {
  if (!std::isfinite(value)) return "–";
  if (value < 0) return "−" + ShortNumber(-value, digits);
  if (value == 0) return "0";
  const bool isPlain = value >= .9995e-3 && value < 1e5;
  const int power = isPlain ? 0 : Magnitude(value);
  const double mantissa = isPlain ? value : value / std::pow(10., power);
  std::string text = Format("%.*f", std::max(0, digits - 1 - Magnitude(mantissa)), mantissa);
  if (text.find('.') != std::string::npos) {
    while (text.back() == '0') text.pop_back();
    if (text.back() == '.') text.pop_back();
  }
  return isPlain ? text : text + "×10" + Superscript(power);
}

std::string CountText(double count) {
  if (count >= 1e6) return ShortNumber(count / 1e6, 3) + " M";
  if (count >= 1e4) return ShortNumber(count / 1e3, 3) + " k";
  return ShortNumber(count, 6);
}

RoundedPair RoundTogether(const Measured& m) {
  if (!m.IsKnown()) return {"–", ""};
  if (!std::isfinite(m.error)) return {ShortNumber(m.value, 3), ""};
  if (m.error <= 0) return {ShortNumber(m.value, 3), "0"};
  const int decimals = CommonDecimals(m);
  const std::string error = Fixed(m.error, decimals);
  const bool isZero = error.find_first_not_of("0.") == std::string::npos;
  return {Fixed(m.value, decimals), isZero ? "0" : error};
}

std::string MeasuredText(const Measured& m) {
  const RoundedPair pair = RoundTogether(m);
  return WithError(pair.value, pair.error);
}

std::string ChangeText(const Measured& factor) {
  if (!factor.IsKnown()) return "–";
  if (!std::isfinite(factor.error)) return WithSign(Fixed(100 * (factor.value - 1), 0)) + " %";
  const RoundedPair pair = RoundTogether({100 * (factor.value - 1), 100 * factor.error});
  return WithError(WithSign(pair.value), pair.error) + " %";
}

std::string SignedSecondsText(const Measured& seconds) {
  const RoundedPair pair = RoundTogether(seconds);
  return seconds.IsKnown() ? WithError(WithSign(pair.value), pair.error) + " s" : pair.value;
}

std::string ShareText(double share) {
  if (!(share > 0)) return ShortNumber(share);
  constexpr double kSmall = 1 / 4.5;
  if (share > kSmall) return Format("%.0f %%", 100 * share);
  const double whole = 1 / share;
  const double unit = std::pow(10., std::max(0, Magnitude(whole) - 1));
  return Format("1/%.0f", std::round(whole / unit) * unit);
}

}  // namespace exphoton::study
