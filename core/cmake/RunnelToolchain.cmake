# How every target of the tree is compiled: warnings as errors, sanitizers, ccache, where results go.

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
option(BUILD_SHARED_LIBS "Shared libraries: plugins and programs then share one core" ON)

set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/bin")
set(CMAKE_LIBRARY_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/lib")
# An installed program or library finds its siblings relative to itself, wherever the tree is put.
set(CMAKE_INSTALL_RPATH "$ORIGIN" "$ORIGIN/../${CMAKE_INSTALL_LIBDIR}" "$ORIGIN/../..")

find_program(RUNNEL_CCACHE ccache)
if(RUNNEL_CCACHE)
  set(CMAKE_CXX_COMPILER_LAUNCHER "${RUNNEL_CCACHE}")
endif()

add_library(runnel_warnings INTERFACE)
target_compile_options(runnel_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wnon-virtual-dtor -Werror
  # False alarms of GCC 12: joined strings (its bugs 105329, 105651); members of what stands in a
  # variant or an optional, at -O3 and with the sanitizers' checks in between.
  -Wno-restrict -Wno-maybe-uninitialized)

if(RUNNEL_SANITIZE)
  add_compile_options(-fsanitize=${RUNNEL_SANITIZE} -fno-omit-frame-pointer
    -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${RUNNEL_SANITIZE})
endif()
