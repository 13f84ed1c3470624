"""Settings of a scene, and the arguments of the program that they stand for."""
import bpy
from bpy.props import (BoolProperty, CollectionProperty, EnumProperty, FloatProperty, IntProperty,
                       PointerProperty, StringProperty)

DEFAULT_SECONDS = 60
INTEGRATORS = [
    ("mixed", "Mixed",
     "Path tracing and caustic photons, combined by multiple importance sampling"),
    ("path", "Path tracing", "Path tracing alone"),
    ("bdpt", "Bidirectional", "Bidirectional path tracing"),
    ("vcm", "VCM", "Vertex connection and merging"),
    ("bpm", "BPM", "Bidirectional photon mapping"),
    ("sppm", "SPPM", "Stochastic progressive photon mapping"),
    ("mlt", "Metropolis", "Metropolis light transport"),
    ("pssmlt", "Primary space MLT",
     "Metropolis light transport in the random numbers of path tracing"),
    ("doidge2012", "Doidge 2012",
     "Caustics by photons alone, the rest by path tracing (Doidge et al. 2012)"),
]


class NephroidAov(bpy.types.PropertyGroup):
    name: StringProperty(name="Name", description="Name of the pass", default="layer")
    expression: StringProperty(
        name="Expression", default="C.*L",
        description="Light path expression of the paths that it shows (docs/routes.md)")


class NephroidSettings(bpy.types.PropertyGroup):
    integrator: EnumProperty(name="Integrator", items=INTEGRATORS, default="mixed")
    time_limit: FloatProperty(
        name="Time", subtype="TIME", unit="TIME_ABSOLUTE", default=DEFAULT_SECONDS, min=0,
        description=f"Seconds until the render stops; 0 is no limit, but {DEFAULT_SECONDS} if "
                    "noise and passes have none either")
    noise: FloatProperty(name="Noise", default=0, min=0, precision=3,
                         description="Relative error at which the render stops; 0 is no limit")
    passes: IntProperty(name="Passes", default=0, min=0,
                        description="Passes after which the render stops; 0 is no limit")
    route_passes: BoolProperty(name="Routes as passes", default=True,
                               description="A render pass for the light of each route: caustics "
                                           "and all else")
    albedo_pass: BoolProperty(name="Albedo", default=False,
                              description="A render pass of the first surface's colour")
    aovs: CollectionProperty(type=NephroidAov)
    active_aov: IntProperty()
    reject_outliers: BoolProperty(name="Reject fireflies", default=False,
                                  description="Keep isolated bright samples out of the picture")
    seed: IntProperty(name="Seed", default=0, min=0)
    max_depth: IntProperty(name="Max depth", default=0, min=0,
                           description="Scattering events of a path; 0 is 100")
    viewport_time: FloatProperty(name="Viewport time", subtype="TIME", unit="TIME_ABSOLUTE",
                                 default=30, min=1)
    viewport_scale: EnumProperty(
        name="Viewport pixels", default="2",
        items=[("1", "1x", "Every pixel"), ("2", "2x", "Squares of two by two pixels"),
               ("4", "4x", "Squares of four by four pixels")])

    def stop_arguments(self):
        arguments = []
        if self.time_limit > 0:
            arguments += ["--time", f"{self.time_limit:.3f}s"]
        if self.noise > 0:
            arguments += ["--noise", f"{self.noise:.6g}"]
        if self.passes > 0:
            arguments += ["--passes", str(self.passes)]
        return arguments or ["--time", f"{DEFAULT_SECONDS}s"]

    def algorithm_arguments(self):
        arguments = ["--integrator", self.integrator, "--seed", str(self.seed)]
        if self.max_depth > 0:
            arguments += ["-D", f"max-depth={self.max_depth}"]
        if self.reject_outliers:
            arguments += ["--outliers", "reject"]
        for aov in self.aovs:
            arguments += ["--aov", f"{aov.name}={aov.expression}"]
        return arguments


def thread_arguments(scene):
    if scene.render.threads_mode == "FIXED":
        return ["--threads", str(scene.render.threads)]
    return []


CLASSES = (NephroidAov, NephroidSettings)


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)
    bpy.types.Scene.nephroid = PointerProperty(type=NephroidSettings)


def unregister():
    del bpy.types.Scene.nephroid
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
