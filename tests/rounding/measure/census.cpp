// SPDX-License-Identifier: BSD-2-Clause
// The census asks addr2line for all addresses at once.
#include "tests/rounding/measure/census.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>

#include "tests/support/process.h"

extern "C" const char __executable_start;  // of the linker

namespace exphoton::rounding {
namespace {

// Headers whose lines say nothing about the place.
constexpr const char* kHelpers[] = {"core/math/vec.h",
                                    "core/math/real.h",
                                    "core/math/spectrum.h",
                                    "core/math/simd/",
                                    "core/geometry/vec3d.h",
                                    "/usr/",
                                    "??"};

std::string Shorter(const std::string& line) {
  const std::string top = std::string(EXPHOTON_SOURCE_DIR) + "/";
  std::string place = line.starts_with(top) ? line.substr(top.size()) : line;
  return place.substr(0, place.find(' '));  // " (discriminator 2)"
}

// Returns the frames of each address, the innermost first.
std::vector<std::vector<std::string>> FramesOf(const std::vector<Cancellations>& places) {
  const TestFolder folder;
  std::ostringstream addresses;
  for (const Cancellations& each : places)
    addresses << std::hex << each.address - std::uintptr_t(&__executable_start) - 1 << '\n';
  WriteFile(folder.File("addresses"), addresses.str());
  ProcessCommand command;
  command.folder = folder.Path();
  command.words = {"/bin/sh", "-c", "addr2line -a -i -e \"$0\" @addresses",
                   std::filesystem::read_symlink("/proc/self/exe").string()};
  command.timeLimit = 300;
  const ProcessResult outcome = RunProcess(command);
  if (outcome.status != 0) throw std::runtime_error("addr2line: " + outcome.err);
  std::vector<std::vector<std::string>> frames;
  std::istringstream lines(outcome.out);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("0x"))
      frames.emplace_back();
    else
      frames.back().push_back(line);
  }
  if (frames.size() != places.size()) throw std::runtime_error("addr2line left addresses out");
  return frames;
}

}  // namespace

std::string PlaceOf(const std::vector<std::string>& frames) {
  for (const std::string& frame : frames) {
    const std::string place = Shorter(frame);
    const bool isHelper = std::any_of(std::begin(kHelpers), std::end(kHelpers),
                                      [&](const char* name) { return place.starts_with(name); });
    if (!isHelper) return place;
  }
  return frames.empty() ? "unknown" : Shorter(frames.front());
}

std::vector<CensusLine> ByLine(const std::vector<Cancellations>& places) {
  const auto frames = FramesOf(places);
  std::map<std::string, CensusLine> lines;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const std::string place = PlaceOf(frames[i]);
    CensusLine& line = lines[place];
    line.place = place;
    line.count += places[i].count;
    line.zeros += places[i].zeros;
    line.bits += places[i].bits;
  }
  std::vector<CensusLine> sorted;
  for (const auto& [place, line] : lines) sorted.push_back(line);
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const CensusLine& a, const CensusLine& b) { return a.bits > b.bits; });
  return sorted;
}

std::string TextOf(const std::vector<CensusLine>& lines, std::size_t most) {
  std::string text =
      "| line | cancellations | mean bits lost | results of 0 |\n| --- | --- | --- | --- |\n";
  for (std::size_t i = 0; i < std::min(most, lines.size()); ++i) {
    char row[300];
    std::snprintf(row, sizeof row, "| `%s` | %llu | %.1f | %llu |\n", lines[i].place.c_str(),
                  static_cast<unsigned long long>(lines[i].count),
                  lines[i].count == 0 ? 0 : lines[i].bits / double(lines[i].count),
                  static_cast<unsigned long long>(lines[i].zeros));
    text += row;
  }
  return text;
}

}  // namespace exphoton::rounding
