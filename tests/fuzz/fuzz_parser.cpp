// SPDX-License-Identifier: BSD-2-Clause
// fuzz_parser checks that any text gives directives or an error, and that reading which goes on
// after errors ends. The text may include itself and a harmless file.
#include "core/base/log.h"
#include "core/parser/syntax/parser.h"
#include "tests/fuzz/input.h"

using namespace exphoton;

namespace {

class Nothing final : public DirectiveHandler {
 public:
  explicit Nothing(bool keepsErrors) : keepsErrors_(keepsErrors) {}
  bool Keep(const Error&) override { return keepsErrors_; }
  void Handle(Directive) override {}
  void Finish(const SourceLocation&) override {}

 private:
  bool keepsErrors_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  MemorySource source({{"scene.pbrt", std::string(reinterpret_cast<const char*>(data), size)},
                       {"part.pbrt", "Identity Translate 1 2 3\n"}});
  Log log(Log::Level::Normal, Log::Sink::Memory);
  for (const bool keepsErrors : {false, true}) {
    Nothing nothing(keepsErrors);
    try {
      ParseScene(source, "scene.pbrt", nothing, log);
    } catch (const Error& error) {
      fuzz::Require(error.Status() == ExitStatus::Scene || error.Status() == ExitStatus::File,
                    "a wrong text is the scene's error");
    }
  }
  return 0;
}
