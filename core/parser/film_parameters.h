// SPDX-License-Identifier: BSD-2-Clause
// The parameters of Film "image". The film is part of the core and no plugin, so its table stands
// here.
#pragma once

#include "core/imaging/film/film.h"
#include "core/params/param_table.h"

namespace exphoton {

struct FilmParameters : FilmSettings {
  void Validate() const;  // throws ParamError
};

const ParamTable<FilmParameters>& FilmParameterTable();

// What is wrong with a crop window x0 x1 y0 y1; "" for a good one.
std::string CheckCropWindow(const std::vector<Real>& window);

}  // namespace exphoton
