# Tests: one executable per folder below tests/unit (named as the layer it tests) and one per other
# kind of test. An executable is one test of ctest, or one for each tier: starting it takes a third of
# a second, as long as most test cases.
find_package(GTest REQUIRED)
# A sanitizer is slow: of the tests with most passes it sees one shard in so many, the one that
# NEPHROID_SANITIZED_SHARD (modulo so many) says.
set(NEPHROID_SANITIZED_SHARD 0 CACHE STRING "Which of the tests with most passes a sanitizer sees")
if(NOT NEPHROID_SANITIZED_SHARD MATCHES "^[0-9]+$")
  message(FATAL_ERROR "NEPHROID_SANITIZED_SHARD (make's SHARD) is \"${NEPHROID_SANITIZED_SHARD}\", "
                      "expected a number from 0 on")
endif()
set(sanitized_shards_agreement 24)
set(sanitized_shards_statistical 24)
set(sanitized_shards_analytic 12)
set(sanitizer_environment
    "ASAN_OPTIONS=detect_stack_use_after_return=1"
    "UBSAN_OPTIONS=print_stacktrace=1:halt_on_error=1"
    "LSAN_OPTIONS=suppressions=${CMAKE_SOURCE_DIR}/tools/sanitizers/lsan.supp"
    "TSAN_OPTIONS=suppressions=${CMAKE_SOURCE_DIR}/tools/sanitizers/tsan.supp:halt_on_error=1")
if(NEPHROID_SANITIZE)
  # g++ 12 warns of its own <regex> when it is sanitized.
  set_source_files_properties(tests/routes/oracle_test.cpp tests/unit/options/scene_support_test.cpp
                              PROPERTIES COMPILE_OPTIONS -Wno-maybe-uninitialized)
endif()
# Tiers (docs/testing.md). The label `quick` has all unit tests and these parts of the other suites
# (filters of GoogleTest); the label `full` has the rest, so that no test runs twice. Suites labelled
# `nightly` compare random estimates and can run with other seeds.
set(quick_routes "-Sets/BruteForce*")
set(quick_unit_bsdf "-PrincipledChiSquare*")
set(quick_statistical "*/glass_before_wall_*")
set(quick_determinism "ResumeRefuses*:*/mixed:*/doidge2012")
set(quick_regression "Bad*")
set(full_only analytic agreement)
set(nightly analytic agreement statistical)
# These render their seeds in parallel, so ctest starts nothing beside them.
set(parallel analytic agreement statistical)
cmake_host_system_information(RESULT cores QUERY NUMBER_OF_LOGICAL_CORES)

add_library(test_source_directory STATIC tests/source_directory.cpp)
target_link_libraries(test_source_directory PRIVATE nephroid_core GTest::gtest)
set_source_files_properties(tests/source_directory.cpp PROPERTIES
                            COMPILE_DEFINITIONS NEPHROID_SOURCE_DIR="${CMAKE_SOURCE_DIR}")
# Most of a test's time is its compilation, and the code under test has the flags of the program.
if(CMAKE_BUILD_TYPE STREQUAL "Release")
  set(test_options -O1)
endif()
target_compile_options(test_source_directory PRIVATE ${test_options})
# It compiles the headers for all tests: to reuse those of an executable would be to wait for it.
nephroid_precompiled(test_source_directory test_source_directory <gtest/gtest.h>)

# Adds a tier of a suite as a test of ctest; an empty filter takes the whole suite.
function(nephroid_add_tier test suite tier filter)
  add_test(NAME ${test} COMMAND test_${suite})
  set(labels ${tier})
  if(suite IN_LIST nightly)
    list(APPEND labels nightly)
  endif()
  set_tests_properties(${test} PROPERTIES TIMEOUT 14400 LABELS "${labels}")
  if(filter)
    set_tests_properties(${test} PROPERTIES ENVIRONMENT "GTEST_FILTER=${filter}")
  endif()
  if(suite IN_LIST parallel)
    set_tests_properties(${test} PROPERTIES PROCESSORS ${cores})
  endif()
  # The longest suites start first.
  if(tier STREQUAL "full")
    set_tests_properties(${test} PROPERTIES COST 100)
  endif()
endfunction()

function(nephroid_test folder)
  string(REPLACE "/" "_" name ${folder})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/tests/${folder}/*.cpp)
  if(NOT sources)
    return()
  endif()
  add_executable(test_${name} ${sources})
  target_link_libraries(test_${name} PRIVATE ${ARGN} test_source_directory GTest::gtest GTest::gtest_main)
  target_include_directories(test_${name} PRIVATE ${CMAKE_SOURCE_DIR}/tests)
  target_compile_options(test_${name} PRIVATE ${test_options})
  nephroid_precompiled(test_${name} test_source_directory)
  if(NEPHROID_SANITIZE)
    add_test(NAME ${name} COMMAND test_${name})
    set(environment ${sanitizer_environment})
    if(sanitized_shards_${name})
      math(EXPR shard "${NEPHROID_SANITIZED_SHARD} % ${sanitized_shards_${name}}")
      list(APPEND environment "GTEST_TOTAL_SHARDS=${sanitized_shards_${name}}"
           "GTEST_SHARD_INDEX=${shard}")
    endif()
    set_tests_properties(${name} PROPERTIES TIMEOUT 14400 ENVIRONMENT "${environment}")
    return()
  endif()
  if(name IN_LIST full_only)
    nephroid_add_tier(${name} ${name} full "")
  elseif(quick_${name})
    # The filter of the full tier is the complement of the other; "-" in front excludes.
    if(quick_${name} MATCHES "^-(.*)")
      nephroid_add_tier(${name}_quick ${name} quick "${quick_${name}}")
      nephroid_add_tier(${name} ${name} full "${CMAKE_MATCH_1}")
    else()
      nephroid_add_tier(${name}_quick ${name} quick "${quick_${name}}")
      nephroid_add_tier(${name} ${name} full "-${quick_${name}}")
    endif()
  else()
    nephroid_add_tier(${name} ${name} quick "")
  endif()
endfunction()

nephroid_test(unit/core nephroid_core)
nephroid_test(unit/input nephroid_input)
nephroid_test(unit/shape nephroid_shape)
nephroid_test(unit/bsdf nephroid_bsdf)
nephroid_test(unit/texture nephroid_texture)
nephroid_test(unit/material nephroid_material)
nephroid_test(unit/light nephroid_light)
nephroid_test(unit/medium nephroid_medium)
nephroid_test(unit/camera nephroid_camera)
nephroid_test(unit/scene nephroid_scene)
nephroid_test(unit/film nephroid_film)
nephroid_test(unit/transport nephroid_transport)
nephroid_test(unit/photon nephroid_integrator)
nephroid_test(unit/integrator nephroid_integrator)
nephroid_test(unit/image nephroid_image)
nephroid_test(unit/session nephroid_session)
nephroid_test(unit/options nephroid_options)
if(TARGET test_unit_options)
  target_sources(test_unit_options PRIVATE ${CMAKE_SOURCE_DIR}/tests/unit/medium/nanovdb_writer.cpp)
endif()
nephroid_test(unit/bench nephroid_bench)
nephroid_test(unit/report_page nephroid_report_page)
nephroid_test(unit/view nephroid_view)
nephroid_test(routes nephroid_integrator)
nephroid_test(how_to nephroid_integrator)
# What the pages tell a reader to do, small and quick.
file(GLOB how_to_pages CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/docs/how-to/*.md)
add_test(NAME how_to_pages
  COMMAND ${CMAKE_SOURCE_DIR}/tests/how_to/run_pages.py $<TARGET_FILE:nephroid> ${how_to_pages})
set_tests_properties(how_to_pages PROPERTIES LABELS full)
nephroid_test(statistical nephroid_integrator)
nephroid_test(analytic nephroid_integrator)
nephroid_test(agreement nephroid_session nephroid_image)
nephroid_test(determinism nephroid_session)
nephroid_test(regression nephroid_options nephroid_image)
if(TARGET test_regression)
  # These tests run the program itself.
  target_compile_definitions(test_regression PRIVATE NEPHROID_PROGRAM="$<TARGET_FILE:nephroid>")
  add_dependencies(test_regression nephroid)
  # Writes the files that the scenes of tests/regression/features name.
  add_executable(make_feature_assets EXCLUDE_FROM_ALL
    tests/regression/features/make_assets.cpp tests/unit/medium/nanovdb_writer.cpp)
  target_link_libraries(make_feature_assets PRIVATE nephroid_bsdf nephroid_medium)
  target_include_directories(make_feature_assets PRIVATE tests)
  # Writes what tests/regression/feature_test.cpp compares with, see tools/update_regression.
  add_executable(update_features EXCLUDE_FROM_ALL tests/regression/features/update.cpp)
  target_link_libraries(update_features PRIVATE nephroid_session nephroid_image test_source_directory)
  target_include_directories(update_features PRIVATE tests)
endif()
nephroid_test(fuzz nephroid_options nephroid_view)
if(TARGET test_fuzz)
  target_sources(test_fuzz PRIVATE ${CMAKE_SOURCE_DIR}/tests/unit/medium/nanovdb_writer.cpp)
  # The readers under test open files in memory (tests/fuzz/memory_files.h).
  target_link_options(test_fuzz PRIVATE -Wl,--wrap=fopen)
endif()
