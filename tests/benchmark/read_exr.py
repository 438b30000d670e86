"""Reads the EXR pictures that exphoton writes with --float: 32-bit channels, ZIP or no compression."""
import array
import itertools
import struct
import zlib


def text_at(data, at):
    end = data.index(0, at)
    return data[at:end].decode(), end + 1


def header(data):
    at, attributes = 8, {}
    while data[at] != 0:
        name, at = text_at(data, at)
        _, at = text_at(data, at)
        size, = struct.unpack_from("<i", data, at)
        attributes[name] = data[at + 4:at + 4 + size]
        at += 4 + size
    return attributes, at + 1


def channel_names(data):
    at, names = 0, []
    while data[at] != 0:
        name, at = text_at(data, at)
        kind, = struct.unpack_from("<i", data, at)
        if kind != 2:
            raise ValueError(f"channel {name} is not of 32-bit floats")
        names.append(name)
        at += 16
    return names


def unpacked(block):
    """Undoes the predictor and the order of bytes of the ZIP compression."""
    deltas = bytearray(zlib.decompress(block))
    sums = bytes(itertools.accumulate(deltas, lambda a, b: (a + b - 128) & 255))
    result, half = bytearray(len(sums)), (len(sums) + 1) // 2
    result[0::2], result[1::2] = sums[:half], sums[half:]
    return bytes(result)


def read_exr(path):
    """Returns a dictionary of the channels; each has its pixels row by row."""
    with open(path, "rb") as file:
        data = file.read()
    attributes, at = header(data)
    names = channel_names(attributes["channels"])
    left, top, right, bottom = struct.unpack("<4i", attributes["dataWindow"])
    width, height = right - left + 1, bottom - top + 1
    lines = {0: 1, 2: 1, 3: 16}[attributes["compression"][0]]
    blocks = struct.unpack_from(f"<{-(-height // lines)}Q", data, at)
    channels = {name: array.array("f", bytes(4 * width * height)) for name in names}
    for block in blocks:
        row, size = struct.unpack_from("<ii", data, block)
        rows = range(row - top, min(row - top + lines, height))
        pixels = data[block + 8:block + 8 + size]
        if size < 4 * width * len(names) * len(rows):
            pixels = unpacked(pixels)
        values = array.array("f", pixels)
        for i, (y, name) in enumerate((y, name) for y in rows for name in names):
            channels[name][y * width:(y + 1) * width] = values[i * width:(i + 1) * width]
    return channels
