# SPDX-License-Identifier: BSD-2-Clause
"""The strips of materials."""
from strips.stage import LAMPS, STAGE, ball, color

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


def plain(material, parameters):
    """A function of a value: the ball of a material with parameters that hold the value at %s."""
    return lambda x: ball('Material "%s" ' % material + parameters % color(x))


STRIPS = {
    "matte-sigma": ("0 15 30 50 80", lambda x: ball(
        'Material "matte" "color Kd" [ .68 .35 .16 ] "float sigma" ' + x)),
    "matte-bumpmap": ("0 .05 .1 .2 .4", bumped),
    "plastic-roughness": (".002 .01 .05 .15 .5", lambda x: ball(
        'Material "plastic" "color Kd" [ .45 .05 .04 ] "color Ks" [ .4 .4 .4 ] "float roughness" ' + x)),
    "metal-roughness": (".002 .01 .05 .15 .5", lambda x: ball('Material "metal" "float roughness" ' + x)),
    "shinymetal-roughness": (".002 .01 .05 .15 .5", lambda x: ball(
        'Material "shinymetal" "color Kr" [ .3 .28 .22 ] "color Ks" [ .6 .5 .35 ] "float roughness" ' + x)),
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
    "matte-Kd": ("0; .2; .8; .7 .2 .1; .1 .3 .6", plain("matte", '"color Kd" %s')),
    "glass-Kr": ("0; .5; 1; 1 .6 .2", plain("glass", '"color Kr" %s')),
    "glass-Kt": ("0; .5; 1; .9 .6 .2; .3 .7 .5", plain("glass", '"color Kt" %s')),
    "mirror-Kr": (".1; .4; .9; .95 .7 .35", plain("mirror", '"color Kr" %s')),
    "metal-eta": (".2 .5 1 4", plain("metal", '"color eta" %s "color k" [ 1 1 1 ]')),
    "metal-k": ("0 1 2 4", plain("metal", '"color eta" [ .5 .5 .5 ] "color k" %s')),
    "shinymetal-Kr": ("0; .3; .8; .8 .6 .3", plain(
        "shinymetal", '"color Ks" [ .3 .28 .25 ] "float roughness" .05 "color Kr" %s')),
    "shinymetal-Ks": ("0; .3; .8; .8 .6 .3", plain(
        "shinymetal", '"color Kr" [ .2 .2 .2 ] "float roughness" .05 "color Ks" %s')),
    "plastic-fresnel": ("inverted physical", lambda x: ball(
        'Material "plastic" "color Kd" [ .45 .05 .04 ] "color Ks" [ 1 1 1 ] "float roughness" .02 '
        '"string fresnel" "%s"' % x)),
    "substrate-Kd": ("0; .2; .8; .6 .1 .05", plain(
        "substrate", '"color Ks" [ .1 .1 .1 ] "float uroughness" .02 "float vroughness" .02 "color Kd" %s')),
    "substrate-Ks": ("0; .05; .2; .6; .6 .4 .1", plain(
        "substrate",
        '"color Kd" [ .05 .12 .22 ] "float uroughness" .02 "float vroughness" .02 "color Ks" %s')),
    "substrate-vroughness": (".005 .02 .05 .2 .8", lambda x: ball(
        'Material "substrate" "color Kd" [ .05 .12 .22 ] "color Ks" [ .25 .25 .25 ] '
        '"float uroughness" .05 "float vroughness" ' + x)),
    "translucent-Kd": ("0; .3; .8; .6 .75 .3; .7 .2 .1", lambda x: STAGE + (LEAF % (
        *[.5] * 3, .5, .5, .5)).replace("[ .6 .75 .3 ]", color(x))),
    "translucent-reflect": ("0 .25 .5 .75 1", lambda x: STAGE + (LEAF % (*[float(x)] * 3, .25, .25, .25))),
    "uber-Kr": ("0 .1 .3 .6 .9", plain(
        "uber", '"color Kd" [ .1 .35 .2 ] "color Ks" [ 0 0 0 ] "color Kr" %s')),
    "uber-index": ("1.1 1.33 1.5 2.4 4", lambda x: ball(
        'Material "uber" "color Kd" [ .1 .35 .2 ] "color Ks" [ 0 0 0 ] "color Kr" [ 1 1 1 ] '
        '"float index" ' + x)),
}
