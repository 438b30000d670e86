# SPDX-License-Identifier: BSD-2-Clause
"""The strips of volume integrators."""
from strips.stage import GRAINY
from strips.volumes import CELLS, MIST

STRIPS = {
    "single-stepsize": (".05 .2 .5 1 3", lambda x: GRAINY + (
        'VolumeIntegrator "single" "float stepsize" %s\nSampler "lowdiscrepancy" "integer pixelsamples" 1\n'
        'PixelFilter "box"\n' % x) + MIST % (
        CELLS + '"integer nx" 8 "float density" [ 1 0 1 0 1 0 1 0 ]')),
}
