#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-2-Clause
"""Renders one small picture for each shape, material, texture and light, and puts them on a sheet.

    scenes/language-tour/make_sheet.py build/bin/exphoton scenes/language-tour/images/sheet.jpg
"""
import os
import subprocess
import sys
import tempfile

from PIL import Image, ImageDraw

WIDTH, HEIGHT, COLUMNS, CAPTION = 112, 92, 7, 14
FOLDER = os.path.dirname(os.path.abspath(__file__))
PAINTING = os.path.join(FOLDER, "..", "parts", "painting.png")

FLOOR = '''AttributeBegin
Material "matte" "color Kd" [.5 .5 .5]
Shape "trianglemesh" "integer indices" [0 1 2 0 2 3]
  "point P" [-9 0 9 9 0 9 9 0 -9 -9 0 -9]
Shape "trianglemesh" "integer indices" [0 1 2 0 2 3]
  "point P" [-9 0 -2 9 0 -2 9 9 -2 -9 9 -2]
AttributeEnd
'''
CHECKED_FLOOR = '''AttributeBegin
Texture "floor" "color" "checkerboard" "float uscale" 24 "float vscale" 24
  "color tex1" [.6 .6 .6] "color tex2" [.15 .15 .15]
Material "matte" "texture Kd" "floor"
Shape "trianglemesh" "integer indices" [0 1 2 0 2 3]
  "point P" [-9 0 9 9 0 9 9 0 -9 -9 0 -9] "float uv" [0 0 1 0 1 1 0 1]
AttributeEnd
'''
LAMP = '''AttributeBegin
AreaLightSource "area" "color L" [20 20 20]
Translate -1.5 4 3
Rotate 60 1 0 0
Shape "disk" "float radius" .9
AttributeEnd
LightSource "infinite" "color L" [.35 .38 .42]
'''
BALL = 'Translate 0 1 0\nShape "sphere"\n'
UP = 'Translate 0 1 0\nRotate -90 1 0 0\n'

SHAPES = {
    "sphere": 'Translate 0 1 0\nShape "sphere" "float zmax" .6 "float phimax" 300',
    "cylinder": UP + 'Shape "cylinder" "float radius" .8 "float phimax" 300',
    "cone": 'Rotate -90 1 0 0\nShape "cone" "float height" 2',
    "disk": 'Translate 0 1 0\nRotate -30 1 0 0\nShape "disk" "float innerradius" .4',
    "hyperboloid": UP + 'Shape "hyperboloid" "point p1" [1 0 -1] "point p2" [.2 .8 1]',
    "paraboloid": 'Rotate -90 1 0 0\nShape "paraboloid" "float zmax" 1.8',
    "trianglemesh": 'Shape "trianglemesh" "integer indices" [0 1 4 1 2 4 2 3 4 3 0 4] "point P" '
                    '[-1 0 1 1 0 1 1 0 -1 -1 0 -1 0 1.8 0]',
    "heightfield": 'Translate -1 .1 1\nRotate -90 1 0 0\nScale 2 2 1\nShape "heightfield" '
                   '"integer nu" 4 "integer nv" 4 '
                   '"float Pz" [0 .2 .2 0 .2 1.2 .6 .2 .2 .6 1.5 .2 0 .2 .2 0]',
    "loopsubdiv": 'Translate 0 .8 0\nShape "loopsubdiv" "integer nlevels" 4 "integer indices" '
                  '[0 1 2 0 2 3 0 3 1 1 3 2] "point P" [0 2.6 0 -2.4 -1.2 1.8 2.4 -1.2 1.8 0 -1.2 -2.6]',
    "nurbs": 'Translate -1 .3 -.4\nShape "nurbs" "integer nu" 3 "integer nv" 3 "integer uorder" 3 '
             '"integer vorder" 3 "float uknots" [0 0 0 1 1 1] "float vknots" [0 0 0 1 1 1] '
             '"float u0" 0 "float v0" 0 "float u1" 1 "float v1" 1 "point P" '
             '[0 0 1.2 1 .6 1.4 2 0 1.2 0 .6 .6 1 3.6 .6 2 .6 .6 0 0 0 1 .6 -.2 2 0 0]',
}
MATERIALS = {
    name: f'Material "{name}" {parameters}' for name, parameters in {
        "matte": '"color Kd" [.7 .3 .2]',
        "plastic": '"color Kd" [.2 .3 .6] "color Ks" [.5 .5 .5] "float roughness" .05',
        "translucent": '"color Kd" [.4 .6 .3] "color Ks" [.2 .2 .2]',
        "glass": "", "mirror": '"color Kr" [.9 .9 .9]',
        "shinymetal": '"color Kr" [.3 .3 .3] "color Ks" [.6 .5 .3]',
        "substrate": '"color Kd" [.5 .1 .1] "color Ks" [.1 .1 .1] "float uroughness" .02 '
                     '"float vroughness" .2',
        "uber": '"color Kd" [.3 .3 .5] "color Ks" [.3 .3 .3] "color opacity" [.7 .7 .7]',
        "metal": '"float roughness" .02', "bluepaint": "", "brushedmetal": "", "clay": "",
        "felt": "", "primer": "", "skin": "",
    }.items()
}
MATERIALS["mix"] = ('MakeNamedMaterial "a" "string type" "mirror"\n'
                    'MakeNamedMaterial "b" "string type" "matte" "color Kd" [.8 .2 .1]\n'
                    'Texture "m" "color" "checkerboard" "float uscale" 12 "float vscale" 6\n'
                    'Material "mix" "string namedmaterial1" "a" "string namedmaterial2" "b" '
                    '"texture amount" "m"')
COLORS = '"color tex1" [.8 .45 .2] "color tex2" [.15 .3 .6]'
TEXTURES = {
    "constant": '"color value" [.8 .45 .2]',
    "checkerboard": COLORS + ' "float uscale" 8 "float vscale" 4',
    "dots": '"color inside" [.8 .45 .2] "color outside" [.15 .3 .6] "float uscale" 12 '
            '"float vscale" 8',
    "uv": "",
    "bilerp": '"color v00" [.8 .1 .1] "color v01" [.1 .8 .1] "color v10" [.1 .1 .8] '
              '"color v11" [.8 .8 .1]',
    "imagemap": f'"string filename" "{PAINTING}"', "fbm": "", "wrinkled": "", "windy": "",
    "marble": "", "scale": '"texture tex1" "t1" "texture tex2" "t2"',
    "mix": '"texture tex1" "t1" "texture tex2" "t2" "float amount" .5',
}
OTHERS = ('Texture "t1" "color" "checkerboard" "float uscale" 8 "float vscale" 4 ' + COLORS +
          '\nTexture "t2" "color" "marble"\n')
LIGHTS = {
    "point": 'LightSource "point" "color I" [14 14 14] "point from" [-1.6 2.6 1.6]',
    "spot": 'LightSource "spot" "color I" [40 40 40] "point from" [-2 4 2] "point to" [0 .8 0] '
            '"float coneangle" 22',
    "distant": 'LightSource "distant" "color L" [2.5 2.5 2.5] "point from" [-1 2 1.5]',
    "infinite": f'LightSource "infinite" "string mapname" "{PAINTING}"',
    "goniometric": 'Translate -1.2 3 1.5\nLightSource "goniometric" "color I" [25 25 25] '
                   f'"string mapname" "{PAINTING}"',
    "projection": 'Translate 0 2 4\nRotate 180 0 1 0\nRotate 10 1 0 0\nRotate 180 0 0 1\n'
                  f'LightSource "projection" "color I" [60 60 60] "float fov" 50 '
                  f'"string mapname" "{PAINTING}"',
    "area": 'AreaLightSource "area" "color L" [10 10 10]\nTranslate -1.5 3 1.5\nRotate 60 1 0 0\n'
            'Shape "disk" "float radius" .8',
}


def block(text):
    return "AttributeBegin\n" + text + "\nAttributeEnd\n"


def scene(world, integrator):
    return ('LookAt 0 2.2 6  0 .95 0  0 1 0\nCamera "perspective" "float fov" 28\n'
            f'SurfaceIntegrator {integrator}\nFilm "image" "integer xresolution" {WIDTH} '
            f'"integer yresolution" {HEIGHT}\nSampler "lowdiscrepancy" "integer pixelsamples" 32\n'
            'WorldBegin\n' + world + "WorldEnd\n")


def cells():
    direct, path = '"directlighting"', '"path" "integer maxdepth" 6'
    grey = 'Material "plastic" "color Kd" [.55 .5 .45] "color Ks" [.2 .2 .2]\n'
    for name, text in SHAPES.items():
        yield "shape", name, scene(LAMP + FLOOR + block(grey + text), direct)
    for name, text in MATERIALS.items():
        yield "material", name, scene(LAMP + CHECKED_FLOOR + block(text + "\n" + BALL), path)
    for name, text in TEXTURES.items():
        texture = OTHERS + f'Texture "t" "color" "{name}" {text}\n'
        world = LAMP + FLOOR + block(texture + 'Material "matte" "texture Kd" "t"\n' + BALL)
        yield "texture", name, scene(world, direct)
    for name, text in LIGHTS.items():
        yield "light", name, scene(block(text) + FLOOR + block(grey + BALL), direct)


def main(program, output):
    rows, last = [], None
    for kind, name, text in cells():
        if kind != last or len(rows[-1]) == COLUMNS:
            rows.append([])
        last = kind
        with tempfile.TemporaryDirectory() as folder:
            picture = os.path.join(folder, "a.exr")
            subprocess.run([program, "render", "-", "-o", picture, "--preview", picture + ".png",
                            "--quiet", "--no-progress"], input=text.encode(), check=True)
            rows[-1].append((kind, name, Image.open(picture + ".png").convert("RGB")))
    sheet = Image.new("RGB", (COLUMNS * WIDTH, len(rows) * (HEIGHT + CAPTION)), "white")
    draw = ImageDraw.Draw(sheet)
    for y, row in enumerate(rows):
        if len(row) < COLUMNS:
            draw.text((len(row) * WIDTH + 8, y * (HEIGHT + CAPTION) + 4), row[0][0] + "s",
                      fill="black")
        for x, (kind, name, picture) in enumerate(row):
            place = (x * WIDTH, y * (HEIGHT + CAPTION))
            sheet.paste(picture, place)
            draw.text((place[0] + 2, place[1] + HEIGHT + 1), name, fill="black")
    sheet.save(output, quality=88)


if __name__ == "__main__":
    main(*sys.argv[1:])
