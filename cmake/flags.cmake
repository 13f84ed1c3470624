# Compiler flags of every target of the project. Warnings are errors; arithmetic is reproducible
# (no contraction into fused multiply-add behind our back, no reassociation).
add_library(nephroid_flags INTERFACE)
target_compile_options(nephroid_flags INTERFACE
  -Wall -Wextra -Werror -Wshadow -Wconversion -Wno-sign-conversion -Wno-psabi -Wnon-virtual-dtor
  -ffp-contract=off -fno-math-errno -fno-trapping-math)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # g++ 12 warns of string concatenations that are fine (GCC bug 105651).
  target_compile_options(nephroid_flags INTERFACE -Wno-restrict)
  # With several files in one, it takes their anonymous namespaces for those of a header and warns of classes with such members.
  if(CMAKE_UNITY_BUILD)
    target_compile_options(nephroid_flags INTERFACE -Wno-subobject-linkage)
  endif()
endif()
if(NEPHROID_NATIVE)
  target_compile_options(nephroid_flags INTERFACE -march=native)
endif()
if(NEPHROID_SANITIZE)
  # Sanitizers triple the code that the optimiser sees: -O2 -g takes 2.5 times as long to compile.
  set(CMAKE_CXX_FLAGS_RELWITHDEBINFO "-O1 -g1")
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    string(APPEND CMAKE_CXX_FLAGS_RELWITHDEBINFO " -finline-small-functions")
  endif()
  target_compile_options(nephroid_flags INTERFACE -fsanitize=${NEPHROID_SANITIZE}
                         -fno-omit-frame-pointer)
  target_link_options(nephroid_flags INTERFACE -fsanitize=${NEPHROID_SANITIZE})
endif()
if(NEPHROID_FUZZ)
  set(CMAKE_CXX_FLAGS_RELWITHDEBINFO "-O2 -g")  # with assertions
  set(fuzz_sanitizers -fsanitize=address,undefined,fuzzer-no-link -fno-sanitize-recover=undefined)
  target_compile_options(nephroid_flags INTERFACE ${fuzz_sanitizers} -fno-omit-frame-pointer)
  target_link_options(nephroid_flags INTERFACE -fsanitize=address,undefined)
endif()
set(CMAKE_CXX_FLAGS_RELEASE "-O3 -DNDEBUG")
target_include_directories(nephroid_flags INTERFACE ${CMAKE_SOURCE_DIR}/src)
