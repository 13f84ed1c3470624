"""Writes a Blender scene as a pbrt-v4 scene file with PLY meshes and images.

scene.py is the entry. Modules without `import bpy` hold what needs no Blender.
"""
