# SPDX-License-Identifier: BSD-2-Clause
"""The strips of shapes."""
from strips.stage import BALL, ball



STRIPS = {
    "loopsubdiv-nlevels": ("0 1 2 3 4", lambda x: ball(
        'Material "matte" "color Kd" [ .68 .45 .26 ]\nAttributeBegin Rotate 20 1 0 .3 Shape "loopsubdiv" '
        '"integer nlevels" %s\n"integer indices" [ 0 1 2 0 2 3 0 3 4 0 4 1 5 2 1 5 3 2 5 4 3 5 1 4 ]\n'
        '"point P" [ 0 1.5 0  1.3 0 0  0 0 1.3  -1.3 0 0  0 0 -1.3  0 -1 0 ] AttributeEnd' % x)
        .replace(BALL, "")),
}
