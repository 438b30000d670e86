# SPDX-License-Identifier: BSD-2-Clause
"""The strips of textures."""
from strips.stage import COARSE, SCENES, STAGE, color, square

BUMPY = '''LookAt 0 0 -2  0 0 0  0 1 0
Camera "orthographic" "float screenwindow" [ -.98 .98 -.98 .98 ]
WorldBegin
LightSource "distant" "point from" [ -1 .8 -.7 ] "color L" [ 2.6 2.5 2.3 ]
LightSource "distant" "point from" [ 0 0 -1 ] "color L" [ .4 .45 .55 ]
TransformBegin Scale .5 .5 .5 Texture "f" "float" %s TransformEnd
Texture "height" "float" "scale" "texture tex1" "f" "float tex2" .12
Material "matte" "color Kd" [ .7 .66 .6 ] "texture bumpmap" "height"
Shape "trianglemesh" "integer indices" [ 0 1 2 0 2 3 ]
  "point P" [ -1 -1 0  1 -1 0  1 1 0  -1 1 0 ] "float uv" [ 0 1 1 1 1 0 0 0 ]
WorldEnd
'''
IMAGE = '"string filename" "%s/parts/painting.png"' % SCENES
MARBLE = 'TransformBegin Scale .35 .35 .35 Rotate 30 0 0 1 Texture "t" "color" "marble" %s TransformEnd'
MIX = '''Texture "f" "float" "bilerp" "float v00" 0 "float v01" 1 "float v10" 0 "float v11" 1
Texture "t" "color" "mix" "color tex1" %s "color tex2" %s %s'''
BLUE = '"color tex1" [ .75 .65 .4 ] "color tex2" [ .08 .16 .3 ]'


def floor(texture):
    return ('PixelFilter "box"\nLookAt 0 .35 -3  0 -.45 0  0 1 0\nCamera "perspective" "float fov" 50\n'
            'WorldBegin\nLightSource "distant" "point from" [ 0 1 0 ] "color L" [ 3 3 3 ]\n' + texture +
            '\nMaterial "matte" "texture Kd" "t"\n'
            'Rotate 90 1 0 0 Shape "trianglemesh" "integer indices" [ 0 1 2 0 2 3 ]\n'
            '"point P" [ -9 -4 0  9 -4 0  9 40 0  -9 40 0 ] "float uv" [ 0 11 9 11 9 0 0 0 ]\nWorldEnd\n')


def checked(parameters):
    return square('Texture "t" "color" "checkerboard" %s %s' % (parameters, BLUE))


def corner(name):
    """A function of a value: a square with the value at one corner and a shade at the others."""
    others = ' '.join('"color %s" [ .1 .14 .2 ]' % v for v in ("v00", "v01", "v10", "v11") if v != name)
    return lambda x: square('Texture "t" "color" "bilerp" %s "color %s" %s' % (others, name, color(x)))


def filled(name, parameters, other):
    """A function of a value: a square of a texture with the value for one of its two colors."""
    return lambda x: square('Texture "t" "color" %s "color %s" %s "color %s" [ .08 .16 .3 ]'
                            % (parameters, name, color(x), other))


def planar(name, other):
    return lambda x: square('Texture "t" "color" "checkerboard" "string mapping" "planar" '
                            '"vector %s" [ %s ] "vector %s %s' % (name, x, other, BLUE))


def veined(parameters):
    """A square of marble in dim light, for contrast."""
    texture = MARBLE % ('"float variation" 1 "float scale" 2 ' + parameters)
    return square(texture).replace("[ 3 3 3 ]", "[ 1 1 1 ]")


STRIPS = {
    "fbm-octaves": ("1 2 3 5 8", lambda x: BUMPY % ('"fbm" "integer octaves" ' + x)),
    "fbm-roughness": (".2 .3 .4 .5 .6", lambda x: BUMPY % ('"fbm" "float roughness" ' + x)),
    "wrinkled-octaves": ("1 2 3 5 8", lambda x: BUMPY % ('"wrinkled" "integer octaves" ' + x)),
    "wrinkled-roughness": (".2 .3 .4 .5 .6", lambda x: BUMPY % ('"wrinkled" "float roughness" ' + x)),
    "marble-variation": ("0 .1 .2 .5 1", lambda x: square(MARBLE % ('"float variation" ' + x))),
    "marble-scale": (".5 1 2 4 8", lambda x: square(MARBLE % ('"float scale" ' + x))),
    "checkerboard-uscale": ("1 2 4 8 16", lambda x: square(
        'Texture "t" "color" "checkerboard" "float vscale" 4 "float uscale" %s %s' % (x, BLUE))),
    "checkerboard-aamode": ("closedform supersample none", lambda x: COARSE + floor(
        'Texture "t" "color" "checkerboard" "float uscale" 2 "float vscale" 2 "string aamode" "%s" %s'
        % (x, BLUE))),
    "dots-uscale": ("2 4 8 16 32", lambda x: square(
        'Texture "t" "color" "dots" "float uscale" %s "float vscale" %s '
        '"color inside" [ .75 .65 .4 ] "color outside" [ .08 .16 .3 ]' % (x, x))),
    "imagemap-mapping": ("uv spherical cylindrical planar", lambda x: STAGE + (
        'TransformBegin Translate 0 -.2 0 Rotate -30 0 1 0 Rotate -60 1 0 0\n'
        'Texture "t" "color" "imagemap" %s "string mapping" "%s" "vector v1" [ .6 0 0 ] '
        '"vector v2" [ 0 -.6 0 ]\nTransformEnd\nMaterial "matte" "texture Kd" "t"\n'
        'Translate 0 -.2 0 Rotate -30 0 1 0 Rotate -60 1 0 0\n'
        'Shape "cylinder" "float radius" .8 "float zmin" -.8 "float zmax" .8\nWorldEnd\n' % (IMAGE, x))),
    "imagemap-wrap": ("repeat black clamp", lambda x: square(
        'Texture "t" "color" "imagemap" %s "string wrap" "%s" "float uscale" 2 "float vscale" 2 '
        '"float udelta" -.5 "float vdelta" -.5' % (IMAGE, x))),
    "imagemap-gamma": (".5 1 1.5 2.2 3", lambda x: square(
        'Texture "t" "color" "imagemap" %s "float gamma" %s' % (IMAGE, x))),
    "bilerp-v00": (".1; .8; .7 .2 .1; .1 .5 .2", corner("v00")),
    "bilerp-v01": (".1; .8; .7 .2 .1; .1 .5 .2", corner("v01")),
    "bilerp-v10": (".1; .8; .7 .2 .1; .1 .5 .2", corner("v10")),
    "bilerp-v11": (".1; .8; .7 .2 .1; .1 .5 .2", corner("v11")),
    "checkerboard-udelta": ("0 .25 .5 1", lambda x: checked(
        '"float uscale" 4 "float vscale" 4 "float udelta" ' + x)),
    "checkerboard-v1": ("1 0 0; 2 0 0; 4 0 0; 4 4 0", planar("v1", 'v2" [ 0 2 0 ]')),
    "checkerboard-dimension": ("2 3", lambda x: STAGE + (
        'TransformBegin Translate 0 -.2 0 Scale .3 .3 .3\n'
        'Texture "t" "color" "checkerboard" "integer dimension" %s "float uscale" 8 "float vscale" 8 %s\n'
        'TransformEnd\nMaterial "matte" "texture Kd" "t"\nTranslate 0 -.2 0 Rotate -30 0 1 0 '
        'Rotate -60 1 0 0\nShape "cylinder" "float radius" .8 "float zmin" -.8 "float zmax" .8\n'
        'WorldEnd\n' % (x, BLUE))),
    "checkerboard-tex1": ("0; .3; .8; .7 .2 .1; .1 .5 .2", filled(
        "tex1", '"checkerboard" "float uscale" 4 "float vscale" 4', "tex2")),
    "checkerboard-tex2": ("0; .3; .8; .7 .2 .1; .1 .5 .2", filled(
        "tex2", '"checkerboard" "float uscale" 4 "float vscale" 4', "tex1")),
    "constant-value": ("0; .3; .8; .7 .2 .1; .1 .5 .2",
        lambda x: square('Texture "t" "color" "constant" "color value" ' + color(x))),
    "dots-inside": ("0; .3; .8; .7 .2 .1; .1 .5 .2", filled(
        "inside", '"dots" "float uscale" 3 "float vscale" 3', "outside")),
    "dots-outside": ("0; .3; .8; .7 .2 .1; .1 .5 .2", filled(
        "outside", '"dots" "float uscale" 3 "float vscale" 3', "inside")),
    "imagemap-uscale": (".5 1 2 4", lambda x: square(
        'Texture "t" "color" "imagemap" %s "float uscale" %s' % (IMAGE, x))),
    "imagemap-maxanisotropy": ("1 2 8 32", lambda x: COARSE + floor(
        'Texture "t" "color" "imagemap" "string filename" "grid.png" "float maxanisotropy" ' + x)),
    "imagemap-trilinear": ("false true", lambda x: COARSE + floor(
        'Texture "t" "color" "imagemap" "string filename" "grid.png" "bool trilinear" "%s"' % x)),
    "imagemap-scale": (".25 .5 1 2 4", lambda x: square(
        'Texture "t" "color" "imagemap" %s "float scale" %s' % (IMAGE, x))),
    "marble-octaves": ("1 2 3 5 8", lambda x: veined('"integer octaves" ' + x)),
    "marble-roughness": (".1 .3 .5 .7 .9", lambda x: veined('"float roughness" ' + x)),
    "mix-tex1": ("0; .3; .8; .7 .2 .1; .1 .5 .2",
        lambda x: square(MIX % (color(x), "[ .08 .16 .3 ]", '"texture amount" "f"'))),
    "mix-tex2": ("0; .3; .8; .7 .2 .1; .1 .5 .2",
        lambda x: square(MIX % ("[ .08 .16 .3 ]", color(x), '"texture amount" "f"'))),
    "mix-amount": ("0 .25 .5 .75 1",
        lambda x: square(MIX % (
        "[ .75 .65 .4 ]", "[ .08 .16 .3 ]", '"float amount" ' + x))),
    "scale-tex1": ("0; .3; .8; .7 .2 .1; .1 .5 .2", lambda x: square(
        'Texture "image" "color" "imagemap" %s\n'
        'Texture "t" "color" "scale" "texture tex2" "image" "color tex1" %s' % (IMAGE, color(x)))),
}
