// SPDX-License-Identifier: BSD-2-Clause
#include "core/parser/frame_name.h"

#include <algorithm>
#include <cctype>
#include <functional>

namespace exphoton {
namespace {

// NumberPlace is a "%d" or "%0Wd" in a name.
struct NumberPlace {
  std::size_t begin, length;  // length 0: there is none
  std::size_t width;          // least number of digits
};

NumberPlace FindNumberPlace(const std::string& name, std::size_t from) {
  for (std::size_t begin; (begin = name.find('%', from)) != std::string::npos; from = begin + 1) {
    const auto at = [&](std::size_t i) { return begin + i < name.size() ? name[begin + i] : '\0'; };
    if (at(1) == 'd') return {begin, 2, 1};
    if (at(1) == '0' && std::isdigit(static_cast<unsigned char>(at(2))) && at(3) == 'd')
      return {begin, 4, std::size_t(at(2) - '0')};
  }
  return {std::string::npos, 0, 0};
}

// Replaces each place by replacement(place), and the text between places by between(text).
template <class Replacement, class Between>
std::string Replace(const std::string& name, const Replacement& replacement,
                    const Between& between) {
  std::string text;
  std::size_t from = 0;
  for (NumberPlace place; (place = FindNumberPlace(name, from)).length > 0;
       from = place.begin + place.length)
    text += between(name.substr(from, place.begin - from)) + replacement(place);
  return text + between(name.substr(from));
}

}  // namespace

bool HasFrameNumber(const std::string& name) { return FindNumberPlace(name, 0).length > 0; }

std::string FrameName(const std::string& name, int frame) {
  const std::string digits = std::to_string(frame);
  return Replace(
      name,
      [&](const NumberPlace& place) {
        return std::string(place.width - std::min(place.width, digits.size()), '0') + digits;
      },
      std::identity());
}

std::string NameWithoutNumber(const std::string& name) {
  return Replace(
      name, [](const NumberPlace&) { return std::string(); }, std::identity());
}

std::string FrameFormat(const std::string& name) {
  const auto doubled = [](const std::string& text) {
    std::string format;
    for (const char c : text) format += c == '%' ? std::string("%%") : std::string(1, c);
    return format;
  };
  return Replace(
      name, [&](const NumberPlace& place) { return name.substr(place.begin, place.length); },
      doubled);
}

}  // namespace exphoton
