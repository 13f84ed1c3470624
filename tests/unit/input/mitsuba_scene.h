// Reads Mitsuba scenes that tests write, and looks things up in the description.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "input/mitsuba/mitsuba_reader.h"
#include "unit/input/parse_text.h"
#include "unit/input/temporary_directory.h"

namespace nephroid::testing {

/// `<tag name="name" value="text"/>`
inline std::string value(const std::string& tag, const std::string& name, const std::string& text) {
  return "<" + tag + " name=\"" + name + "\" value=\"" + text + "\"/>";
}

/// A folder with a scene in the file "scene.xml".
class MitsubaScene {
 public:
  ImportOptions options;
  Diagnostics diagnostics;

  const TemporaryDirectory& folder() const { return folder_; }
  /// Reads a whole file.
  SceneDescription read_file(const std::string& text) {
    return read_mitsuba(folder_.write("scene.xml", text), options, diagnostics);
  }
  /// Reads the elements in a <scene>; they begin on line 2.
  SceneDescription read(const std::string& body, const std::string& version = "0.6.0") {
    return read_file("<scene version=\"" + version + "\">\n" + body + "</scene>\n");
  }
  /// The error's message without the folder, or "no error".
  std::string error(const std::string& body, const std::string& version = "0.6.0") {
    return without_folder(error_of([&] { read(body, version); }));
  }
  std::string file_error(const std::string& text) {
    return without_folder(error_of([&] { read_file(text); }));
  }
  /// All warnings so far, one a line.
  std::string warnings() const {
    std::string all;
    for (const Warning& warning : diagnostics.warnings())
      all += without_folder(located(warning.where, warning.message)) + "\n";
    return all;
  }

 private:
  std::string without_folder(std::string text) const {
    const std::string prefix = folder_.path() + "/";
    for (size_t at = text.find(prefix); at != std::string::npos; at = text.find(prefix))
      text.erase(at, prefix.size());
    return text;
  }

  TemporaryDirectory folder_;
};

/// The parameter of that name; a failure and an empty one if there is none.
inline Parameter parameter(const ParameterSet& set, const std::string& name) {
  for (const Parameter& p : set.list)
    if (p.name == name) return p;
  ADD_FAILURE() << "no parameter \"" << name << "\"";
  return {};
}
inline bool has_parameter(const ParameterSet& set, const std::string& name) {
  for (const Parameter& p : set.list)
    if (p.name == name) return true;
  return false;
}
inline double number(const ParameterSet& set, const std::string& name) {
  const Parameter p = parameter(set, name);
  EXPECT_EQ(p.numbers.size(), 1u) << name;
  return p.numbers.empty() ? 0 : p.numbers[0];
}
inline std::string text(const ParameterSet& set, const std::string& name) {
  const Parameter p = parameter(set, name);
  EXPECT_EQ(p.strings.size(), 1u) << name;
  return p.strings.empty() ? std::string() : p.strings[0];
}

/// The material of that name; a failure and an empty one if there is none.
inline MaterialDescription material(const SceneDescription& scene, const std::string& name) {
  for (const MaterialDescription& m : scene.materials)
    if (m.name == name) return m;
  ADD_FAILURE() << "no material \"" << name << "\"";
  return {};
}

}  // namespace nephroid::testing
