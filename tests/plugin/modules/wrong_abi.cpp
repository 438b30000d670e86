// SPDX-License-Identifier: BSD-2-Clause
// This plugin for the loader's tests is faulty on purpose. It states a version of the plugin
// interface that does not exist yet.
#include "core/plugin.h"

extern "C" __attribute__((visibility("default"))) const exphoton::PluginDescriptor*
ExphotonPlugin() {
  static const exphoton::PluginDescriptor descriptor{
      exphoton::kPluginAbi + 6, nullptr, nullptr, nullptr, {}};
  return &descriptor;
}
