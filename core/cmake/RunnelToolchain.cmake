# How every target of the tree is compiled: warnings as errors, sanitizers, ccache, where results go.

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
option(RUNNEL_COMPILE_TOGETHER "Compile several sources of a target as one: half of the time from scratch" ON)
option(BUILD_SHARED_LIBS "Shared libraries: plugins and programs then share one core" ON)

set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/bin")
set(CMAKE_LIBRARY_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/lib")
# An installed program or library finds its siblings relative to itself, wherever the tree is put.
set(CMAKE_INSTALL_RPATH "$ORIGIN" "$ORIGIN/../${CMAKE_INSTALL_LIBDIR}" "$ORIGIN/../..")

find_program(RUNNEL_CCACHE ccache)
if(RUNNEL_CCACHE)
  # Only so does it keep what is compiled with precompiled headers. When GCC collects its garbage makes no difference.
  set(CMAKE_CXX_COMPILER_LAUNCHER
    "${CMAKE_COMMAND}" -E env CCACHE_SLOPPINESS=pch_defines,time_macros CCACHE_IGNOREOPTIONS=--param=ggc-min-heapsize=* "${RUNNEL_CCACHE}")
endif()

add_library(runnel_warnings INTERFACE)
target_compile_options(runnel_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wnon-virtual-dtor -Werror)
if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
  # What GCC does not count among these: signs, and members that a designated initializer leaves out.
  target_compile_options(runnel_warnings INTERFACE -Wno-sign-conversion -Wno-missing-field-initializers)
else()
  # False alarms of GCC 12: joined strings (its bugs 105329, 105651); members of what stands in a
  # variant or an optional, at -O3 and with the sanitizers' checks in between.
  target_compile_options(runnel_warnings INTERFACE -Wno-restrict -Wno-maybe-uninitialized)
endif()

# Sources of tests are compiled together: a name local to one may stand in the anonymous namespace of
# another, and what stands there is not another program's although GCC reads it as from a header.
add_library(runnel_test_warnings INTERFACE)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  target_compile_options(runnel_test_warnings INTERFACE -Wno-shadow -Wshadow=local -Wno-subobject-linkage)
endif()

# Tests are compiled in two thirds of the time without optimisation; with a sanitizer they would then
# run too long. Libraries that are tested are optimised as the preset says.
set(RUNNEL_TEST_OPTIMISATION $<$<CONFIG:RelWithDebInfo>:-O0>)
if(RUNNEL_SANITIZE)
  set(RUNNEL_TEST_OPTIMISATION $<$<CONFIG:RelWithDebInfo>:-O1>)
  add_compile_options(-fsanitize=${RUNNEL_SANITIZE} -fno-omit-frame-pointer
    -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${RUNNEL_SANITIZE})
endif()
