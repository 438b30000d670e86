# SPDX-License-Identifier: BSD-2-Clause
"""The strips of surface integrators."""
from strips.stage import GRAINY

VIEW = '''LookAt 0 0 -4.2  0 0 0  0 1 0
Camera "perspective" "float fov" 36
WorldBegin
'''
SIDE = 'AttributeBegin Rotate %d 0 1 0 Rotate %d 1 0 0 Translate 0 0 1 ' \
    'Shape "trianglemesh" "integer indices" [ 0 1 2 0 2 3 ] ' \
    '"point P" [ -1 -1 0  1 -1 0  1 1 0  -1 1 0 ] AttributeEnd\n'
# A box, open towards the camera, with a red and a blue side.
BOX = 'Material "matte" "color Kd" [ .72 .7 .66 ]\n' + SIDE % (0, 0) + SIDE % (0, 90) + SIDE % (0, -90) + \
    'Material "matte" "color Kd" [ .65 .15 .08 ]\n' + SIDE % (-90, 0) + \
    'Material "matte" "color Kd" [ .1 .25 .55 ]\n' + SIDE % (90, 0)
LAMP = '''AttributeBegin AreaLightSource "area" "color L" [ 14 13 11 ]
  Translate 0 .98 -.1 Rotate 90 1 0 0 Shape "disk" "float radius" .28 AttributeEnd
'''
# A lamp that lights the ceiling only.
UPLIGHT = '''AttributeBegin AreaLightSource "area" "color L" [ 60 56 48 ]
  Translate -.55 .5 .3 Rotate -90 1 0 0 Shape "disk" "float radius" .16 AttributeEnd
Material "matte" "color Kd" [ .2 .2 .2 ]
AttributeBegin Translate -.55 .47 .3 Rotate -90 1 0 0 Shape "disk" "float radius" .2 AttributeEnd
'''
STONES = '''Material "matte" "color Kd" [ .72 .7 .66 ]
AttributeBegin Translate -.42 -.62 .3 Shape "sphere" "float radius" .38 AttributeEnd
AttributeBegin Translate .45 -.7 -.2 Shape "sphere" "float radius" .3 AttributeEnd
'''
BALLS = '''Material "mirror" "color Kr" [ .9 .9 .9 ]
AttributeBegin Translate -.42 -.56 .3 Shape "sphere" "float radius" .44 AttributeEnd
Material "glass"
AttributeBegin Translate .45 -.62 -.25 Shape "sphere" "float radius" .36 AttributeEnd
'''
LENS = '''Material "glass"
AttributeBegin Translate 0 -.45 -.1 Shape "sphere" "float radius" .42 AttributeEnd
'''
PLAIN, CAUSTIC, GLASSY = BOX + LAMP + STONES, BOX + LAMP + LENS, BOX + LAMP + BALLS
DIM = BOX + UPLIGHT + STONES


def colored_lamps():
    """Small lamps of different power along the walls, and the stones."""
    lamps = ""
    for i in range(24):
        x, z, power = -.9 + .6 * (i % 4), -.8 + .3 * (i // 4), .02 + .4 * (i % 5 == 0)
        rgb = ((1, .5, .2), (.3, .5, 1), (.9, .9, .8))[i % 3]
        lamps += 'LightSource "point" "point from" [ %.2f %.2f %.2f ] "color I" [ %.3f %.3f %.3f ]\n' % (
            x, -.2 + .25 * (i % 3), z, *(power * c for c in rgb))
    return BOX + lamps + STONES


def scene(integrator, parameters, world, samples=16, grainy=False):
    head = GRAINY + 'PixelFilter "box"\n' if grainy else ""
    head += 'SurfaceIntegrator "%s" %s\n' % (integrator, parameters)
    head += 'Sampler "lowdiscrepancy" "integer pixelsamples" %d\n' % samples
    return head + VIEW + world + "WorldEnd\n"


def strip(integrator, parameters, world, samples=16, grainy=False):
    """A function of a value, which the parameters hold at %s."""
    return lambda x: scene(integrator, parameters % x, world, samples, grainy)


# The photons are seen directly, without final gathering.
DIRECT = '"bool finalgather" "false" '
# Few gather rays show which of them are good.
FEW = '"integer finalgathersamples" 2 "bool sharedgather" "false" "integer edgesamples" 1 '
FILL = '"integer indirectphotons" 20000 "integer finalgathersamples" 16 '

STRIPS = {
    "ambientocclusion-nsamples": ("1 4 16 64", strip(
        "ambientocclusion", '"integer nsamples" %s', PLAIN, 1, True)),
    "ambientocclusion-mindist": ("0 .1 .3 .6 1", strip(
        "ambientocclusion", '"integer nsamples" 32 "float mindist" %s', PLAIN)),
    "ambientocclusion-maxdist": (".1 .3 .6 1 2", strip(
        "ambientocclusion", '"integer nsamples" 32 "float maxdist" %s', PLAIN)),
    "ambientocclusion-weighting": ("uniform cosine", strip(
        "ambientocclusion", '"integer nsamples" 32 "string weighting" "%s"', PLAIN)),
    "debug-red": ("u v nx z facing", strip(
        "debug", '"string green" "zero" "string red" "%s"', PLAIN)),
    "directlighting-maxdepth": ("0 1 2 3 8", strip("directlighting", '"integer maxdepth" %s', GLASSY)),
    "directlighting-strategy": ("all one weighted near", lambda x: scene(
        "directlighting", '"string strategy" "%s"' % x, colored_lamps(), 1, True)),
    "exphotonmap-causticphotons": ("0 100 1000 10000 100000", strip(
        "exphotonmap", FILL + '"integer causticphotons" %s', CAUSTIC, 4)),
    "exphotonmap-indirectphotons": ("100 1000 10000 100000", strip(
        "exphotonmap", DIRECT + '"integer causticphotons" 0 "integer indirectphotons" %s', PLAIN)),
    "exphotonmap-nused": ("5 20 50 200 1000", strip(
        "exphotonmap",
        DIRECT + '"integer causticphotons" 0 "integer indirectphotons" 10000 "integer nused" %s', PLAIN)),
    "exphotonmap-finalgathersamples": ("1 4 16 64", strip(
        "exphotonmap", '"integer indirectphotons" 20000 "bool sharedgather" "false" '
        '"integer edgesamples" 1 "integer finalgathersamples" %s', DIM, 1, True)),
    "exphotonmap-finalgather": ("false true", strip(
        "exphotonmap", FILL + '"bool finalgather" "%s"', PLAIN, 4)),
    "exphotonmap-sharedgather": ("false true", strip(
        "exphotonmap", '"integer finalgathersamples" 4 "bool sharedgather" "%s"', DIM, 1, True)),
    "exphotonmap-edgesamples": ("1 4 16", strip(
        "exphotonmap", FILL + '"integer edgesamples" %s', PLAIN, 1, True)),
    "exphotonmap-maxdist": (".02 .05 .1 .3", strip(
        "exphotonmap",
        DIRECT + '"integer causticphotons" 0 "integer indirectphotons" 3000 "float maxdist" %s', PLAIN)),
    "exphotonmap-gathersampling": ("photons bsdf jensen hey", strip(
        "exphotonmap", FEW + '"string gathersampling" "%s"', DIM, 1, True)),
    "exphotonmap-kernel": ("simpson constant", strip(
        "exphotonmap", DIRECT + '"integer causticphotons" 0 "integer indirectphotons" 2000 '
        '"integer nused" 10 "string kernel" "%s"', PLAIN)),
    "exphotonmap-directlights": ("1 4 16 64", lambda x: scene(
        "exphotonmap", DIRECT + '"integer directlights" ' + x, colored_lamps(), 1, True)),
    "exphotonmap-maxphotondepth": ("1 2 3 5 20", strip(
        "exphotonmap", FILL + '"integer maxphotondepth" %s', DIM, 4)),
    "photonmap-directwithphotons": ("false true", strip(
        "photonmap", '"integer finalgathersamples" 8 "integer indirectphotons" 20000 '
        '"bool directwithphotons" "%s"', PLAIN, 4)),
    "guidedpath-indirectphotons": ("0 1000 10000 100000", strip(
        "guidedpath", '"integer indirectphotons" %s', DIM, 16, True)),
    "igi-nlights": ("1 4 16 64 256", strip(
        "igi", '"integer nsets" 1 "integer nlights" %s', DIM, 4)),
    "igi-nsets": ("1 2 4 16", strip("igi", '"integer nlights" 8 "integer nsets" %s', DIM, 4)),
    "igi-mindist": ("0 .03 .1 .3 1", strip("igi", '"integer nlights" 64 "float mindist" %s', DIM, 4)),
    "igi-indirectscale": ("0 .5 1 2 4", strip("igi", '"float indirectscale" %s', PLAIN, 4)),
    "igi-glimit": (".1 1 10 1000", strip("igi", '"integer gathersamples" 4 "float glimit" %s', DIM, 4)),
    "irradiancecache-maxerror": (".05 .2 1 5", strip(
        "irradiancecache", '"integer nsamples" 256 "float minpixelspacing" 0 "float maxpixelspacing" 100 '
        '"float maxerror" %s', DIM, 4)),
    "irradiancecache-maxindirectdepth": ("0 1 2 3 10", strip(
        "irradiancecache", '"integer nsamples" 256 "integer maxindirectdepth" %s', DIM, 4)),
    "irradiancecache-nsamples": ("4 16 64 256 1024", strip(
        "irradiancecache", '"integer nsamples" %s', DIM, 4)),
    "irradiancecache-minweight": (".1 .5 2 8", strip(
        "irradiancecache", '"integer nsamples" 64 "float minweight" %s', DIM, 4)),
    "irradiancecache-minpixelspacing": ("0 2.5 10 40", strip(
        "irradiancecache",
        '"integer nsamples" 64 "float maxpixelspacing" 50 "float minpixelspacing" %s', DIM, 4)),
    "irradiancecache-maxpixelspacing": ("3 8 15 60", strip(
        "irradiancecache", '"integer nsamples" 64 "float maxerror" 2 "float maxpixelspacing" %s', DIM, 4)),
    "irradiancecache-maxangledifference": ("2 10 30 80", strip(
        "irradiancecache", '"integer nsamples" 64 "float maxerror" 2 "float maxangledifference" %s', DIM, 4)),
    "path-maxdepth": ("0 1 2 5 20", strip("path", '"integer maxdepth" %s', DIM, 64)),
}
