// SPDX-License-Identifier: BSD-2-Clause
// `exphoton info --photons-at x,y SCENE` prints the photons around the surface point of a pixel.
#pragma once

#include <string>
#include <vector>

namespace exphoton::cli {

// `arguments` exclude the names of the program and the command. Throws Error and TextRequest.
void PrintPhotonsAt(const std::vector<std::string>& arguments);

}  // namespace exphoton::cli
