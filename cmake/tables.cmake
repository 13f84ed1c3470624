# The tables that are computed once, at build time, and linked into the program: measured spectra
# and the coefficients that turn sRGB colours into spectra (docs/adr/0002-rgb-spectra.md).
set(tables_file ${CMAKE_BINARY_DIR}/tables/tables.bin)
file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/tables)
file(GLOB tables_csv CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/data/spectra/*.csv)

# The generator is always optimised and never sanitized: it runs as part of every build.
get_target_property(tables_flags nephroid_flags INTERFACE_COMPILE_OPTIONS)
list(FILTER tables_flags EXCLUDE REGEX "sanitize|frame-pointer")
add_executable(nephroid_make_tables ${CMAKE_SOURCE_DIR}/tools/tables/make_tables.cpp
               ${CMAKE_SOURCE_DIR}/src/core/color_fit.cpp)
target_include_directories(nephroid_make_tables PRIVATE ${CMAKE_SOURCE_DIR}/src)
target_compile_options(nephroid_make_tables PRIVATE ${tables_flags} -O3)
target_link_libraries(nephroid_make_tables PRIVATE Threads::Threads)
# The renderer fits the tables of the other colour spaces itself. A debug or sanitizer build would take
# minutes over it, and this is plain arithmetic on arrays of fixed size.
set_source_files_properties(${CMAKE_SOURCE_DIR}/src/core/color_fit.cpp PROPERTIES
                            COMPILE_OPTIONS "-O3;-fno-sanitize=all" SKIP_PRECOMPILE_HEADERS ON)

add_custom_command(OUTPUT ${tables_file}
  COMMAND nephroid_make_tables ${CMAKE_SOURCE_DIR}/data/spectra ${tables_file}
  DEPENDS nephroid_make_tables ${tables_csv}
  COMMENT "Making spectral tables")

# The file is assembled into an object as it is. A compiler cache does not see that file, so it must
# not be asked.
set(tables_source ${CMAKE_SOURCE_DIR}/tools/tables/embedded_tables.cpp)
add_library(nephroid_tables STATIC ${tables_source})
target_link_libraries(nephroid_tables PUBLIC nephroid_flags)
target_compile_definitions(nephroid_tables PRIVATE NEPHROID_TABLES_FILE="${tables_file}")
set_target_properties(nephroid_tables PROPERTIES CXX_COMPILER_LAUNCHER "")
set_source_files_properties(${tables_source} PROPERTIES OBJECT_DEPENDS ${tables_file})
