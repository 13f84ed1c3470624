#include "input/mitsuba/shape_plugins.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "input/mitsuba/bsdf_plugins.h"
#include "input/mitsuba/emitter_plugins.h"
#include "input/mitsuba/medium_plugins.h"
#include "input/mitsuba/parameter_values.h"
#include "input/mitsuba/shape_geometry.h"
#include "input/mitsuba/subsurface_plugins.h"

namespace nephroid::mitsuba {
namespace {

using Shapes = std::vector<ShapeDescription>;

struct ShapeRow : Plugin {
  GeometryWriter geometry = nullptr;  ///< null for shapes of shapes
};
using enum PluginSupport;
constexpr const char* kNoSuchShape = "this renderer has no such shape";
constexpr ShapeRow kShapes[] = {
    {{"shape", "obj", kLoaded,
      "BSDFs may have the names of materials in the file; of 0.6, MTL materials become principled"},
     obj_geometry},
    {{"shape", "ply"}, ply_geometry},
    {{"shape", "serialized", kLoaded, "versions 3 and 4"}, serialized_geometry},
    {{"shape", "rectangle"}, rectangle_geometry},
    {{"shape", "cube"}, cube_geometry},
    {{"shape", "sphere"}, sphere_geometry},
    {{"shape", "disk", kLoaded, "uv as in pbrt-v4"}, disk_geometry},
    {{"shape", "cylinder", kLoaded, "uv as in pbrt-v4"}, cylinder_geometry},
    {{"shape", "hair", kLoaded, "text and BINARY_HAIR"}, hair_geometry},
    {{"shape", "bsplinecurve", kLoaded, "radii are linear along a curve"}, spline_geometry},
    {{"shape", "linearcurve", kLoaded, "radii are linear along a curve"}, polyline_geometry},
    {{"shape", "shapegroup"}},
    {{"shape", "instance"}},
    {{"shape", "merge", kLoaded, "its shapes stay apart; repeated ones are limited"}},
    {{"shape", "heightfield", kRefused, kNoSuchShape}},
    {{"shape", "deformable", kRefused, kNoSuchShape}},
    {{"shape", "sdfgrid", kRefused, kNoSuchShape}},
    {{"shape", "ellipsoids", kRefused, kNoSuchShape}},
    {{"shape", "ellipsoidsmesh", kRefused, kNoSuchShape}},
};

/// Mitsuba's default: black on lamps, nothing on boundaries of media, else grey.
Surface default_surface(PluginProperties& p, bool emits, bool is_boundary) {
  Surface surface;
  if (is_boundary && !emits && p.context().is_before_version_2()) {
    surface.material = null_material(p.context(), p.where());
  } else if (emits) {
    surface.material = black_material(p.context(), p.where());
  } else {
    MaterialDescription grey = directive<MaterialDescription>("diffuse", p.where());
    grey.name = p.context().unique_name(p.object());
    surface.material = grey.name;
    surface.is_one_sided = true;
    p.context().scene.materials.push_back(std::move(grey));
  }
  return surface;
}

struct Attachments {
  Surface surface;
  std::optional<DirectiveDescription> light;
  std::string inside, outside;
};

/// The BSDFs of the whole shape.
std::vector<const Child*> own_bsdfs(PluginProperties& p, const Geometry& geometry) {
  std::vector<const Child*> bsdfs = p.children("bsdf");
  std::erase_if(bsdfs, [&](const Child* child) {
    return std::find(geometry.of_parts.begin(), geometry.of_parts.end(), child) !=
           geometry.of_parts.end();
  });
  return bsdfs;
}

Attachments attachments(PluginProperties& p, const Geometry& geometry) {
  Attachments a;
  const std::vector<const Child*> bsdfs = own_bsdfs(p, geometry), emitters = p.children("emitter");
  if (bsdfs.size() > 1) warn_approximated(p, "it has several BSDFs, the first one is used");
  if (emitters.size() > 1) warn_approximated(p, "it has several emitters, the first one is used");
  if (!emitters.empty()) a.light = area_light(p.context(), *emitters[0]->object, p.object().id);
  if (const Object* medium = p.child("medium", "interior"))
    a.inside = write_medium(p.context(), *medium);
  if (const Object* medium = p.child("medium", "exterior"))
    a.outside = write_medium(p.context(), *medium);
  const bool is_boundary = !a.inside.empty() || !a.outside.empty();
  const bool have_all =
      !geometry.surfaces.empty() && std::find(geometry.surfaces.begin(), geometry.surfaces.end(),
                                              std::nullopt) == geometry.surfaces.end();
  if (have_all) return a;
  a.surface = bsdfs.empty() ? default_surface(p, a.light.has_value(), is_boundary)
                            : write_bsdf(p.context(), *bsdfs[0]->object);
  if (const Object* below = p.first_child("subsurface"))
    a.surface = write_subsurface(p.context(), *below, a.surface);
  return a;
}

void attach(const Attachments& a, const Surface& surface, bool flips, ShapeDescription& shape) {
  shape.reverse_orientation = shape.reverse_orientation != flips;
  shape.material = {-1, surface.material, shape.where};
  shape.area_light = a.light;
  shape.inside_medium = a.inside;
  shape.outside_medium = a.outside;
  if (surface.alpha) shape.parameters.list.push_back(*surface.alpha);
}

void note_one_sided(ImportContext& context, const SourceLocation& where) {
  if (context.one_sided_shapes++ == 0) context.first_one_sided = where;
}

void add_shapes(ImportContext& context, const Object& object, Shapes& into);

void add_geometry(PluginProperties& p, const ShapeRow& row, Shapes& into) {
  Geometry geometry = row.geometry(p);
  const Attachments a = attachments(p, geometry);
  const bool flips = p.boolean("flip_normals", false);
  bool is_one_sided = false;
  for (size_t i = 0; i < geometry.shapes.size(); ++i) {
    const bool has_own = i < geometry.surfaces.size() && geometry.surfaces[i];
    const Surface& surface = has_own ? *geometry.surfaces[i] : a.surface;
    is_one_sided = is_one_sided || surface.is_one_sided;
    attach(a, surface, flips, geometry.shapes[i]);
    into.push_back(std::move(geometry.shapes[i]));
  }
  if (geometry.is_open && is_one_sided && !a.light) note_one_sided(p.context(), p.where());
}

/// The object of a shape group, which is written at its first use.
std::string write_group(ImportContext& context, const Object& group) {
  const auto known = context.groups.find(&group);
  if (known != context.groups.end()) return known->second;
  PluginProperties p(group, context);
  ObjectDescription object;
  object.name = context.unique_name(group);
  object.where = group.where;
  for (const Child* child : p.children("shape")) {
    if (child->object->type == "instance" || child->object->type == "shapegroup")
      throw SceneError(child->where,
                       "a shape group has an instance or a group in it, expected "
                       "other shapes");
    add_shapes(context, *child->object, object.shapes);
  }
  for (ShapeDescription& shape : object.shapes)
    if (shape.area_light) {
      context.diagnostics.warn(shape.where, "emitters of shape groups do not emit");
      shape.area_light.reset();
    }
  p.report_unused();
  context.scene.objects[object.name] = object;
  return context.groups[&group] = object.name;
}

void add_instance(PluginProperties& p) {
  const Object* group = p.first_child("shape");
  if (!group || group->type != "shapegroup")
    throw SceneError(p.where(),
                     "an instance has no shape group in it, expected a reference to one");
  InstanceDescription instance;
  instance.object = write_group(p.context(), *group);
  instance.transform = p.transform();
  instance.where = p.where();
  p.context().scene.instances.push_back(std::move(instance));
}

/// Counts numbers of shapes that are written again. References can double their count with each
/// line of the file.
void count_copied(ImportContext& context, size_t numbers, const SourceLocation& where) {
  constexpr size_t kMaxCopied = size_t{1} << 26;
  context.copied += numbers;
  if (context.copied > kMaxCopied)
    throw SceneError(where,
                     "references repeat shapes of more than 2^26 numbers, expected fewer; a "
                     "shapegroup with instances repeats them without copies");
}

size_t count_numbers(const Shapes& shapes, size_t first) {
  size_t count = 0;
  for (size_t i = first; i < shapes.size(); ++i)
    for (const Parameter& parameter : shapes[i].parameters.list) count += parameter.numbers.size();
  return count;
}

void add_shapes(ImportContext& context, const Object& object, Shapes& into) {
  constexpr size_t kNumbersOfPlugin = 1024;  ///< the cost of a plug-in without any
  const bool is_copy = !context.written_shapes.insert(&object).second;
  if (is_copy) count_copied(context, kNumbersOfPlugin, object.where);
  PluginProperties p(object, context);
  const ShapeRow& row = plugin_row(kShapes, object, context.diagnostics);
  if (row.geometry) {
    const size_t first = into.size();
    add_geometry(p, row, into);
    if (is_copy) count_copied(context, count_numbers(into, first), object.where);
  } else if (object.type == "instance") {
    add_instance(p);
  } else if (object.type == "shapegroup") {
    write_group(context, object);
    return;
  } else {
    for (const Child* child : p.children("shape")) add_shapes(context, *child->object, into);
  }
  p.report_unused();
}

}  // namespace

void write_shape(ImportContext& context, const Object& object) {
  add_shapes(context, object, context.scene.shapes);
}

std::vector<Plugin> shape_plugins() {
  return std::vector<Plugin>(std::begin(kShapes), std::end(kShapes));
}

}  // namespace nephroid::mitsuba
