# SPDX-License-Identifier: BSD-2-Clause
"""The strips of filters. Their pictures show single pixels."""
from strips.stage import COARSE

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


def filtered(parameters):
    return COARSE + "PixelFilter " + parameters + "\n" + STAR


STRIPS = {
    "box-xwidth": (".25 .5 1 2 4", lambda x: filtered('"box" "float xwidth" %s "float ywidth" %s' % (x, x))),
    "triangle-xwidth": (".5 1 2 3 4", lambda x: filtered(
        '"triangle" "float xwidth" %s "float ywidth" %s' % (x, x))),
    "gaussian-alpha": ("8 4 2 1 .3", lambda x: filtered('"gaussian" "float alpha" ' + x)),
    "mitchell-B": ("0 .25 .5 .75 1", lambda x: filtered('"mitchell" "float B" ' + x)),
    "mitchell-C": ("0 .25 .5 .75 1", lambda x: filtered('"mitchell" "float C" ' + x)),
    "sinc-tau": (".5 1 2 3 6", lambda x: filtered('"sinc" "float tau" ' + x)),
    "box-ywidth": (".25 .5 1 2 4", lambda x: filtered('"box" "float xwidth" .5 "float ywidth" ' + x)),
    "gaussian-xwidth": (".5 1 2 3 4", lambda x: filtered(
        '"gaussian" "float alpha" .3 "float xwidth" %s "float ywidth" %s' % (x, x))),
    "mitchell-xwidth": ("1 1.5 2 3 4", lambda x: filtered(
        '"mitchell" "float xwidth" %s "float ywidth" %s' % (x, x))),
    "sinc-xwidth": ("1 2 3 4 6", lambda x: filtered(
        '"sinc" "float xwidth" %s "float ywidth" %s' % (x, x))),
}
