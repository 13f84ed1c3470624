"""Where the program is, and what it says about itself. It must not know Blender."""
import functools
import os
import shutil
import subprocess

REPOSITORY = os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "..", "..")
PREFERENCES = "the add-on's preferences (Edit > Preferences > Add-ons > Nephroid)"


def find_program(wanted=""):
    """The path of the program, "" if there is none: the wanted one and no other; if none is
    wanted that of PATH, else that of the repository."""
    built = os.path.join(REPOSITORY, "build", "release", "bin", "nephroid")
    for path in [wanted] if wanted else [shutil.which("nephroid"), os.path.normpath(built)]:
        if path and os.path.isfile(path) and os.access(path, os.X_OK):
            return path
    return ""


def no_program(wanted=""):
    """Why find_program() has found none."""
    if wanted:
        return f"'{wanted}' is not found or not executable: set the path in {PREFERENCES}"
    return f"the program nephroid is not found: set its path in {PREFERENCES}"


@functools.lru_cache(maxsize=64)
def route_names(program, integrator):
    """The routes of an integrator, in their order; none if the program cannot be asked."""
    try:
        asked = subprocess.run([program, "routes", "--integrator", integrator],
                               capture_output=True, text=True, timeout=5, check=True)
    except (OSError, subprocess.SubprocessError):
        return ()
    lines = asked.stdout.splitlines()[1:]  # below the title, one indented line a route
    names = []
    for line in lines:
        if not line.startswith("  "):
            break
        names.append(line.split()[0])
    return tuple(names)
