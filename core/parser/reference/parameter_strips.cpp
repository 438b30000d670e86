// SPDX-License-Identifier: BSD-2-Clause
#include "core/parser/reference/parameter_strips.h"

namespace exphoton {
namespace {

constexpr ParameterStrip kStrips[] = {
    {PluginKind::Shape, "loopsubdiv", "nlevels", "0 1 2 3 4"},

    {PluginKind::Light, "spot", "coneangle", "8 14 20 30 50"},
    {PluginKind::Light, "spot", "conedeltaangle", "0 4 8 14 20"},

    {PluginKind::Material, "matte", "sigma", "0 15 30 50 80"},
    {PluginKind::Material, "matte", "bumpmap", "0 .05 .1 .2 .4"},
    {PluginKind::Material, "metal", "roughness", ".002 .01 .05 .15 .5"},
    {PluginKind::Material, "shinymetal", "roughness", ".002 .01 .05 .15 .5"},
    {PluginKind::Material, "plastic", "roughness", ".002 .01 .05 .15 .5"},
    {PluginKind::Material, "plastic", "Ks", "0 .1 .3 .6 1"},
    {PluginKind::Material, "substrate", "uroughness", ".005 .02 .05 .2 .8"},
    {PluginKind::Material, "translucent", "transmit", "0 .25 .5 .75 1"},
    {PluginKind::Material, "uber", "opacity", "1 .75 .5 .25 .05"},
    {PluginKind::Material, "glass", "index", "1.02 1.1 1.33 1.5 2.4"},
    {PluginKind::Material, "mix", "amount", "0 .25 .5 .75 1"},

    {PluginKind::FloatTexture, "fbm", "octaves", "1 2 3 5 8"},
    {PluginKind::FloatTexture, "fbm", "roughness", ".2 .3 .4 .5 .6"},
    {PluginKind::FloatTexture, "wrinkled", "octaves", "1 2 3 5 8"},
    {PluginKind::FloatTexture, "wrinkled", "roughness", ".2 .3 .4 .5 .6"},
    {PluginKind::ColorTexture, "marble", "variation", "0 .1 .2 .5 1"},
    {PluginKind::ColorTexture, "marble", "scale", ".5 1 2 4 8"},
    {PluginKind::ColorTexture, "checkerboard", "uscale", "1 2 4 8 16"},
    {PluginKind::ColorTexture, "checkerboard", "aamode", "closedform supersample none"},
    {PluginKind::ColorTexture, "dots", "uscale", "2 4 8 16 32"},
    {PluginKind::ColorTexture, "imagemap", "mapping", "uv spherical cylindrical planar"},
    {PluginKind::ColorTexture, "imagemap", "wrap", "repeat black clamp"},
    {PluginKind::ColorTexture, "imagemap", "gamma", ".5 1 1.5 2.2 3"},

    {PluginKind::Filter, "box", "xwidth", ".25 .5 1 2 4"},
    {PluginKind::Filter, "triangle", "xwidth", ".5 1 2 3 4"},
    {PluginKind::Filter, "gaussian", "alpha", "8 4 2 1 .3"},
    {PluginKind::Filter, "mitchell", "B", "0 .25 .5 .75 1"},
    {PluginKind::Filter, "mitchell", "C", "0 .25 .5 .75 1"},
    {PluginKind::Filter, "sinc", "tau", ".5 1 2 3 6"},

    {PluginKind::Camera, "perspective", "fov", "15 30 45 70 100"},
    {PluginKind::Camera, "perspective", "lensradius", "0 .05 .1 .2 .4"},
    {PluginKind::Camera, "perspective", "focaldistance", "3 4 5.7 8 20"},
    {PluginKind::Camera, "perspective", "shutterclose", "0 .1 .3 .6 1"},

    {PluginKind::Volume, "homogeneous", "sigma_s", "0 .02 .05 .1 .2"},
    {PluginKind::Volume, "homogeneous", "sigma_a", "0 .05 .1 .2 .4"},
    {PluginKind::Volume, "homogeneous", "g", "-.7 -.35 0 .35 .7"},
    {PluginKind::Volume, "exponential", "b", "0 .5 1 2 4"},
};

}  // namespace

std::string ParameterStrip::Page() const { return std::string(PluginKindFolder(kind)) + ".md"; }

std::string ParameterStrip::Name() const {
  return std::string(PluginKindFolder(kind)) + '/' + plugin + '-' + parameter;
}

std::span<const ParameterStrip> ParameterStrips() { return kStrips; }

}  // namespace exphoton
