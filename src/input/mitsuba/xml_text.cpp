#include "input/mitsuba/xml_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>

namespace nephroid::mitsuba {
namespace {

/// The message for a text that was understood up to `offset`.
std::string mistake(const pugi::xml_parse_result& result, std::string_view text, size_t offset) {
  if (result.status != pugi::status_end_element_mismatch)
    return fmt::format("this is not well-formed XML: {}, expected XML elements",
                       result.description());
  if (!text.substr(0, offset).ends_with("</"))
    return "the file ends in the middle of an element, expected its closing tag";
  const std::string_view rest = text.substr(offset);
  return fmt::format("</{}> does not close the element that is open",
                     rest.substr(0, rest.find_first_of("> \t\r\n")));
}

}  // namespace

XmlText::XmlText(std::string text, const std::string& name)
    : text_(std::move(text)), file_(std::make_shared<const std::string>(name)), line_starts_{0} {
  for (size_t i = 0; i < text_.size(); ++i)
    if (text_[i] == '\n') line_starts_.push_back(i + 1);
  if (text_.empty()) throw SceneError({file_, 0, 0}, "the file is empty, expected XML elements");
  const pugi::xml_parse_result result =
      document_.load_buffer(text_.data(), text_.size(), pugi::parse_default);
  if (result) return;
  const size_t offset =
      std::min(static_cast<size_t>(std::max<ptrdiff_t>(result.offset, 0)), text_.size());
  throw SceneError(place(offset), mistake(result, text_, offset));
}

SourceLocation XmlText::place(size_t offset) const {
  offset = std::min(offset, text_.size());
  const auto after = std::upper_bound(line_starts_.begin(), line_starts_.end(), offset);
  const size_t line = static_cast<size_t>(after - line_starts_.begin());
  return {file_, static_cast<int>(line), static_cast<int>(offset - line_starts_[line - 1]) + 1};
}

SourceLocation XmlText::place(const pugi::xml_node& element) const {
  // pugixml gives the offset of the name, behind "<".
  return place(static_cast<size_t>(std::max<ptrdiff_t>(element.offset_debug() - 1, 0)));
}

SourceLocation XmlText::place(const pugi::xml_node& element,
                              const pugi::xml_attribute& attribute) const {
  // Names of elements and attributes stand in one buffer, at their places in the text.
  const ptrdiff_t behind = attribute.name() - element.name();
  return place(static_cast<size_t>(std::max<ptrdiff_t>(element.offset_debug() + behind, 0)));
}

}  // namespace nephroid::mitsuba
