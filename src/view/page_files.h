// The files of the page, compiled into the program (cmake/page.cmake).
#pragma once

#include <span>
#include <string_view>

namespace nephroid {

struct PageFile {
  std::string_view path;  ///< "/page.css"; the page itself is "/"
  std::string_view type;  ///< media type
  std::string_view content;
};

std::span<const PageFile> page_files();

}  // namespace nephroid
