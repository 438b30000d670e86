// SPDX-License-Identifier: BSD-2-Clause
#include "core/parser/scene_hash.h"

#include <bit>
#include <cstring>

#include "core/base/mix_bits.h"

namespace exphoton {
namespace {

std::uint64_t MixText(std::uint64_t hash, std::string_view text) {
  hash = MixWord(hash, text.size());
  for (; !text.empty(); text.remove_prefix(std::min<std::size_t>(8, text.size()))) {
    std::uint64_t word = 0;
    std::memcpy(&word, text.data(), std::min<std::size_t>(8, text.size()));
    hash = MixWord(hash, word);
  }
  return hash;
}

std::uint64_t MixNumbers(std::uint64_t hash, const std::vector<double>& numbers) {
  hash = MixWord(hash, numbers.size());
  for (const double number : numbers) hash = MixWord(hash, std::bit_cast<std::uint64_t>(number));
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
    for (const auto value : row) hash = MixWord(hash, std::bit_cast<std::uint64_t>(double(value)));
  return hash;
}

}  // namespace exphoton
