// SPDX-License-Identifier: BSD-2-Clause
// fuzz_tokenizer checks that any bytes give tokens or an error, and that numbers are finite.
#include <cmath>

#include "core/parser/syntax/tokenizer.h"
#include "tests/fuzz/input.h"

using namespace exphoton;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  MemorySource source({{"scene.pbrt", std::string(reinterpret_cast<const char*>(data), size)}});
  try {
    Tokenizer tokenizer(source, "scene.pbrt");
    for (Token token = tokenizer.Next(); token.kind != TokenKind::End; token = tokenizer.Next()) {
      if (token.kind == TokenKind::Number) fuzz::Require(std::isfinite(token.number), "finite");
      fuzz::Require(token.text.size() <= Tokenizer::kMaxStringBytes, "bounded strings");
      tokenizer.Locate(token.position);
    }
  } catch (const Error& error) {
    fuzz::Require(*error.what() != 0, "an error has words");
  }
  return 0;
}
