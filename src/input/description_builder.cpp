// The graphics state: transforms, scopes, defaults and the options before WorldBegin. Functions
// that add to the world are in description_builder_world.cpp.
#include "input/description_builder.h"

#include <algorithm>
#include <array>
#include <utility>

#include "input/spelling.h"
#include "input/transform_directives.h"

namespace nephroid {
namespace {

const std::vector<std::string>& color_space_names() {
  static const std::vector<std::string> names = {"srgb", "rec2020", "aces2065-1", "dci-p3"};
  return names;
}

template <class Value>
std::vector<std::string> keys_of(const std::map<std::string, Value>& map) {
  std::vector<std::string> keys;
  for (const auto& entry : map) keys.push_back(entry.first);
  return keys;
}

void expect_affine(const Mat44d& m, const char* directive, const SourceLocation& where) {
  if (!is_affine(m))
    throw SceneError(where, std::string(directive) +
                                " gives a projective matrix, expected 0 0 0 1 in its last column");
}

}  // namespace

void DescriptionBuilder::concat_transform(const Mat44d& m, const char* directive,
                                          const SourceLocation& where) {
  const Mat44d start = state_.start_active ? m * state_.ctm.start : state_.ctm.start;
  const Mat44d end = state_.end_active ? m * state_.ctm.end : state_.ctm.end;
  if (is_singular(m) || !is_invertible(start) || !is_invertible(end)) {
    throw SceneError(where, std::string(directive) +
                                " gives a singular matrix, expected one that can be inverted");
  }
  expect_affine(m, directive, where);
  state_.ctm = {start, end};
}

void DescriptionBuilder::look_at(const Mat44d& m, const Vec3d& up, const SourceLocation& where) {
  concat_transform(m, "LookAt", where);
  if (state_.start_active) state_.ctm.start.multDirMatrix(up, state_.up_in_camera.emplace());
}

void DescriptionBuilder::set_transform(const Mat44d& m, const SourceLocation& where) {
  if (is_singular(m) || !is_invertible(m))
    throw SceneError(where, "Transform is a singular matrix, expected one that can be inverted");
  expect_affine(m, "Transform", where);
  if (state_.start_active) {
    state_.ctm.start = m;
    state_.up_in_camera.reset();
  }
  if (state_.end_active) state_.ctm.end = m;
}

void DescriptionBuilder::set_active_transforms(bool start, bool end) {
  state_.start_active = start;
  state_.end_active = end;
}

void DescriptionBuilder::set_transform_times(double start, double end,
                                             const SourceLocation& where) {
  if (end < start)
    throw SceneError(where, "TransformTimes ends before it starts, expected start <= end");
  if (scene_.camera && !keeps_camera_)
    diagnostics_.warn(where,
                      "TransformTimes after Camera: pbrt-v4 would not use these times for the "
                      "camera, here the camera uses them, too");
  scene_.transform_start_time = static_cast<float>(start);
  scene_.transform_end_time = static_cast<float>(end);
}

void DescriptionBuilder::name_coordinate_system(const std::string& name) {
  coordinate_systems_[name] = state_.ctm;
}

void DescriptionBuilder::use_coordinate_system(const std::string& name,
                                               const SourceLocation& where) {
  const auto found = coordinate_systems_.find(name);
  if (found != coordinate_systems_.end()) {
    state_.ctm = found->second;
    state_.up_in_camera.reset();
    return;
  }
  diagnostics_.warn(where, "coordinate system \"" + name +
                               "\" is not defined, the transform stays as it is" +
                               did_you_mean(name, keys_of(coordinate_systems_)));
}

void DescriptionBuilder::push_scope(Scope::Kind kind, const SourceLocation& where) {
  scopes_.push_back({kind, where, state_, {}});
}

void DescriptionBuilder::pop_scope() {
  state_ = std::move(scopes_.back().state);
  scopes_.pop_back();
}

void DescriptionBuilder::attribute_begin(const SourceLocation& where) {
  push_scope(Scope::Kind::kAttribute, where);
}

void DescriptionBuilder::attribute_end(const SourceLocation& where) {
  if (scopes_.empty() || scopes_.back().kind == Scope::Kind::kImport)
    throw SceneError(where, "AttributeEnd without AttributeBegin");
  if (scopes_.back().kind == Scope::Kind::kObject) {
    throw SceneError(where, "AttributeEnd, but the ObjectBegin at " +
                                scopes_.back().where.to_string() +
                                " is still open, expected ObjectEnd");
  }
  pop_scope();
}

void DescriptionBuilder::object_begin(const std::string& name, const SourceLocation& where) {
  if (object_) {
    throw SceneError(where, "ObjectBegin inside of the object \"" + object_->name +
                                "\" that was begun at " + object_->where.to_string() +
                                ", expected ObjectEnd first");
  }
  const auto [entry, is_new] = scene_.objects.try_emplace(name);
  if (!is_new) {
    throw SceneError(
        where, "object \"" + name + "\" is already defined at " + entry->second.where.to_string());
  }
  object_ = &entry->second;
  object_->name = name;
  object_->where = where;
  warned_of_area_light_ = false;
  push_scope(Scope::Kind::kObject, where);
}

void DescriptionBuilder::object_end(const SourceLocation& where) {
  if (!object_ || scopes_.back().kind == Scope::Kind::kImport)
    throw SceneError(where, "ObjectEnd without ObjectBegin");
  if (scopes_.back().kind == Scope::Kind::kAttribute) {
    throw SceneError(where, "ObjectEnd, but the AttributeBegin at " +
                                scopes_.back().where.to_string() +
                                " is still open, expected AttributeEnd");
  }
  pop_scope();
  object_ = nullptr;
}

void DescriptionBuilder::import_begin(const SourceLocation& where) {
  push_scope(Scope::Kind::kImport, where);
  scopes_.back().coordinate_systems = coordinate_systems_;
}

void DescriptionBuilder::import_end() {
  const auto import = std::find_if(scopes_.rbegin(), scopes_.rend(), [](const Scope& scope) {
    return scope.kind == Scope::Kind::kImport;
  });
  check_nothing_open(scopes_.rend() - import);
  coordinate_systems_ = std::move(scopes_.back().coordinate_systems);
  pop_scope();
}

void DescriptionBuilder::check_nothing_open(size_t scopes) const {
  if (scopes_.size() <= scopes) return;
  const Scope& open = scopes_.back();
  throw SceneError(open.where, open.kind == Scope::Kind::kObject
                                   ? "ObjectBegin without ObjectEnd"
                                   : "AttributeBegin without AttributeEnd");
}

void DescriptionBuilder::set_defaults(const std::string& target, std::vector<Parameter> parameters,
                                      const SourceLocation& target_where) {
  const auto* const found =
      std::find(kAttributeTargets.begin(), kAttributeTargets.end(), std::string_view(target));
  if (found == kAttributeTargets.end()) {
    throw SceneError(target_where,
                     "unknown attribute target \"" + target +
                         "\", expected \"shape\", \"light\", \"material\", \"medium\" or "
                         "\"texture\"");
  }
  auto& defaults = state_.defaults[found - kAttributeTargets.begin()];
  for (Parameter& parameter : parameters) {
    // A default applies wherever it is known, so it is never reported as unknown.
    parameter.used = true;
    std::erase_if(defaults, [&](const Parameter& old) { return old.name == parameter.name; });
    defaults.push_back(std::move(parameter));
  }
}

void DescriptionBuilder::add_defaults(AttributeTarget target, ParameterSet& parameters) const {
  for (const Parameter& parameter : state_.defaults[static_cast<size_t>(target)]) {
    const bool given =
        std::any_of(parameters.list.begin(), parameters.list.end(),
                    [&](const Parameter& other) { return other.name == parameter.name; });
    if (!given) parameters.list.push_back(parameter);
  }
}

void DescriptionBuilder::set_color_space(const std::string& name,
                                         const SourceLocation& name_where) {
  const std::string lower = lower_case(name);
  const std::vector<std::string>& names = color_space_names();
  if (std::find(names.begin(), names.end(), lower) == names.end()) {
    throw SceneError(name_where,
                     "unknown colour space \"" + name +
                         "\", expected \"srgb\", \"rec2020\", \"aces2065-1\" or \"dci-p3\"");
  }
  state_.color_space = lower;
}

void DescriptionBuilder::set_medium_interface(std::string inside, std::string outside) {
  state_.inside_medium = std::move(inside);
  state_.outside_medium = std::move(outside);
}

void DescriptionBuilder::world_begin() {
  in_world_ = true;
  state_.ctm = {};
  set_active_transforms(true, true);
  coordinate_systems_["world"] = state_.ctm;
}

void DescriptionBuilder::keep_camera(const Parameter& option) {
  if (in_world_)
    diagnostics_.warn(
        option.where,
        "option \"keepcamera\" has no effect after WorldBegin, expected it before the "
        "Camera");
  keeps_camera_ = option.bools.front();
}

void DescriptionBuilder::add_option(Parameter option) {
  if (option.name == "keepcamera") {
    keep_camera(option);
    return;
  }
  std::erase_if(scene_.options, [&](const Parameter& old) { return old.name == option.name; });
  scene_.options.push_back(std::move(option));
}

void DescriptionBuilder::set_once(std::optional<DirectiveDescription>& slot,
                                  DirectiveDescription directive, const char* name) {
  if (slot) {
    diagnostics_.warn(directive.where, std::string(name) + " was already given at " +
                                           slot->where.to_string() + ", the last one counts");
  }
  slot = std::move(directive);
}

void DescriptionBuilder::set_film(DirectiveDescription directive) {
  if (keeps_camera_ && scene_.film) return;
  scene_.color_space = state_.color_space;
  set_once(scene_.film, std::move(directive), "Film");
}

void DescriptionBuilder::set_camera(DirectiveDescription directive) {
  // Lights and media in the space of an ignored camera stay where it is.
  coordinate_systems_["camera"] = {state_.ctm.start.inverse(), state_.ctm.end.inverse()};
  if (keeps_camera_ && scene_.camera) return;
  if (scene_.camera) {
    diagnostics_.warn(directive.where, "Camera was already given at " +
                                           scene_.camera->where.to_string() +
                                           ", the last one counts");
  }
  CameraDescription& camera = scene_.camera.emplace();
  static_cast<DirectiveDescription&>(camera) = std::move(directive);
  camera.world_to_camera = state_.ctm;
  camera.up = state_.up_in_camera.value_or(camera.up);
  camera.medium = state_.outside_medium;
}

}  // namespace nephroid
