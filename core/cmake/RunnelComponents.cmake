# Components in the language of GenoM3. Works in this tree and, after find_package(runnel), in any other.

# runnel_generated_component(<name> <template> <sources> DESCRIPTION <file.gen> [INCLUDES <folder> ...])
# Runs the template at build time, again when the description, what it includes, or a template has changed, into the folder
# <name>_<template> of the build tree. Sets <sources>, and <sources>_folder.
function(runnel_generated_component name template sources)
  cmake_parse_arguments(PARSE_ARGV 3 arg "" "DESCRIPTION" "INCLUDES")
  set(program runnel::generate_program)
  set(prefix "runnel/")
  if(TARGET runnel_warnings)
    set(program runnel_generate_program)
    set(prefix "")
  endif()
  get_filename_component(description "${arg_DESCRIPTION}" ABSOLUTE)
  set(options "")
  foreach(include IN LISTS arg_INCLUDES)
    get_filename_component(include "${include}" ABSOLUTE)
    list(APPEND options "-I${include}")
  endforeach()
  # Which headers there will be.
  set(language c)
  file(STRINGS "${description}" says_cxx REGEX "lang[ \t]*\"c\\+\\+\"")
  if(says_cxx)
    set(language cxx)
  endif()
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${description}")
  set(folder "${CMAKE_CURRENT_BINARY_DIR}/${name}_${template}")
  set(headers "ac${name}.h" "genom3_${language}.h" "${name}_${language}_types.h" "${name}_tables.h" "${name}_views.h")
  set(own "${folder}/${name}_standalone.cpp")
  if(template STREQUAL runnel)
    set(own "${folder}/${name}_module.cpp")
    list(APPEND headers "${name}_types.h")
  endif()
  list(TRANSFORM headers PREPEND "${folder}/")
  set(made "${own}" "${folder}/${name}_tables.cpp")
  add_custom_command(
    OUTPUT ${made} ${headers}
    COMMAND ${program} ${template} "${description}" ${options} -o "${folder}" --overwrite -s "prefix=${prefix}"
      --depfile "${folder}/made.d"
    DEPENDS "${description}" ${program} DEPFILE "${folder}/made.d"
    COMMENT "Component ${name} (${template}) from ${arg_DESCRIPTION}" VERBATIM)
  # Views of one memory by two types.
  set_source_files_properties(${made} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON COMPILE_OPTIONS -fno-strict-aliasing)
  set(${sources} ${made} PARENT_SCOPE)
  set(${sources}_folder "${folder}" PARENT_SCOPE)
endfunction()

# runnel_component_sources(<name> <variable> <arguments of runnel_component> ...)
# What runnel_component() makes a plugin of: the targets <name>_made and <name>_codels, and the sources in the variable.
function(runnel_component_sources name sources)
  cmake_parse_arguments(PARSE_ARGV 2 arg "" "DESCRIPTION" "CODELS;INCLUDES;PACKAGES;DEPENDS")
  if(NOT arg_DESCRIPTION OR NOT arg_CODELS)
    message(FATAL_ERROR "runnel_component(${name}) needs a DESCRIPTION and CODELS")
  endif()
  runnel_generated_component(${name} runnel made DESCRIPTION "${arg_DESCRIPTION}" INCLUDES ${arg_INCLUDES})
  add_custom_target(${name}_made DEPENDS ${made})
  add_library(${name}_codels OBJECT ${arg_CODELS})
  get_property(languages GLOBAL PROPERTY ENABLED_LANGUAGES)
  if(NOT C IN_LIST languages)
    set(in_c ${arg_CODELS})
    list(FILTER in_c INCLUDE REGEX "\\.c$")
    set_source_files_properties(${in_c} PROPERTIES LANGUAGE CXX)  # as most of those are that others have written
  endif()
  set_target_properties(${name}_codels PROPERTIES POSITION_INDEPENDENT_CODE ON UNITY_BUILD OFF)
  target_include_directories(${name}_codels PUBLIC "${made_folder}" ${arg_INCLUDES})
  add_dependencies(${name}_codels ${name}_made)
  target_link_libraries(${name}_codels PUBLIC ${arg_DEPENDS})
  if(arg_PACKAGES)
    find_package(PkgConfig REQUIRED)
    pkg_check_modules(${name}_packages REQUIRED IMPORTED_TARGET ${arg_PACKAGES})
    target_link_libraries(${name}_codels PUBLIC PkgConfig::${name}_packages)
  endif()
  set(${sources} ${made} PARENT_SCOPE)
endfunction()

# runnel_component(<name> DESCRIPTION <file.gen> CODELS <source> ... [INCLUDES <folder> ...] [PACKAGES <package> ...]
#                  [DEPENDS <library> ...])
# A plugin <name> with the module type <name>/<name>, made from the description of the component <name> by the template
# `runnel`; again when the description, what it includes, or a template has changed. What is made lies in the build tree.
# CODELS, in C or C++, are compiled once, as the target <name>_codels, whatever they are linked with. INCLUDES are
# searched by the description and the codels, PACKAGES are those of pkg-config, DEPENDS are libraries, which both use.
function(runnel_component name)
  runnel_component_sources(${name} sources ${ARGN})
  runnel_plugin(${name} SOURCES ${sources} DEPENDS ${name}_codels runnel::genom_modules)
  add_dependencies(runnel_plugin_${name} ${name}_made)
endfunction()

# runnel_standalone(<name> DESCRIPTION <file.gen> [INCLUDES <folder> ...] [LIBRARIES <library> ...])
# A program <name>-standalone, which runs the component without Runnel, of the same objects of the target <name>_codels:
# behind runnel_component(<name> ...). LIBRARIES are what the codels call.
function(runnel_standalone name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "DESCRIPTION" "INCLUDES;LIBRARIES")
  if(NOT arg_DESCRIPTION OR NOT TARGET ${name}_codels)
    message(FATAL_ERROR "runnel_standalone(${name}) needs a DESCRIPTION, and runnel_component(${name}) before it")
  endif()
  runnel_generated_component(${name} standalone made DESCRIPTION "${arg_DESCRIPTION}" INCLUDES ${arg_INCLUDES})
  add_executable(${name}_standalone ${made} $<TARGET_OBJECTS:${name}_codels>)
  set_target_properties(${name}_standalone PROPERTIES OUTPUT_NAME ${name}-standalone UNITY_BUILD OFF)
  target_compile_features(${name}_standalone PRIVATE cxx_std_20)
  target_link_libraries(${name}_standalone PRIVATE runnel::genom_standalone ${arg_LIBRARIES})
  if(TARGET runnel_warnings)
    target_include_directories(${name}_standalone PRIVATE "${RUNNEL_ROOT}")
    target_link_libraries(${name}_standalone PRIVATE runnel_warnings)
  endif()
endfunction()
