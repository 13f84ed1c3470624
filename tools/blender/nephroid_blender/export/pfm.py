"""PFM images, 32-bit floats. It must not know Blender."""
import numpy as np


def write_pfm(path, pixels):
    """Writes height x width x 3 or height x width values, the top row first."""
    height, width = pixels.shape[:2]
    kind = "PF" if pixels.ndim == 3 else "Pf"
    with open(path, "wb") as file:
        file.write(f"{kind}\n{width} {height}\n-1.0\n".encode("ascii"))
        file.write(np.flipud(pixels).astype("<f4").tobytes())
