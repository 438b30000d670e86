// SPDX-License-Identifier: BSD-2-Clause
// Format is std::snprintf into a std::string. Texts longer than 511 characters are cut. Plain
// writes a number without an exponent. Counted puts a number before a noun.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace exphoton {

template <class... Args>
std::string Format(const char* format, Args... args) {
  char text[512];
  std::snprintf(text, sizeof text, format, args...);
  return text;
}

// Returns the number with this many significant digits, such as "110" or "0.00012". Numbers below
// 10^-6 become "0".
inline std::string Plain(double value, int digits) {
  if (std::abs(value) < 1e-6) return "0";
  const std::string shortest = Format("%.*g", digits, value);
  if (shortest.find('e') == std::string::npos) return shortest;
  const double rounded = std::strtod(shortest.c_str(), nullptr);
  if (std::abs(rounded) >= 1) return Format("%.0f", rounded);
  std::string text =
      Format("%.*f", digits - 1 - int(std::floor(std::log10(std::abs(value)))), rounded);
  return text.substr(0, text.find_last_not_of('0') + 1);
}

// Returns "1 sample" or "4 samples" for the noun "sample".
inline std::string Counted(std::int64_t count, const std::string& noun) {
  return std::to_string(count) + ' ' + noun + (count == 1 ? "" : "s");
}

}  // namespace exphoton
