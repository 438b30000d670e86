#!/usr/bin/env python3
"""Lets gappa prove the bounds of rounding errors that the code states.

Usage: check.py CONSTANTS
CONSTANTS is the program beside this file. Its constants take the places of $name$ in the proofs
(*.gappa). Each proof must hold. Each must fail with a worse constant, or it would prove nothing.
Ends with 77 (skipped) where gappa is missing.
"""
import pathlib
import re
import shutil
import subprocess
import sys

# Constants of each proof, and the factors that make them wrong.
WRONG = {
    "triangle_volume": [("kVolumeErrorRounded", .4)],
    "triangle_distance": [("leastVolumeRounded", .5)],
    "triangle_beyond": [("kBeyond", 1 - 2**-14)],
    "triangle_shear": [("kShear", .9)],
    "triangle_ahead": [("large0", 2**-14), ("large1", .18), ("large2", 2**-7)],
    "plane_margin": [("kAheadMargin", .45)],
    "cone_chord": [("kChordError", .75)],
    "flattened_distance": [("steepness", 2)],
}


def holds(proof, constants):
    text = re.sub(r"\$(\w+)\$", lambda name: constants[name.group(1)].hex(), proof.read_text())
    result = subprocess.run(["gappa"], input=text, capture_output=True, text=True)
    if "syntax error" in result.stderr or "assumed" in result.stderr:
        sys.exit(f"{proof.name}: {result.stderr}\n{text}")
    return result.returncode == 0


def main():
    if not shutil.which("gappa"):
        print("SKIPPED: gappa is not installed")
        sys.exit(77)
    output = subprocess.run(sys.argv[1:], capture_output=True, text=True, check=True).stdout
    constants = {name: float.fromhex(value) for name, value in map(str.split, output.splitlines())}
    proofs = sorted(pathlib.Path(__file__).parent.glob("*.gappa"))
    assert {proof.stem for proof in proofs} == set(WRONG)
    isWrong = False
    for proof in proofs:
        isProved = holds(proof, constants)
        print(f"{proof.stem}: {'proved' if isProved else 'NOT PROVED'}")
        isWrong |= not isProved
        for name, factor in WRONG[proof.stem]:
            wrong = dict(constants, **{name: constants[name] * factor})
            if name == "leastVolumeRounded":
                wrong["leastVolumeLess"] = constants["leastVolumeLess"] * factor
            fails = not holds(proof, wrong)
            print(f"    with {factor:.6g} {name}: "
                  f"{'not proved' if fails else 'PROVED, though it is wrong'}")
            isWrong |= not fails
    sys.exit(1 if isWrong else 0)


main()
