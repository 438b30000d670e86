// SPDX-License-Identifier: BSD-2-Clause
// CommandOutputs runs the commands of commands.txt with the built program, in an empty folder, and
// collects what they print and write as one text without times, folders and versions.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace exphoton::recorded {

// The text of one command: the command itself, then what it printed.
struct CommandOutput {
  std::string command;
  std::vector<std::string> lines;
};

// Runs the commands of tests/recorded/commands.txt in their order, until goesOn, which gets each
// output, returns false.
std::vector<CommandOutput> CommandOutputs(
    const std::function<bool(const CommandOutput&)>& goesOn = {});

// The file of all outputs, tests/recorded/records/outputs.txt.
std::string OutputsPath();
std::string OutputsText(const std::vector<CommandOutput>& outputs);
std::vector<CommandOutput> ReadOutputs();

}  // namespace exphoton::recorded
