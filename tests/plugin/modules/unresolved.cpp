// SPDX-License-Identifier: BSD-2-Clause
// A faulty plugin for the loader's tests: it calls a function that is nowhere.
#include "core/plugin.h"

extern "C" const exphoton::PluginDescriptor* NowhereToBeFound();

extern "C" __attribute__((visibility("default"))) const exphoton::PluginDescriptor*
ExphotonPlugin() {
  return NowhereToBeFound();
}
