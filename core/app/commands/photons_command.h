// SPDX-License-Identifier: BSD-2-Clause
// `exphoton info --photons-at x,y SCENE`: the photons around the surface point that a pixel shows.
#pragma once

#include <string>
#include <vector>

namespace exphoton::cli {

// `arguments` without the program's and the command's name. Throws as ParseArguments and
// LoadScenes.
void PrintPhotonsAt(const std::vector<std::string>& arguments);

}  // namespace exphoton::cli
