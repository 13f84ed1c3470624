# The page of `nephroid view`, compiled into the program: each file of src/view/page as an array of
# bytes, made by CMake alone.
set(page_folder ${CMAKE_SOURCE_DIR}/src/view/page)
file(GLOB page_sources CONFIGURE_DEPENDS ${page_folder}/*)
set(page_file ${CMAKE_BINARY_DIR}/page/page_files.cpp)
add_custom_command(OUTPUT ${page_file}
  COMMAND ${CMAKE_COMMAND} -DFOLDER=${page_folder} -DOUTPUT=${page_file}
          -P ${CMAKE_SOURCE_DIR}/cmake/embed_page.cmake
  DEPENDS ${page_sources} ${CMAKE_SOURCE_DIR}/cmake/embed_page.cmake
  COMMENT "Embedding the page of nephroid view")
target_sources(nephroid_view PRIVATE ${page_file})
set_source_files_properties(${page_file} PROPERTIES SKIP_PRECOMPILE_HEADERS ON)
