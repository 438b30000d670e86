// SPDX-License-Identifier: BSD-2-Clause
// FilmParameters holds the parameters of Film "image". The core makes the film itself, without a
// plugin, so this file declares the parameter table.
#pragma once

#include "core/imaging/film/film.h"
#include "core/params/param_table.h"

namespace exphoton {

struct FilmParameters : FilmSettings {
  bool display = false;   // of version 2
  void Validate() const;  // throws ParamError
};

const ParamTable<FilmParameters>& FilmParameterTable();

// Returns the problem with a crop window x0 x1 y0 y1, or "" if the window is valid.
std::string CheckCropWindow(const std::vector<Real>& window);

}  // namespace exphoton
