// SPDX-License-Identifier: BSD-2-Clause
// The hash mixes one 64-bit word at a time with the finalizer of SplitMix64 (Steele, Lea and Flood
// 2014).
#include "core/parser/scene_hash.h"

#include <bit>
#include <cstring>

namespace exphoton {
namespace {

std::uint64_t Mix(std::uint64_t hash, std::uint64_t word) {
  std::uint64_t x = (hash ^ word) + 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

std::uint64_t MixText(std::uint64_t hash, std::string_view text) {
  hash = Mix(hash, text.size());
  for (; !text.empty(); text.remove_prefix(std::min<std::size_t>(8, text.size()))) {
    std::uint64_t word = 0;
    std::memcpy(&word, text.data(), std::min<std::size_t>(8, text.size()));
    hash = Mix(hash, word);
  }
  return hash;
}

std::uint64_t MixNumbers(std::uint64_t hash, const std::vector<double>& numbers) {
  hash = Mix(hash, numbers.size());
  for (const double number : numbers) hash = Mix(hash, std::bit_cast<std::uint64_t>(number));
  return hash;
}

}  // namespace

std::uint64_t HashDirective(std::uint64_t hash, const Directive& directive) {
  hash = MixNumbers(MixText(hash, directive.spec->name), directive.numbers);
  for (const std::string& text : directive.strings) hash = MixText(hash, text);
  for (const ParsedParam& param : directive.params.All()) {
    hash = MixNumbers(MixText(MixText(hash, param.type), param.name), param.numbers);
    for (const std::string& text : param.strings) hash = MixText(hash, text);
  }
  return hash;
}

std::uint64_t HashTransform(std::uint64_t hash, const Transform& transform) {
  for (const auto& row : transform.Matrix().m)
    for (const auto value : row) hash = Mix(hash, std::bit_cast<std::uint64_t>(double(value)));
  return hash;
}

}  // namespace exphoton
