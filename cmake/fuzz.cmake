# The fuzzers: one program a target, clang's libFuzzer with address and undefined behaviour
# sanitizers. `make fuzz` builds and runs them (docs/reliability.md).
if(NOT CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
  message(FATAL_ERROR "NEPHROID_FUZZ needs clang++, expected -DCMAKE_CXX_COMPILER=clang++")
endif()

add_custom_target(fuzzers)

function(nephroid_fuzzer name)
  add_executable(fuzz_${name} ${CMAKE_SOURCE_DIR}/tests/fuzz/libfuzzer/entry.cpp
                 ${CMAKE_SOURCE_DIR}/tests/fuzz/${name}_target.cpp
                 ${CMAKE_SOURCE_DIR}/tests/fuzz/memory_files.cpp
                 ${CMAKE_SOURCE_DIR}/tests/fuzz/disk_file.cpp)
  target_include_directories(fuzz_${name} PRIVATE ${CMAKE_SOURCE_DIR}/tests)
  target_compile_definitions(fuzz_${name} PRIVATE NEPHROID_FUZZ_TARGET=${name})
  target_link_libraries(fuzz_${name} PRIVATE ${ARGN})
  target_link_options(fuzz_${name} PRIVATE -fsanitize=fuzzer -Wl,--wrap=fopen)
  add_dependencies(fuzzers fuzz_${name})
endfunction()

nephroid_fuzzer(scene nephroid_input)
nephroid_fuzzer(ply nephroid_input)
nephroid_fuzzer(mitsuba nephroid_input)
nephroid_fuzzer(serialized nephroid_input)
nephroid_fuzzer(volume nephroid_input)
nephroid_fuzzer(obj nephroid_input)
nephroid_fuzzer(gltf nephroid_input)
nephroid_fuzzer(bsdf nephroid_material)
nephroid_fuzzer(routes nephroid_integrator)
nephroid_fuzzer(image nephroid_texture)
nephroid_fuzzer(environment nephroid_light)
nephroid_fuzzer(nanovdb nephroid_medium)
target_sources(fuzz_nanovdb PRIVATE ${CMAKE_SOURCE_DIR}/tests/unit/medium/nanovdb_writer.cpp)
nephroid_fuzzer(checkpoint nephroid_session)
nephroid_fuzzer(learned nephroid_integrator)
nephroid_fuzzer(command nephroid_options)
nephroid_fuzzer(view_request nephroid_view)
