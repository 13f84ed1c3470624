"""Images of Blender as grids of linear colours."""
import os

import numpy as np

from . import values

DIRECT = {  # file format and colour space: the encoding of bytes
    ("PNG", "sRGB"): "sRGB",
    ("PNG", "Non-Color"): "linear",
    ("JPEG", "sRGB"): "sRGB",
    ("OPEN_EXR", "Linear"): None,
    ("OPEN_EXR", "Linear Rec.709"): None,
    ("OPEN_EXR", "Non-Color"): None,
    ("HDR", "Linear"): None,
    ("HDR", "Linear Rec.709"): None,
    ("HDR", "Non-Color"): None,
}


def linear_from_srgb(colors):
    return np.where(colors <= 0.04045, colors / 12.92, ((colors + 0.055) / 1.055) ** 2.4)


def _all_pixels(image):
    """Height x width x 4, the top row first, as stored."""
    width, height = image.size
    pixels = np.empty(width * height * image.channels, dtype=np.float32)
    image.pixels.foreach_get(pixels)
    pixels = pixels.reshape(height, width, image.channels)[::-1]
    if image.channels == 4:
        return pixels
    rgb = pixels[..., :3] if image.channels >= 3 else np.repeat(pixels[..., :1], 3, axis=-1)
    return np.concatenate([rgb, np.ones((height, width, 1), dtype=np.float32)], axis=-1)


def linear_colors(image):
    """Height x width x 3, the top row first. Pixels of byte images are sRGB unless Non-Color."""
    colors = _all_pixels(image)[..., :3]
    if not image.is_float and image.colorspace_settings.name == "sRGB":
        colors = linear_from_srgb(colors)
    return np.ascontiguousarray(colors, dtype=np.float32)


def _alpha(image):
    return np.repeat(_all_pixels(image)[..., 3:], 3, axis=-1)


def _is_grey(image):
    """True for files of one channel; `depth` has the bits of all channels of a pixel."""
    return image.depth == (32 if image.is_float else 8)


def _source(image):
    """The file of an image if the program can read it as it is, or None."""
    import bpy
    key = (image.file_format, image.colorspace_settings.name)
    if image.source != "FILE" or image.packed_file or image.is_dirty or key not in DIRECT:
        return None
    path = os.path.abspath(bpy.path.abspath(image.filepath, library=image.library))
    endings = {"PNG": (".png",), "JPEG": (".jpg", ".jpeg"), "OPEN_EXR": (".exr",), "HDR": (".hdr",)}
    if not os.path.isfile(path) or not path.lower().endswith(endings[image.file_format]):
        return None
    return values.Source(path, DIRECT[key], _is_grey(image))


def grid(image, output, uv, extension, closest, report):
    """The "Color" or "Alpha" of an image; magenta with a warning if it cannot be read."""
    if image is None or image.size[0] == 0 or image.size[1] == 0:
        report.warn(f"image '{image.name if image else ''}'",
                    "it cannot be read, it is drawn in magenta")
        return values.color((1, 0, 1))
    if image.source in ("MOVIE", "SEQUENCE", "TILED"):
        report.warn(f"image '{image.name}'", "only one frame or tile of it is used")
    key = f"{image.name_full}"
    if output == "Alpha":
        return values.Grid("alpha of " + key, lambda: _alpha(image), uv, extension, closest)
    return values.Grid(key, lambda: linear_colors(image), uv, extension, closest, _source(image))
