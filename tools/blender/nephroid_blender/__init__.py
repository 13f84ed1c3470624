"""Nephroid as a render engine of Blender. The program runs as a subprocess."""
bl_info = {
    "name": "Nephroid",
    "author": "The Nephroid authors",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "Render properties > Render Engine",
    "description": "Renders caustics without set-up, by the program nephroid",
    "category": "Render",
}


def _modules():
    from . import engine, panels, preferences, settings
    return preferences, settings, engine, panels


def register():
    for module in _modules():
        module.register()


def unregister():
    for module in reversed(_modules()):
        module.unregister()
