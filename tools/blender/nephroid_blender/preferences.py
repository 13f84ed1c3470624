"""Preferences of the add-on: the path of the program."""
import bpy
from bpy.props import StringProperty

from .program import find_program, no_program


class NephroidPreferences(bpy.types.AddonPreferences):
    bl_idname = __package__

    program: StringProperty(name="Program", subtype="FILE_PATH",
                            description="Path of the program; if empty, nephroid is looked for on "
                                        "the PATH, then in the repository of the add-on")

    def draw(self, context):
        self.layout.prop(self, "program")
        found = program_path()
        text = f"Found: {found}" if found else why_no_program()
        self.layout.label(text=text, icon="CHECKMARK" if found else "ERROR")


def _wanted():
    addon = bpy.context.preferences.addons.get(__package__)
    return bpy.path.abspath(addon.preferences.program) if addon else ""


def program_path():
    """The program to run, "" if none is found."""
    return find_program(_wanted())


def why_no_program():
    """What to tell the user where program_path() is empty."""
    return no_program(_wanted())


def register():
    bpy.utils.register_class(NephroidPreferences)


def unregister():
    bpy.utils.unregister_class(NephroidPreferences)
