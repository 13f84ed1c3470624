// An XML text with the locations of its elements and attributes. It must not know Mitsuba.
// Entities of a DTD are never expanded, so they cannot multiply.
#pragma once

#include <memory>
#include <pugixml.hpp>
#include <string>
#include <vector>

#include "core/errors.h"

namespace nephroid::mitsuba {

class XmlText {
 public:
  /// Throws SceneError in the file `name` if `text` is not well-formed.
  XmlText(std::string text, const std::string& name);
  XmlText(const XmlText&) = delete;
  XmlText& operator=(const XmlText&) = delete;

  /// The outermost element; empty if there is none.
  pugi::xml_node root() const { return document_.document_element(); }
  SourceLocation start() const { return place(0); }
  SourceLocation place(const pugi::xml_node& element) const;
  SourceLocation place(const pugi::xml_node& element, const pugi::xml_attribute& attribute) const;

 private:
  SourceLocation place(size_t offset) const;

  std::string text_;
  std::shared_ptr<const std::string> file_;
  std::vector<size_t> line_starts_;  ///< offsets of the first characters of lines
  pugi::xml_document document_;
};

}  // namespace nephroid::mitsuba
