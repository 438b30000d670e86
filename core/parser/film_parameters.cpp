// SPDX-License-Identifier: BSD-2-Clause
// FilmParameterTable has the names and defaults of Film "image" in pbrt version 1.
#include "core/parser/film_parameters.h"

namespace exphoton {
namespace {

constexpr int kMaxResolution = 1 << 24;

// Declares a parameter for a member that FilmParameters inherits from FilmSettings.
template <class T>
Param<FilmParameters, T> FilmParam(const char* name, T FilmSettings::*member, const char* doc) {
  return {name, member, doc};
}

}  // namespace

const ParamTable<FilmParameters>& FilmParameterTable() {
  static const ParamTable<FilmParameters> table{
      FilmParam("filename", &FilmSettings::filename,
                "the picture's file; relative to the folder "
                "in which the program runs"),
      FilmParam("premultiplyalpha", &FilmSettings::premultiplyAlpha,
                "colours are multiplied by alpha"),
      FilmParam("xresolution", &FilmSettings::xResolution, "width of the full picture")
          .Range(1, kMaxResolution)
          .Unit("pixels"),
      FilmParam("yresolution", &FilmSettings::yResolution, "height of the full picture")
          .Range(1, kMaxResolution)
          .Unit("pixels"),
      FilmParam("cropwindow", &FilmSettings::cropWindow,
                "the part that is rendered: x0 x1 y0 y1 as fractions of the full picture")
          .Range(0, 1),
      FilmParam("writefrequency", &FilmSettings::writeFrequency,
                "the picture is written when it is complete")
          .Ignored(),
      Param("display", &FilmParameters::display, "version 2 shows the picture in a window")
          .Ignored(),
  };
  return table;
}

void FilmParameters::Validate() const {
  if (!cropWindow) return;
  if (const std::string problem = CheckCropWindow(*cropWindow); !problem.empty())
    throw ParamError{"cropwindow", problem, ""};
}

std::string CheckCropWindow(const std::vector<Real>& window) {
  if (window.size() != 4)
    return "must be four numbers: x0 x1 y0 y1, not " + std::to_string(window.size());
  for (const Real value : window)
    if (!(value >= 0 && value <= 1)) return "must lie between 0 and 1";
  if (!(window[0] < window[1])) return "is empty or reversed: x0 must be below x1";
  if (!(window[2] < window[3])) return "is empty or reversed: y0 must be below y1";
  return "";
}

}  // namespace exphoton
