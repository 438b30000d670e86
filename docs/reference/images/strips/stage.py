# SPDX-License-Identifier: BSD-2-Clause
"""The stage of the strips: the parts that their scenes share, and rendering."""
import os
import subprocess

from PIL import Image

SCENES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "..", "..", "scenes")
SIZE = 160
# The first line of a scene whose picture shows single pixels: it is rendered smaller and enlarged.
COARSE, GRAINY = "# coarse\n", "# grainy\n"
ENLARGED = {COARSE: 4, GRAINY: 2}
# The samples a pixel: of filtered textures, of filters, of flat squares, of metals
# (with the light that the floor reflects), and of the others. A scene with a sampler overrides it.
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
SQUARE = '''LookAt 0 0 -2  0 0 0  0 1 0
Camera "orthographic" "float screenwindow" [ -.98 .98 -.98 .98 ]
WorldBegin
LightSource "distant" "point from" [ 0 0 -1 ] "color L" [ 3 3 3 ]
%s
Shape "trianglemesh" "integer indices" [ 0 1 2 0 2 3 ]
  "point P" [ -1 -1 0  1 -1 0  1 1 0  -1 1 0 ] "float uv" [ 0 1 1 1 1 0 0 0 ]
WorldEnd
'''


def ball(material):
    return STAGE + material + "\n" + BALL + "WorldEnd\n"


def square(texture):
    return SQUARE % (texture + '\nMaterial "matte" "texture Kd" "t"')


def color(value):
    """Returns three equal numbers for one, and three others as they are."""
    return "[ %s ]" % (value if len(value.split()) > 1 else " ".join([value] * 3))


def picture(program, scene, folder):
    """Renders a scene to a picture of SIZE pixels. Directives of the scene override the head."""
    size = SIZE // ENLARGED.get(scene[:scene.find("\n") + 1], 1)
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
