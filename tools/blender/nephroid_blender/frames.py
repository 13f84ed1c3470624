"""Frames of `nephroid render --stream` (docs/stream.md). It must not know Blender."""
import json
import struct
from dataclasses import dataclass

import numpy as np

PREFIX = struct.Struct("<4sIQQ")
MAGIC, VERSION = b"NPHF", 1
MAX_BYTES = 1 << 40


class FrameError(Exception):
    """The stream does not hold frames of this version."""


@dataclass
class Frame:
    header: dict
    payload: bytes

    @property
    def kind(self):
        return self.header["kind"]

    def layers(self):
        """Height x width x channels of each layer by name, the top row first."""
        x0, y0, x1, y1 = self.header["window"]
        found, begin = {}, 0
        for layer in self.header["layers"]:
            shape = (y1 - y0, x1 - x0, len(layer["channels"]))
            count = shape[0] * shape[1] * shape[2]
            values = np.frombuffer(self.payload, dtype="<f4", count=count, offset=begin)
            found[layer["name"]] = values.reshape(shape)
            begin += 4 * count
        return found


def _read_exactly(file, count):
    data = file.read(count)
    if len(data) < count:
        raise EOFError
    return data


def read_frame(file):
    """The next frame; None at the end of the stream, even in the middle of a frame."""
    try:
        magic, version, header_bytes, payload_bytes = PREFIX.unpack(
            _read_exactly(file, PREFIX.size))
        if magic != MAGIC or version != VERSION or header_bytes + payload_bytes > MAX_BYTES:
            raise FrameError("the program's output is not understood, expected frames of version "
                             f"{VERSION}: program and add-on are of different versions")
        header = json.loads(_read_exactly(file, header_bytes))
        return Frame(header, _read_exactly(file, payload_bytes))
    except EOFError:
        return None
