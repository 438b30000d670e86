# SPDX-License-Identifier: BSD-2-Clause
"""The strips of textures."""
from strips.stage import COARSE, SCENES, STAGE, square

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
BLUE = '"color tex1" [ .75 .65 .4 ] "color tex2" [ .08 .16 .3 ]'


def floor(texture):
    return ('PixelFilter "box"\nLookAt 0 .35 -3  0 -.45 0  0 1 0\nCamera "perspective" "float fov" 50\n'
            'WorldBegin\nLightSource "distant" "point from" [ 0 1 0 ] "color L" [ 3 3 3 ]\n' + texture +
            '\nMaterial "matte" "texture Kd" "t"\n'
            'Rotate 90 1 0 0 Shape "trianglemesh" "integer indices" [ 0 1 2 0 2 3 ]\n'
            '"point P" [ -9 -4 0  9 -4 0  9 40 0  -9 40 0 ] "float uv" [ 0 11 9 11 9 0 0 0 ]\nWorldEnd\n')


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
}
