// SPDX-License-Identifier: BSD-2-Clause
// parsing measures the conversion of scene text to directives, for a mesh in the style of
// exporters. The opponent only reads the same numbers with strtod.
#include <cstdio>
#include <cstdlib>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>

#include "core/base/log.h"
#include "core/parser/syntax/parser.h"
#include "core/parser/syntax/source.h"
#include "tests/benchmark/contest.h"
#include "tests/benchmark/parts.h"
#include "tests/benchmark/rooms/room.h"

namespace exphoton {
namespace {

constexpr int kRounds = 11;

class Counting final : public DirectiveHandler {
 public:
  void Handle(Directive) override { ++count; }
  void Finish(const SourceLocation&) override {}
  int count = 0;
};

// Returns the mesh of a room as text: nine coordinates per triangle with six digits each, and
// indices.
std::string MeshText(std::size_t triangles) {
  const auto room = BenchmarkRoom(triangles);
  std::string text = "WorldBegin\nShape \"trianglemesh\" \"integer indices\" [";
  char word[64];
  for (std::uint32_t i = 0; i < 3 * room->TriangleCount(); ++i) {
    std::snprintf(word, sizeof word, "%u%c", i, i % 12 == 11 ? '\n' : ' ');
    text += word;
  }
  text += "]\n\"point P\" [";
  for (std::uint32_t i = 0; i < room->TriangleCount(); ++i)
    for (const Point3& p : room->TriangleVertices(i)) {
      std::snprintf(word, sizeof word, "%.6g %.6g %.6g\n", double(p.x), double(p.y), double(p.z));
      text += word;
    }
  return text + "]\nWorldEnd\n";
}

double SumOfNumbers(const std::string& text) {
  double sum = 0;
  for (const char* at = text.c_str(); *at;) {
    char* end = nullptr;
    sum += std::strtod(at, &end);
    at = end == at ? at + 1 : end;
  }
  return sum;
}

Contest Parse() {
  const std::string text = MeshText(200000);
  auto source =
      std::make_shared<MemorySource>(std::map<std::string, std::string>{{"mesh.pbrt", text}});
  return {double(text.size()) * 1e-6,
          "MB",
          {{"exphoton",
            [=] {
              Log log(Log::Level::Normal, Log::Sink::Memory);
              Counting counting;
              ParseScene(*source, "mesh.pbrt", counting, log);
              if (counting.count != 3) throw std::logic_error("directives are missing");
            }},
           {"strtod",
            [=] {
              if (!(SumOfNumbers(text) > 0)) throw std::logic_error("no numbers");
            }}},
          Clock::Thread};
}

}  // namespace

void AddParsing() { AddContest("parsing/mesh", kRounds, Parse); }

}  // namespace exphoton
