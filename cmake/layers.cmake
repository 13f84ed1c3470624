# The layers, in the order in which data flows through them. Each is a small static library of all
# sources in its folder; a layer links only what stands before it:
# nephroid_layer(NAME FOLDER LIBRARY... [ROOMS FOLDER...]). Rooms are folders in the layer's own,
# whose sources go into the same library; tools/check_layers.py holds their order.
function(nephroid_layer name folder)
  cmake_parse_arguments(PARSE_ARGV 2 layer "" "" "ROOMS")
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/src/${folder}/*.cpp)
  foreach(room ${layer_ROOMS})
    file(GLOB of_room CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/src/${folder}/${room}/*.cpp)
    list(APPEND sources ${of_room})
  endforeach()
  # A library of its own and a program, see below.
  list(REMOVE_ITEM sources ${CMAKE_SOURCE_DIR}/src/scene/pixel_filter.cpp
                           ${CMAKE_SOURCE_DIR}/src/report_page/main.cpp)
  if(sources)
    add_library(nephroid_${name} STATIC ${sources})
    target_link_libraries(nephroid_${name} PUBLIC nephroid_flags ${layer_UNPARSED_ARGUMENTS})
    nephroid_precompiled(nephroid_${name} nephroid_core)
  else()
    add_library(nephroid_${name} INTERFACE)
    target_link_libraries(nephroid_${name} INTERFACE nephroid_flags ${layer_UNPARSED_ARGUMENTS})
  endif()
endfunction()

# Tables that are computed once, at build time: measured spectra and the sRGB coefficients.
if(EXISTS ${CMAKE_SOURCE_DIR}/cmake/tables.cmake)
  include(${CMAKE_SOURCE_DIR}/cmake/tables.cmake)
endif()

set(parallel_backend Threads::Threads)
if(NOT NEPHROID_STD_THREADS)
  list(APPEND parallel_backend TBB::tbb)
endif()

nephroid_layer(core core Imath::Imath fmt::fmt PkgConfig::xxHash ${parallel_backend})
if(NEPHROID_STD_THREADS)
  target_compile_definitions(nephroid_core PUBLIC NEPHROID_STD_THREADS)
endif()
if(TARGET nephroid_tables)
  target_link_libraries(nephroid_core PUBLIC nephroid_tables)
endif()
nephroid_layer(input input nephroid_core ZLIB::ZLIB nlohmann_json::nlohmann_json PkgConfig::draco
               pugixml::pugixml ${MESHOPTIMIZER_LIBRARY} ROOMS sky obj gltf mitsuba staging convert)
nephroid_layer(shape scene/shape nephroid_input)
nephroid_layer(bsdf scene/bsdf nephroid_core)
nephroid_layer(texture scene/texture nephroid_input PkgConfig::OpenImageIO)
nephroid_layer(medium scene/medium nephroid_texture ZLIB::ZLIB)
target_include_directories(nephroid_medium SYSTEM PUBLIC ${NANOVDB_INCLUDE_DIR})
nephroid_layer(material scene/material nephroid_bsdf nephroid_texture nephroid_medium)
nephroid_layer(light scene/light nephroid_shape nephroid_texture)
nephroid_layer(camera scene/camera nephroid_light)
# All that the film needs of the scene.
add_library(nephroid_filter STATIC ${CMAKE_SOURCE_DIR}/src/scene/pixel_filter.cpp)
target_link_libraries(nephroid_filter PUBLIC nephroid_flags nephroid_input)
nephroid_precompiled(nephroid_filter nephroid_core)
nephroid_layer(scene scene nephroid_shape nephroid_material nephroid_light nephroid_camera
               nephroid_medium nephroid_filter embree)
nephroid_layer(route route nephroid_scene)
nephroid_layer(film film nephroid_filter PkgConfig::OpenImageIO PkgConfig::zstd ${OPENEXR_LIBRARY})
nephroid_layer(transport transport nephroid_scene nephroid_route)
nephroid_layer(photon photon nephroid_transport)
nephroid_layer(integrator integrator nephroid_photon nephroid_film
               ROOMS estimator path photons learning photon_mapping virtual_lights bidirectional
                     metropolis mixed presets)
nephroid_layer(image image nephroid_film)
nephroid_layer(session session nephroid_integrator ROOMS settings report checkpoint)
nephroid_layer(options options nephroid_session nephroid_image)
nephroid_layer(bench bench nephroid_options nephroid_image nlohmann_json::nlohmann_json)
nephroid_layer(report_page report_page nephroid_bench)
nephroid_layer(view view nephroid_session nephroid_image nlohmann_json::nlohmann_json
               PkgConfig::httplib)
include(cmake/page.cmake)

# Draws the results of `nephroid bench`. The renderer does not link the page.
add_executable(nephroid-bench-report ${CMAKE_SOURCE_DIR}/src/report_page/main.cpp)
target_link_libraries(nephroid-bench-report PRIVATE nephroid_report_page CLI11::CLI11)
nephroid_precompiled(nephroid-bench-report nephroid_core)

file(GLOB app_sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/src/apps/*.cpp)
if(app_sources)
  add_executable(nephroid ${app_sources})
  target_link_libraries(nephroid PRIVATE nephroid_bench nephroid_view CLI11::CLI11)
  nephroid_precompiled(nephroid nephroid_core)
endif()

# Run by tools/measure_photons.
add_executable(photon_floor EXCLUDE_FROM_ALL ${CMAKE_SOURCE_DIR}/tools/floor/photon_floor.cpp)
target_link_libraries(photon_floor PRIVATE nephroid_session)
