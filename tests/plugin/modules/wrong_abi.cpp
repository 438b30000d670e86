// SPDX-License-Identifier: BSD-2-Clause
// A faulty plugin for the loader's tests: built for an interface that there is not yet.
#include "core/plugin.h"

extern "C" __attribute__((visibility("default"))) const exphoton::PluginDescriptor*
ExphotonPlugin() {
  static const exphoton::PluginDescriptor descriptor{
      exphoton::kPluginAbi + 6, nullptr, nullptr, nullptr, {}};
  return &descriptor;
}
