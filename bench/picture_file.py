"""Reads channels of pictures, for the scripts of this folder. Needs python3-openimageio and python3-numpy."""
import numpy
import OpenImageIO as oiio


def read_channels(path, names):
    """Pixels of an EXR file as doubles, [y, x, channel], in the order of `names`."""
    picture = oiio.ImageBuf(str(path))
    present = list(picture.spec().channelnames)
    pixels = numpy.asarray(picture.get_pixels(oiio.FLOAT), dtype=numpy.float64)
    return pixels[..., [present.index(name) for name in names]]
