// SPDX-License-Identifier: BSD-2-Clause
// This plugin for the loader's tests is faulty on purpose. Its build tag names another compiler.
#include "core/plugin.h"

extern "C" __attribute__((visibility("default"))) const exphoton::PluginDescriptor*
ExphotonPlugin() {
  static const exphoton::PluginDescriptor descriptor{
      exphoton::kPluginAbi, "exphoton 1, 3.2.1, float", "wrong_build", "old", {}};
  return &descriptor;
}
