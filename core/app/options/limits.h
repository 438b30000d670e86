// SPDX-License-Identifier: BSD-2-Clause
// Limits holds the values of --limits: bounds on the memory and time that input files may cost, and
// on the totals that a scene may request. They protect against files from untrusted sources.
#pragma once

#include <optional>
#include <string>

#include "core/parser/syntax/scene_limits.h"

namespace exphoton::cli {

class OptionParser;

struct Limits {
  std::optional<double> memoryBytes;
  std::optional<double> seconds;  // until the first pixel; for commands without rendering, in total
  SceneLimits scene;
};

// "memory=2G,time=60s,includes=1000000,texturenodes=10000000". Throws Error(CommandLine).
Limits ParseLimits(const std::string& text);

// Limits the memory of this process and its children. Throws Error(Resource).
void LimitMemory(const Limits& limits);

// Declares the option --limits, as text for ParseLimits.
void AddLimitsOption(OptionParser& app, std::string* text);

// Declares --allow-scene-plugins.
void AddScenePluginsOption(OptionParser& app, bool* allows);

}  // namespace exphoton::cli
