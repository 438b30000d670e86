# SPDX-License-Identifier: BSD-2-Clause
"""The strips of materials."""
from strips.stage import LAMPS, STAGE, ball

# A disk before a lamp; a ball stands between them.
LEAF = '''AttributeBegin AreaLightSource "area" "integer nsamples" 4 "color L" [ 60 55 45 ]
  Translate .6 .8 4 Rotate 180 0 1 0 Shape "disk" "float radius" .3 AttributeEnd
AttributeBegin Translate .2 .1 1 Shape "sphere" "float radius" .28 AttributeEnd
Material "translucent" "color Kd" [ .6 .75 .3 ] "color Ks" [ 0 0 0 ]
  "color reflect" [ %g %g %g ] "color transmit" [ %s %s %s ]
Shape "disk" "float radius" .95
WorldEnd
'''


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
}
