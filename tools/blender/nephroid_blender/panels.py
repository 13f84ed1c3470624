"""Panels of the render properties, and the standard panels that fit the engine."""
import bpy

ENGINE = "NEPHROID"

# Panels of Eevee whose settings the export reads.
SHARED = ("DATA_PT_EEVEE_light", "EEVEE_MATERIAL_PT_context_material", "EEVEE_MATERIAL_PT_surface",
          "EEVEE_MATERIAL_PT_volume", "EEVEE_WORLD_PT_surface", "RENDER_PT_format",
          "VIEWLAYER_PT_layer_passes", "EEVEE_NEXT_MATERIAL_PT_surface",
          "EEVEE_NEXT_MATERIAL_PT_volume")
UNUSED = ("VIEWLAYER_PT_filter", "RENDER_PT_freestyle")


class _Panel:
    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    bl_context = "render"
    COMPAT_ENGINES = {ENGINE}

    @classmethod
    def poll(cls, context):
        return context.engine in cls.COMPAT_ENGINES

    def column(self):
        self.layout.use_property_split = True
        self.layout.use_property_decorate = False
        return self.layout.column()


class NEPHROID_PT_render(_Panel, bpy.types.Panel):
    bl_label = "Render"

    def draw(self, context):
        settings, column = context.scene.nephroid, self.column()
        column.prop(settings, "integrator")
        column.prop(settings, "time_limit")
        column.prop(settings, "noise")
        column.prop(settings, "passes")
        column.prop(settings, "reject_outliers")
        column.prop(settings, "max_depth")
        column.prop(settings, "seed")


class NEPHROID_PT_viewport(_Panel, bpy.types.Panel):
    bl_label = "Viewport"

    def draw(self, context):
        settings, column = context.scene.nephroid, self.column()
        column.prop(settings, "viewport_time")
        column.prop(settings, "viewport_scale")


class NEPHROID_PT_motion_blur(_Panel, bpy.types.Panel):
    bl_label = "Motion Blur"

    def draw_header(self, context):
        self.layout.prop(context.scene.render, "use_motion_blur", text="")

    def draw(self, context):
        self.column().prop(context.scene.render, "motion_blur_shutter")


class NEPHROID_PT_passes(_Panel, bpy.types.Panel):
    bl_label = "Passes"
    bl_context = "view_layer"

    def draw(self, context):
        settings, layer, column = context.scene.nephroid, context.view_layer, self.column()
        column.prop(settings, "route_passes")
        column.prop(settings, "albedo_pass")
        column.prop(layer, "use_pass_z")
        column.prop(layer, "use_pass_normal")
        row = self.layout.row()
        row.template_list("NEPHROID_UL_aovs", "", settings, "aovs", settings, "active_aov", rows=3)
        buttons = row.column(align=True)
        buttons.operator("nephroid.add_aov", icon="ADD", text="")
        buttons.operator("nephroid.remove_aov", icon="REMOVE", text="")


class NEPHROID_UL_aovs(bpy.types.UIList):
    def draw_item(self, context, layout, data, item, icon, active_data, active_property, index):
        layout.prop(item, "name", text="", emboss=False)
        layout.prop(item, "expression", text="", emboss=False)


class NEPHROID_OT_add_aov(bpy.types.Operator):
    """Add a layer of the light of all paths that match an expression"""
    bl_idname = "nephroid.add_aov"
    bl_label = "Add Layer"

    def execute(self, context):
        context.scene.nephroid.aovs.add()
        context.view_layer.update_render_passes()
        return {"FINISHED"}


class NEPHROID_OT_remove_aov(bpy.types.Operator):
    """Remove the layer"""
    bl_idname = "nephroid.remove_aov"
    bl_label = "Remove Layer"

    def execute(self, context):
        settings = context.scene.nephroid
        settings.aovs.remove(settings.active_aov)
        context.view_layer.update_render_passes()
        return {"FINISHED"}


CLASSES = (NEPHROID_PT_render, NEPHROID_PT_viewport, NEPHROID_PT_motion_blur, NEPHROID_PT_passes,
           NEPHROID_UL_aovs, NEPHROID_OT_add_aov, NEPHROID_OT_remove_aov)


def _shared_panels():
    for panel in bpy.types.Panel.__subclasses__():
        engines = getattr(panel, "COMPAT_ENGINES", None)
        if engines is not None and panel.__name__ not in UNUSED and \
                ("BLENDER_RENDER" in engines or panel.__name__ in SHARED):
            yield panel


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)
    for panel in _shared_panels():
        panel.COMPAT_ENGINES.add(ENGINE)


def unregister():
    for panel in _shared_panels():
        panel.COMPAT_ENGINES.discard(ENGINE)
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
