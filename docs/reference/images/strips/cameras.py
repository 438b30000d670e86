# SPDX-License-Identifier: BSD-2-Clause
"""The strips of cameras."""
from strips.stage import FLOOR, LAMPS

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


STRIPS = {
    "perspective-fov": ("15 30 45 70 100", lambda x: camera('"float fov" ' + x)),
    "perspective-lensradius": ("0 .05 .1 .2 .4", lambda x: camera(
        '"float fov" 34 "float focaldistance" 5.7 "float lensradius" ' + x)),
    "perspective-focaldistance": ("3 4 5.7 8 20", lambda x: camera(
        '"float fov" 34 "float lensradius" .2 "float focaldistance" ' + x)),
    "perspective-shutterclose": ("0 .1 .3 .6 1", lambda x: moving('"float shutterclose" ' + x)),
    "perspective-hither": (".001 4 4.6 6 8", lambda x: camera('"float fov" 34 "float hither" ' + x)),
    "perspective-yon": ("4 5.5 7 9 40", lambda x: camera('"float fov" 34 "float yon" ' + x)),
    "perspective-shutteropen": ("0 .3 .6 .9", lambda x: moving('"float shutteropen" ' + x)),
    "perspective-frameaspectratio": (".5 .75 1 1.5 2", lambda x: camera(
        '"float fov" 34 "float frameaspectratio" ' + x)),
    "perspective-screenwindow": ("-1 1 -1 1; 0 1 0 1; -1 0 -1 0; -2 2 -2 2", lambda x: camera(
        '"float fov" 34 "float screenwindow" [ %s ]' % x)),
    "orthographic-screenwindow": ("-1 1 -1 1; -.5 .5 -.5 .5; 0 1 -1 0; -2 2 -2 2", lambda x: camera(
        '"float screenwindow" [ %s ]' % x).replace(
            "Camera", 'Sampler "lowdiscrepancy" "integer pixelsamples" 16\nCamera').replace(
                "perspective", "orthographic")),
}
