// SPDX-License-Identifier: BSD-2-Clause
// The system enforces the memory limit (RLIMIT_DATA bounds the process's writable memory).
// InterruptWatch enforces the time limit.
#include "core/app/options/limits.h"

#include <sys/resource.h>

#include <cerrno>
#include <charconv>
#include <cstring>
#include <sstream>

#include "core/app/options/option_parser.h"
#include "core/app/options/values.h"
#include "core/base/error.h"

namespace exphoton::cli {
namespace {

constexpr const char* kForm =
    "--limits takes memory=SIZE, time=TIME, includes=N and texturenodes=N, for example "
    "memory=2G,time=60s, not \"";

double ParseBytes(const std::string& text) {
  double value = 0;
  const char* const end = text.data() + text.size();
  const auto [next, error] = std::from_chars(text.data(), end, value);
  const std::string unit(next, std::size_t(end - next));
  const double scale = unit == "M" ? 0x1p20 : unit == "G" ? 0x1p30 : unit == "T" ? 0x1p40 : 0;
  value *= scale;
  if (error != std::errc{} || !(value >= 0x1p20 && value < 0x1p60))
    FailUsage("--limits memory takes a size such as 500M or 2G, not \"" + text + '"');
  return value;
}

std::int64_t ParseCount(const std::string& name, const std::string& text) {
  std::int64_t value = 0;
  const char* const end = text.data() + text.size();
  const auto [next, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || next != end || value < 1)
    FailUsage("--limits " + name + " takes a whole number above 0, not \"" + text + '"');
  return value;
}

}  // namespace

Limits ParseLimits(const std::string& text) {
  Limits limits;
  std::istringstream parts(text);
  for (std::string part; std::getline(parts, part, ',');) {
    const std::size_t equals = part.find('=');
    const std::string name = part.substr(0, equals);
    if (equals == std::string::npos) FailUsage(kForm + text + '"');
    const std::string value = part.substr(equals + 1);
    if (name == "memory")
      limits.memoryBytes = ParseBytes(value);
    else if (name == "time")
      limits.seconds = ParseDuration("--limits time", value);
    else if (name == "includes")
      limits.scene.includes = ParseCount(name, value);
    else if (name == "texturenodes")
      limits.scene.textureNodes = ParseCount(name, value);
    else
      FailUsage(kForm + text + '"');
  }
  return limits;
}

void LimitMemory(const Limits& limits) {
  if (!limits.memoryBytes) return;
  rlimit limit{};
  getrlimit(RLIMIT_DATA, &limit);
  const auto bytes = rlim_t(*limits.memoryBytes);
  if (limit.rlim_cur <= bytes) return;  // the current limit is already lower
  limit.rlim_cur = bytes;
  if (setrlimit(RLIMIT_DATA, &limit) != 0)
    throw Error(ExitStatus::Resource, std::string("cannot limit memory: ") + std::strerror(errno));
}

void AddLimitsOption(OptionParser& app, std::string* text) {
  app.Add("--limits", *text,
          "limits for scene files: memory=SIZE, time=TIME until the first pixel, includes=N, "
          "texturenodes=N a lookup; separated by commas")
      .TakeLast()
      .TypeName("LIST");
}

void AddScenePluginsOption(OptionParser& app, bool* allows) {
  app.AddFlag("--allow-scene-plugins", *allows,
              "load plugins (native code) from folders that a scene file names, too");
}

}  // namespace exphoton::cli
