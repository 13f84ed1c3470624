"""Renders a .blend file with both engines and reads the linear pictures. Runs in Blender."""
import bpy
import numpy as np


def open_scene(path):
    bpy.ops.wm.open_mainfile(filepath=path)
    scene = bpy.context.scene
    settings = scene.render.image_settings
    settings.file_format, settings.color_depth = "OPEN_EXR", "32"
    return scene


def pixels(path):
    """Height x width x 3, the bottom row first."""
    image = bpy.data.images.load(path, check_existing=False)
    values = np.empty(image.size[0] * image.size[1] * image.channels, dtype=np.float32)
    image.pixels.foreach_get(values)
    shape = (image.size[1], image.size[0], image.channels)
    bpy.data.images.remove(image)
    return values.reshape(shape)[..., :3]


def render_to(scene, path):
    scene.render.filepath = path
    bpy.ops.render.render(write_still=True)
    return pixels(path)


def cycles(scene, path, samples):
    """Path tracing without clamping and without limits that light would miss."""
    scene.render.engine = "CYCLES"
    settings = scene.cycles
    settings.device, settings.samples, settings.seed = "CPU", samples, 1
    settings.use_denoising = settings.use_adaptive_sampling = False
    settings.sample_clamp_indirect = settings.blur_glossy = 0
    for name in ("max", "diffuse", "glossy", "transmission", "transparent_max", "volume"):
        setattr(settings, f"{name}_bounces", 32)
    return render_to(scene, path)


def nephroid(scene, path, seconds):
    scene.render.engine = "NEPHROID"
    scene.nephroid.time_limit = seconds
    return render_to(scene, path)


def save_side_by_side(left, right, path):
    """Both pictures in sRGB, for people to look at."""
    both = np.clip(np.concatenate([left, right], axis=1), 0, 1)
    encoded = np.where(both <= 0.0031308, 12.92 * both, 1.055 * both ** (1 / 2.4) - 0.055)
    rgba = np.ones((*both.shape[:2], 4), dtype=np.float32)
    rgba[..., :3] = encoded
    image = bpy.data.images.new("both", both.shape[1], both.shape[0])
    image.pixels.foreach_set(rgba.ravel())
    image.filepath_raw, image.file_format = path, "PNG"
    image.save()
    bpy.data.images.remove(image)


def block_means(picture, size=20):
    height, width = (n // size * size for n in picture.shape[:2])
    blocks = picture[:height, :width].reshape(height // size, size, width // size, size, 3)
    return blocks.mean(axis=(1, 3))
