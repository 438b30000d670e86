// SPDX-License-Identifier: BSD-2-Clause
// This plugin for the loader's tests is faulty on purpose. It calls a function that is not defined.
#include "core/plugin.h"

extern "C" const exphoton::PluginDescriptor* NowhereToBeFound();

extern "C" __attribute__((visibility("default"))) const exphoton::PluginDescriptor*
ExphotonPlugin() {
  return NowhereToBeFound();
}
