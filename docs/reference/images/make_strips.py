#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-2-Clause
"""Renders the pictures of docs/reference that show what a parameter does. It needs Pillow.

    docs/reference/images/make_strips.py build/bin/exphoton [STRIP ...]

A strip has one small picture for each value of one parameter. Its name is PLUGIN-PARAMETER, and
the table kStrips in core/parser/language_page.cpp puts it onto the page of its plugin. Without names the
script renders all strips.
"""
import os
import subprocess
import sys
import tempfile

from PIL import Image

FOLDER = os.path.dirname(os.path.abspath(__file__))
SCENES = os.path.join(FOLDER, "..", "..", "..", "scenes")
SIZE = 160
# The first line of a scene whose picture shows single pixels: it is rendered smaller and enlarged.
COARSE, ENLARGED = "# coarse\n", 4
# The samples a pixel: of filtered textures, of filters, of flat squares, of metals
# (with the light that the floor reflects), and of the others.
SAMPLES = {'PixelFilter "box"\nLookAt 0 .35': 1, "# coarse": 64, "orthographic": 4, 'metal"': 32, "": 16}

HEAD = '''SurfaceIntegrator "%s" "integer maxdepth" 8
PixelFilter "gaussian"
Sampler "lowdiscrepancy" "integer pixelsamples" %d
Film "image" "integer xresolution" %d "integer yresolution" %d
'''
FLOOR = '''Texture "board" "color" "checkerboard" "float uscale" 24 "float vscale" 24
  "color tex1" [ .42 .40 .37 ] "color tex2" [ .22 .21 .20 ]
Material "matte" "texture Kd" "board"
AttributeBegin Translate 0 -1 0 Rotate 90 1 0 0 Shape "trianglemesh" "integer indices" [ 0 1 2 0 2 3 ]
  "point P" [ -12 -12 0  12 -12 0  12 12 0  -12 12 0 ] "float uv" [ 0 0 1 0 1 1 0 1 ] AttributeEnd
'''
LAMPS = '''LightSource "infinite" "color L" [ .22 .25 .30 ]
AttributeBegin AreaLightSource "area" "integer nsamples" 2 "color L" [ 14 13 11 ]
  Translate -2.4 3.2 -2.6 Rotate 38 0 1 0 Rotate 45 1 0 0 Shape "disk" "float radius" .8 AttributeEnd
AttributeBegin AreaLightSource "area" "integer nsamples" 2 "color L" [ 5 6 8 ]
  Translate 3.2 1.2 -1.2 Rotate -70 0 1 0 Rotate 10 1 0 0 Shape "disk" "float radius" .5 AttributeEnd
'''
VIEW = 'LookAt 0 .9 -4.4  0 -.08 0  0 1 0\nCamera "perspective" "float fov" 30\nWorldBegin\n'
STAGE = VIEW + LAMPS + FLOOR
BALL = 'Rotate -50 0 1 0 Rotate -90 1 0 0 Shape "sphere" "float radius" 1\n'
# A disk before a lamp; a ball stands between them.
LEAF = '''AttributeBegin AreaLightSource "area" "integer nsamples" 4 "color L" [ 60 55 45 ]
  Translate .6 .8 4 Rotate 180 0 1 0 Shape "disk" "float radius" .3 AttributeEnd
AttributeBegin Translate .2 .1 1 Shape "sphere" "float radius" .28 AttributeEnd
Material "translucent" "color Kd" [ .6 .75 .3 ] "color Ks" [ 0 0 0 ]
  "color reflect" [ %g %g %g ] "color transmit" [ %s %s %s ]
Shape "disk" "float radius" .95
WorldEnd
'''
# A flat square that fills the picture, in even light.
SQUARE = '''LookAt 0 0 -2  0 0 0  0 1 0
Camera "orthographic" "float screenwindow" [ -.98 .98 -.98 .98 ]
WorldBegin
LightSource "distant" "point from" [ 0 0 -1 ] "color L" [ 3 3 3 ]
%s
Shape "trianglemesh" "integer indices" [ 0 1 2 0 2 3 ]
  "point P" [ -1 -1 0  1 -1 0  1 1 0  -1 1 0 ] "float uv" [ 0 1 1 1 1 0 0 0 ]
WorldEnd
'''
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
ROW = '''LightSource "infinite" "color L" [ .45 .5 .6 ]
LightSource "distant" "point from" [ -1 1.5 -1 ] "color L" [ 2.4 2.2 1.9 ]
''' + FLOOR + '''Material "matte" "color Kd" [ .62 .14 .08 ]
AttributeBegin Translate -.75 -.5 -1.5 Shape "sphere" "float radius" .5 AttributeEnd
Material "matte" "color Kd" [ .66 .50 .12 ]
AttributeBegin Translate .1 -.5 .5 Shape "sphere" "float radius" .5 AttributeEnd
Material "matte" "color Kd" [ .10 .28 .46 ]
AttributeBegin Translate 1.3 -.5 3.5 Shape "sphere" "float radius" .5 AttributeEnd
WorldEnd
'''
MIST = '''LookAt 0 .6 -4.6  0 0 0  0 1 0
Camera "perspective" "float fov" 36
WorldBegin
LightSource "spot" "point from" [ -2.6 3 1.2 ] "point to" [ .4 -1 0 ] "color I" [ 90 84 72 ]
  "float coneangle" 14 "float conedeltaangle" 2
LightSource "infinite" "color L" [ .03 .035 .045 ]
Volume %s "point p0" [ -3 -1 -3 ] "point p1" [ 3 3 3 ]
''' + FLOOR + '''Material "matte" "color Kd" [ .6 .58 .54 ]
AttributeBegin Translate .4 -.4 0 Shape "sphere" "float radius" .6 AttributeEnd
WorldEnd
'''
STAR = '''LookAt 0 0 -2  0 0 0  0 1 0
Camera "orthographic" "float screenwindow" [ -.98 .98 -.98 .98 ]
WorldBegin
LightSource "distant" "point from" [ 0 0 -1 ] "color L" [ 3 3 3 ]
Texture "star" "color" "checkerboard" "float uscale" 40 "float vscale" 1 "string aamode" "none"
  "color tex1" [ .8 .8 .8 ] "color tex2" [ .02 .02 .02 ]
Material "matte" "texture Kd" "star"
Translate -.9 -.9 0 Shape "disk" "float radius" 1.7
WorldEnd
'''
CONE = '''LookAt 0 1.4 -4.6  0 -.5 0  0 1 0
Camera "perspective" "float fov" 36
WorldBegin
LightSource "spot" "point from" [ -.8 2.6 -.9 ] "point to" [ 0 -1 0 ] "color I" [ 34 32 28 ] %s
LightSource "infinite" "color L" [ .03 .035 .045 ]
''' + FLOOR + '''Material "matte" "color Kd" [ .6 .58 .54 ]
AttributeBegin Translate 0 -.5 0 Shape "sphere" "float radius" .5 AttributeEnd
WorldEnd
'''


def ball(material):
    return STAGE + material + "\n" + BALL + "WorldEnd\n"


def square(texture):
    return SQUARE % (texture + '\nMaterial "matte" "texture Kd" "t"')


def floor(texture):
    return ('PixelFilter "box"\nLookAt 0 .35 -3  0 -.45 0  0 1 0\nCamera "perspective" "float fov" 50\n'
            'WorldBegin\nLightSource "distant" "point from" [ 0 1 0 ] "color L" [ 3 3 3 ]\n' + texture +
            '\nMaterial "matte" "texture Kd" "t"\n'
            'Rotate 90 1 0 0 Shape "trianglemesh" "integer indices" [ 0 1 2 0 2 3 ]\n'
            '"point P" [ -9 -4 0  9 -4 0  9 40 0  -9 40 0 ] "float uv" [ 0 11 9 11 9 0 0 0 ]\nWorldEnd\n')


def camera(parameters):
    return ('LookAt -.55 .35 -5.2  .15 -.35 0  0 1 0\nCamera "perspective" %s\nWorldBegin\n'
            % parameters + ROW)


def moving(parameters):
    return ('LookAt 0 .9 -4.4  0 -.08 0  0 1 0\nCamera "perspective" "float fov" 30 %s\nWorldBegin\n'
            % parameters + LAMPS + FLOOR + '''Material "matte" "color Kd" [ .62 .14 .08 ]
ActiveTransform EndTime Translate 1.2 0 0 ActiveTransform All Translate -.6 -.4 0
Shape "sphere" "float radius" .6
WorldEnd
''')


def substrate(u):
    return ball('Material "substrate" "color Kd" [ .05 .12 .22 ] "color Ks" [ .25 .25 .25 ] '
                '"float uroughness" %s "float vroughness" .05' % u)


def mixed(amount):
    return ball('MakeNamedMaterial "a" "string type" "matte" "color Kd" [ .7 .5 .1 ]\n'
                'MakeNamedMaterial "b" "string type" "plastic" "color Kd" [ .03 .1 .3 ] '
                '"color Ks" [ .6 .6 .6 ] "float roughness" .02\n'
                'Material "mix" "string namedmaterial1" "a" "string namedmaterial2" "b" '
                '"color amount" [ %s %s %s ]' % (amount, amount, amount))


def bumped(height):
    return ball('TransformBegin Scale .3 .3 .3 Texture "f" "float" "fbm" "integer octaves" 3 TransformEnd\n'
                'Texture "height" "float" "scale" "texture tex1" "f" "float tex2" %s\n'
                'Material "matte" "color Kd" [ .62 .5 .38 ] "texture bumpmap" "height"' % height)


def filtered(parameters):
    return COARSE + "PixelFilter " + parameters + "\n" + STAR


IMAGE = '"string filename" "%s/parts/painting.png"' % SCENES
MARBLE = 'TransformBegin Scale .35 .35 .35 Rotate 30 0 0 1 Texture "t" "color" "marble" %s TransformEnd'
BLUE = '"color tex1" [ .75 .65 .4 ] "color tex2" [ .08 .16 .3 ]'
# For each strip: its values, and the scene of a value. Scenes of filters are rendered small.
STRIPS = {
    "matte-sigma": ("0 15 30 50 80", lambda x: ball(
        'Material "matte" "color Kd" [ .68 .35 .16 ] "float sigma" ' + x)),
    "matte-bumpmap": ("0 .05 .1 .2 .4", bumped),
    "metal-roughness": (".002 .01 .05 .15 .5", lambda x: ball('Material "metal" "float roughness" ' + x)),
    "shinymetal-roughness": (".002 .01 .05 .15 .5", lambda x: ball(
        'Material "shinymetal" "color Kr" [ .3 .28 .22 ] "color Ks" [ .6 .5 .35 ] "float roughness" ' + x)),
    "plastic-roughness": (".002 .01 .05 .15 .5", lambda x: ball(
        'Material "plastic" "color Kd" [ .45 .05 .04 ] "color Ks" [ .4 .4 .4 ] "float roughness" ' + x)),
    "plastic-Ks": ("0 .1 .3 .6 1", lambda x: ball(
        'Material "plastic" "color Kd" [ .45 .05 .04 ] "float roughness" .03 "color Ks" [ %s %s %s ]'
        % (x, x, x))),
    "substrate-uroughness": (".005 .02 .05 .2 .8", substrate),
    "translucent-transmit": ("0 .25 .5 .75 1", lambda x: (STAGE + LEAF) % (*[1 - float(x)] * 3, x, x, x)),
    "uber-opacity": ("1 .75 .5 .25 .05", lambda x: ball(
        'Material "uber" "color Kd" [ .1 .35 .2 ] "color Ks" [ .3 .3 .3 ] "float roughness" .03 '
        '"color opacity" [ %s %s %s ]' % (x, x, x))),
    "glass-index": ("1.02 1.1 1.33 1.5 2.4", lambda x: ball('Material "glass" "float index" ' + x)),
    "mix-amount": ("0 .25 .5 .75 1", mixed),
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
    "box-xwidth": (".25 .5 1 2 4", lambda x: filtered('"box" "float xwidth" %s "float ywidth" %s' % (x, x))),
    "triangle-xwidth": (".5 1 2 3 4", lambda x: filtered(
        '"triangle" "float xwidth" %s "float ywidth" %s' % (x, x))),
    "gaussian-alpha": ("8 4 2 1 .3", lambda x: filtered('"gaussian" "float alpha" ' + x)),
    "mitchell-B": ("0 .25 .5 .75 1", lambda x: filtered('"mitchell" "float B" ' + x)),
    "mitchell-C": ("0 .25 .5 .75 1", lambda x: filtered('"mitchell" "float C" ' + x)),
    "sinc-tau": (".5 1 2 3 6", lambda x: filtered('"sinc" "float tau" ' + x)),
    "perspective-fov": ("15 30 45 70 100", lambda x: camera('"float fov" ' + x)),
    "perspective-lensradius": ("0 .05 .1 .2 .4", lambda x: camera(
        '"float fov" 34 "float focaldistance" 5.7 "float lensradius" ' + x)),
    "perspective-focaldistance": ("3 4 5.7 8 20", lambda x: camera(
        '"float fov" 34 "float lensradius" .2 "float focaldistance" ' + x)),
    "perspective-shutterclose": ("0 .1 .3 .6 1", lambda x: moving('"float shutterclose" ' + x)),
    "homogeneous-sigma_s": ("0 .02 .05 .1 .2", lambda x: MIST % (
        '"homogeneous" "color sigma_s" [ %s %s %s ]' % (x, x, x))),
    "homogeneous-sigma_a": ("0 .05 .1 .2 .4", lambda x: MIST % (
        '"homogeneous" "color sigma_s" [ .08 .08 .08 ] "color sigma_a" [ %s %s %s ]' % (x, x, x))),
    "homogeneous-g": ("-.7 -.35 0 .35 .7", lambda x: MIST % (
        '"homogeneous" "color sigma_s" [ .08 .08 .08 ] "float g" ' + x)),
    "exponential-b": ("0 .5 1 2 4", lambda x: MIST % (
        '"exponential" "color sigma_s" [ .2 .2 .2 ] "float a" 1 "float b" ' + x)),
    "spot-coneangle": ("8 14 20 30 50", lambda x: CONE % (
        '"float conedeltaangle" 2 "float coneangle" ' + x)),
    "spot-conedeltaangle": ("0 4 8 14 20", lambda x: CONE % (
        '"float coneangle" 20 "float conedeltaangle" ' + x)),
    "loopsubdiv-nlevels": ("0 1 2 3 4", lambda x: ball(
        'Material "matte" "color Kd" [ .68 .45 .26 ]\nAttributeBegin Rotate 20 1 0 .3 Shape "loopsubdiv" '
        '"integer nlevels" %s\n"integer indices" [ 0 1 2 0 2 3 0 3 4 0 4 1 5 2 1 5 3 2 5 4 3 5 1 4 ]\n'
        '"point P" [ 0 1.5 0  1.3 0 0  0 0 1.3  -1.3 0 0  0 0 -1.3  0 -1 0 ] AttributeEnd' % x)
        .replace(BALL, "")),
}


def picture(program, scene, folder):
    size = SIZE // ENLARGED if scene.startswith(COARSE) else SIZE
    samples = next(count for word, count in SAMPLES.items() if word in scene)
    head = HEAD % ("path" if 'metal"' in scene else "directlighting", samples, size, size)
    if "\nVolume " in scene:
        head += 'VolumeIntegrator "single" "float stepsize" .1\n'
    file, exr, png = (os.path.join(folder, name) for name in ("scene.pbrt", "a.exr", "a.png"))
    with open(file, "w") as out:
        out.write(head + scene)
    subprocess.run([program, file, "--quiet", "--nthreads", "1", "-o", exr], check=True)
    subprocess.run([program, "convert", exr, png, "--tone-curve", "filmic"], check=True,
                   stderr=subprocess.DEVNULL)
    return Image.open(png).convert("RGB").resize((SIZE, SIZE), Image.NEAREST)


def main():
    for name in sys.argv[2:] or STRIPS:
        values, scene = STRIPS[name]
        values = values.split()
        strip = Image.new("RGB", (SIZE * len(values), SIZE))
        with tempfile.TemporaryDirectory() as folder:
            for i, value in enumerate(values):
                strip.paste(picture(sys.argv[1], scene(value), folder), (SIZE * i, 0))
        file = os.path.join(FOLDER, name + ".jpg")
        strip.save(file, quality=88, optimize=True)
        print("%s %d bytes" % (name, os.path.getsize(file)), flush=True)


main()
