#include "input/mitsuba/object_reader.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <map>
#include <optional>
#include <utility>

#include "input/file_bytes.h"
#include "input/foreign_file.h"
#include "input/mitsuba/references.h"
#include "input/mitsuba/scene_parameters.h"
#include "input/mitsuba/transform_element.h"
#include "input/mitsuba/value_text.h"
#include "input/mitsuba/xml_text.h"
#include "input/token_stream.h"
#include "input/transform_directives.h"

namespace nephroid::mitsuba {
namespace {

constexpr int kMaxNesting = 64;    ///< of elements
constexpr int kMaxIncludes = 256;  ///< in the whole scene; files can include others twice

constexpr std::array kProperties = {"boolean", "integer", "float",  "string",    "rgb", "srgb",
                                    "color",   "point",   "vector", "blackbody", "long"};
constexpr std::array kObjects = {"shape",    "bsdf",      "emitter", "sensor",     "medium",
                                 "texture",  "film",      "rfilter", "integrator", "phase",
                                 "sampler",  "volume",    "scene",   "camera",     "luminaire",
                                 "spectrum", "subsurface"};

template <size_t N>
bool is_one_of(const std::array<const char*, N>& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Elements that Mitsuba 0.5 named otherwise.
std::string current_tag(const std::string& tag) {
  if (tag == "camera") return "sensor";
  return tag == "luminaire" ? "emitter" : tag;
}

class ObjectReader {
 public:
  ObjectReader(SceneFiles& files, const ImportOptions& options, Diagnostics& diagnostics)
      : files_(files), options_(options), parameters_(options.defines), diagnostics_(diagnostics) {}

  Document read(const std::string& path) {
    files_.set_top(path);
    Document document(options_.allow_outside);
    document.scene.tag = "scene";
    read_file(path, shown_name(path), document.scene, document, 0);
    resolve_references(document.scene, ids_);
    parameters_.report_unused(document.scene.where, diagnostics_);
    document.parameters = parameters_.values();
    return document;
  }

 private:
  using Node = pugi::xml_node;

  /// Reads the objects of a file into `into`, which is the scene but for included files.
  void read_file(const std::string& path, const std::string& shown, Object& into,
                 Document& document, int depth) {
    std::string bytes = files_.read(path);
    const XmlText text(bytes, shown);
    const Node root = text.root();
    const bool is_top = open_files_.empty(), is_scene = root.name() == std::string("scene");
    // An included file can be one object.
    if (!is_scene && (is_top || !is_one_of(kObjects, root.name()))) {
      const std::string foreign = foreign_file_error(bytes, path);
      throw SceneError(text.start(), foreign.empty() ? "this has no element <scene>, expected a "
                                                       "Mitsuba scene"
                                                     : foreign);
    }
    if (is_top) {
      document.scene.where = text.place(root);
      document.version = major_version(text, root);
    }
    open_files_.push_back(path);
    if (is_scene)
      read_children(text, root, into, document, depth + 1);
    else
      read_element(text, root, into, document, depth + 1);
    open_files_.pop_back();
  }

  static int major_version(const XmlText& text, const Node& root) {
    const std::string version = root.attribute("version").value();
    int major = 0;
    const auto result = std::from_chars(version.data(), version.data() + version.size(), major);
    if (result.ec != std::errc() || major < 0 || major > 3)
      throw SceneError(text.place(root), "<scene> has version \"" + version.substr(0, 40) +
                                             "\", expected 0.5, 0.6, 2 or 3");
    return major;
  }

  void read_children(const XmlText& text, const Node& parent, Object& into, Document& document,
                     int depth) {
    if (depth > kMaxNesting)
      throw SceneError(text.place(parent), "elements are nested more than " +
                                               std::to_string(kMaxNesting) +
                                               " levels deep, expected fewer");
    for (const Node& node : parent.children()) {
      if (node.type() != pugi::node_element) {
        if (node.type() == pugi::node_pcdata || node.type() == pugi::node_cdata)
          diagnostics_.warn(text.place(parent), "text in <" + std::string(parent.name()) +
                                                    "> is ignored, expected elements");
        continue;
      }
      read_element(text, node, into, document, depth);
    }
  }

  void read_element(const XmlText& text, const Node& node, Object& into, Document& document,
                    int depth) {
    const std::string tag = node.name();
    const bool is_plugin =
        is_one_of(kObjects, tag) && (tag != "spectrum" || node.attribute("type"));
    if (is_plugin) {
      add_object(text, node, into, document, depth);
    } else if (is_one_of(kProperties, tag) || tag == "spectrum" || tag == "transform" ||
               tag == "animation") {
      add_property(text, node, into);
    } else if (tag == "ref") {
      into.children.push_back({snake_case(value(text, node, "name")), required(text, node, "id"),
                               nullptr, text.place(node)});
    } else if (!read_directive(text, node, into, document, depth)) {
      throw SceneError(text.place(node), "<" + tag + "> in <" + into.tag +
                                             "> is unknown, expected a Mitsuba element");
    }
  }

  /// Reads an element that is neither plug-in nor property. False if it is unknown.
  bool read_directive(const XmlText& text, const Node& node, Object& into, Document& document,
                      int depth) {
    const std::string tag = node.name();
    if (tag == "default")
      parameters_.set_default(required(text, node, "name"), value(text, node, "value"));
    else if (tag == "include")
      include(text, node, into, document, depth);
    else if (tag == "alias")
      ids_.add_alias(required(text, node, "id"), required(text, node, "as"), text.place(node));
    else if (tag == "path")
      document.file_names.add_folder(required(text, node, "value"));
    else
      return false;
    return true;
  }

  void include(const XmlText& text, const Node& node, Object& into, Document& document, int depth) {
    const SourceLocation where = text.place(node);
    const std::string name =
        document.file_names.find(files_, required(text, node, "filename"), where);
    const std::string path = files_.path_of(name);
    if (std::find(open_files_.begin(), open_files_.end(), path) != open_files_.end())
      throw SceneError(where, "\"" + name + "\" includes itself");
    if (open_files_.size() > kMaxNesting)
      throw SceneError(where, "files are included more than " + std::to_string(kMaxNesting) +
                                  " levels deep, expected fewer");
    if (++includes_ > kMaxIncludes)
      throw SceneError(where, "the scene includes more than " + std::to_string(kMaxIncludes) +
                                  " files, expected fewer");
    try {
      read_file(path, path, into, document, depth - 1);
    } catch (const IoError& error) {
      throw SceneError(where, "\"" + name + "\" cannot be included (" + error.what() + ")");
    }
  }

  void add_object(const XmlText& text, const Node& node, Object& into, Document& document,
                  int depth) {
    Object* object = document.objects.emplace_back(std::make_unique<Object>()).get();
    object->tag = current_tag(node.name());
    object->where = text.place(node);
    object->type = value(text, node, "type");
    object->id = value(text, node, "id");
    if (object->type.empty())
      throw SceneError(object->where,
                       "<" + object->tag + "> has no \"type\", expected the name of a plug-in");
    read_children(text, node, *object, document, depth + 1);
    if (!object->id.empty()) ids_.add(object->id, object);
    into.children.push_back({snake_case(value(text, node, "name")), {}, object, object->where});
  }

  void add_property(const XmlText& text, const Node& node, Object& into) {
    Property property;
    property.tag = node.name();
    property.where = text.place(node);
    property.name = snake_case(required(text, node, "name"));
    if (property.tag == "transform") {
      property.transform.start = property.transform.end = transform(text, node);
    } else if (property.tag == "animation") {
      property.transform = animation(text, node);
    } else {
      property.attributes = attributes(text, node);
      property.attributes.erase("name");
      for (const Node& nested : node.children())
        if (nested.type() == pugi::node_element)
          throw SceneError(text.place(nested), "<" + std::string(nested.name()) +
                                                   "> is not expected in <" + property.tag + ">");
    }
    const auto [given, is_new] = given_[&into].try_emplace(property.name, property.where);
    if (!is_new)
      throw SceneError(property.where, "property \"" + property.name + "\" is already given at " +
                                           given->second.to_string());
    into.properties.push_back(std::move(property));
  }

  Mat44d transform(const XmlText& text, const Node& node) {
    Mat44d m;
    for (const Node& element : node.children()) {
      if (element.type() != pugi::node_element) continue;
      m = m * transform_element(element.name(), attributes(text, element), text.place(element));
    }
    if (!is_invertible(m) || is_singular(m) || !is_affine(m))
      throw SceneError(text.place(node),
                       "the transform has no inverse or is projective, expected "
                       "an affine map");
    return m;
  }

  /// The first and the last keyframe.
  TransformDescription animation(const XmlText& text, const Node& node) {
    std::map<double, Mat44d> keys;
    for (const Node& element : node.children()) {
      if (element.type() != pugi::node_element) continue;
      const SourceLocation where = text.place(element);
      if (element.name() != std::string("transform"))
        throw SceneError(where, "<" + std::string(element.name()) +
                                    "> is not expected in <animation>, expected <transform>");
      const double time = finite_number(required(text, element, "time"), "\"time\"", where);
      keys[time] = transform(text, element);
    }
    if (keys.empty())
      throw SceneError(text.place(node), "<animation> is empty, expected transforms");
    if (keys.size() > 2)
      diagnostics_.warn(text.place(node),
                        "an animation has more than two keyframes, the first and "
                        "the last one are used");
    return {keys.begin()->second, keys.rbegin()->second};
  }

  std::map<std::string, std::string> attributes(const XmlText& text, const Node& node) const {
    std::map<std::string, std::string> all;
    for (const pugi::xml_attribute& attribute : node.attributes())
      all[attribute.name()] = parameters_.replaced(attribute.value(), text.place(node, attribute));
    return all;
  }

  /// The attribute with parameters replaced; empty if it is absent.
  std::string value(const XmlText& text, const Node& node, const char* name) const {
    const pugi::xml_attribute attribute = node.attribute(name);
    if (!attribute) return {};
    return parameters_.replaced(attribute.value(), text.place(node, attribute));
  }

  std::string required(const XmlText& text, const Node& node, const char* name) const {
    std::string found = value(text, node, name);
    if (found.empty())
      throw SceneError(text.place(node),
                       "<" + std::string(node.name()) + "> has no \"" + name + "\", expected one");
    return found;
  }

  SceneFiles& files_;
  const ImportOptions& options_;
  SceneParameters parameters_;
  Diagnostics& diagnostics_;
  Ids ids_;
  std::map<const Object*, std::map<std::string, SourceLocation>> given_;  ///< properties
  std::vector<std::string> open_files_;
  int includes_ = 0;
};

}  // namespace

Document read_document(const std::string& path, SceneFiles& files, const ImportOptions& options,
                       Diagnostics& diagnostics) {
  return ObjectReader(files, options, diagnostics).read(path);
}

}  // namespace nephroid::mitsuba
