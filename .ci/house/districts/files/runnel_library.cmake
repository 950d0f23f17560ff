# runnel_main_library(): librunnel.so, which has what every application has. runnel_library() adds to it.
function(runnel_main_library)
  add_library(runnel_main)
  set_target_properties(runnel_main PROPERTIES OUTPUT_NAME runnel EXPORT_NAME librunnel LINKER_LANGUAGE CXX)
  runnel_library_version(runnel_main)
  # What is built is linked with it by the names of its layers, and so are those who use the package.
  install(TARGETS runnel_main EXPORT runnelTargets
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT librunnel NAMELINK_COMPONENT librunnel-dev
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT librunnel-dev)
endfunction()

# Before 1.0 a new minor version may break, and has a name of its own for its libraries.
function(runnel_library_version target)
  set_target_properties(${target} PROPERTIES VERSION ${PROJECT_VERSION}
    SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
endfunction()

# runnel_library(<name> [STATIC|SHARED] [SOURCES ...] [APART ...] HEADERS ... [DEPENDS ...] [PRIVATE_DEPENDS ...])
# What others link as runnel::<name>. Its sources are compiled as the target runnel_<name>:
# - what every application has (a "+" in layers.txt) becomes part of librunnel.so, and whoever links it links that;
# - all else goes into what links it (an extension, a program, a test), and is not installed,
# - but STATIC, which is: what belongs to one plugin, and comes and goes with it when that is loaded anew,
# - and SHARED, a library of its own: what several plugins have in common.
# Without SOURCES it is header-only. APART are sources, too, that cannot be compiled together with the others.
# Headers of what is installed are installed as <runnel/path from the root of the tree>; each must compile alone (target
# all_verify_interface_header_sets).
function(runnel_library name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "STATIC;SHARED" "" "SOURCES;APART;HEADERS;DEPENDS;PRIVATE_DEPENDS")
  file(RELATIVE_PATH folder "${RUNNEL_ROOT}" "${CMAKE_CURRENT_SOURCE_DIR}")
  runnel_is_in_every_application(is_part "${folder}")
  set(is_inside OFF)
  set(linked runnel_${name})
  if(NOT arg_SOURCES)
    add_library(runnel_${name} INTERFACE)
  elseif(arg_SHARED)
    add_library(runnel_${name})
    runnel_library_version(runnel_${name})
  elseif(is_part AND NOT arg_STATIC)
    runnel_library_part(${name} linked)
  else()
    # Hidden: what two versions of a plugin have in common would be one for both.
    add_library(runnel_${name} STATIC)
    set_target_properties(runnel_${name} PROPERTIES CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
    if(NOT arg_STATIC)
      set(is_inside ON)
    endif()
  endif()
  add_library(runnel::${name} ALIAS ${linked})
  set_target_properties(${linked} PROPERTIES EXPORT_NAME ${name})
  set(targets runnel_${name} ${linked})
  list(REMOVE_DUPLICATES targets)
  foreach(target IN LISTS targets)
    get_target_property(type ${target} TYPE)
    set(scope PUBLIC)
    if(type STREQUAL "INTERFACE_LIBRARY")
      set(scope INTERFACE)
    endif()
    target_include_directories(${target} ${scope}
      "$<BUILD_INTERFACE:${RUNNEL_ROOT}>" "$<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>")
    target_compile_features(${target} ${scope} cxx_std_20)
    if(NOT type STREQUAL "OBJECT_LIBRARY")
      target_link_libraries(${target} ${scope} ${arg_DEPENDS})
    endif()
  endforeach()
  if(arg_SOURCES)
    target_sources(runnel_${name} PRIVATE ${arg_SOURCES} ${arg_APART})
    runnel_compile_together(runnel_${name} 8 ${arg_APART})
    target_link_libraries(runnel_${name} PRIVATE $<BUILD_INTERFACE:runnel_warnings>)
    if(is_part AND NOT arg_STATIC)
      runnel_link_part(${name} ${arg_DEPENDS} PRIVATE ${arg_PRIVATE_DEPENDS})
    else()
      target_link_libraries(runnel_${name} PRIVATE ${arg_PRIVATE_DEPENDS})
    endif()
  endif()
  if(NOT is_inside)
    install(TARGETS ${linked} EXPORT runnelTargets
      LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} NAMELINK_COMPONENT librunnel-dev
      ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT librunnel-dev)
  endif()
  runnel_public_headers(${name} ${is_inside} ${arg_HEADERS})
endfunction()

# The objects of a part of librunnel.so, runnel_<name>, and what others link instead, the target whose name <linked> gets.
function(runnel_library_part name linked)
  add_library(runnel_${name} OBJECT)
  # Functions of the library may be inlined into one another; nobody replaces them by preloading.
  target_compile_options(runnel_${name} PRIVATE -fno-semantic-interposition)
  target_sources(runnel_main PRIVATE $<TARGET_OBJECTS:runnel_${name}>)
  add_library(runnel_${name}_linked INTERFACE)
  target_link_libraries(runnel_${name}_linked INTERFACE runnel_main)
  set(${linked} runnel_${name}_linked PARENT_SCOPE)
endfunction()

# What a part is compiled with: other parts are there as objects only, for the library of all of them cannot be linked by what
# it is made of. Libraries of others are the whole library's.
function(runnel_link_part name)
  set(scope PUBLIC)
  foreach(library IN LISTS ARGN)
    if(library STREQUAL "PRIVATE")
      set(scope PRIVATE)
      continue()
    endif()
    string(REGEX REPLACE "^runnel::" "runnel_" objects "${library}")
    set(type "")
    if(TARGET ${objects})
      get_target_property(type ${objects} TYPE)
    endif()
    if(type STREQUAL "OBJECT_LIBRARY")
      target_link_libraries(runnel_${name} ${scope} ${objects})
    elseif(library MATCHES "^runnel::")
      message(FATAL_ERROR "${name} is part of librunnel.so and cannot depend on ${library}, which is none")
    else()
      target_link_libraries(runnel_${name} ${scope} "${library}")
      target_link_libraries(runnel_main PRIVATE "${library}")
    endif()
  endforeach()
endfunction()

# runnel_public_headers(<library> <inside> <header> ...): what InstallHeaders.cmake is to install, unless nobody but this tree
# can link the library. A set of their own, since a library's set would be installed as it is, and told to those who use the
# package.
function(runnel_public_headers name is_inside)
  list(TRANSFORM ARGN PREPEND "${CMAKE_CURRENT_SOURCE_DIR}/" OUTPUT_VARIABLE headers)
  if(NOT is_inside)
    set_property(GLOBAL APPEND PROPERTY RUNNEL_PUBLIC_HEADERS ${headers})
  endif()
  add_library(runnel_${name}_headers INTERFACE)
  target_link_libraries(runnel_${name}_headers INTERFACE runnel::${name})
  target_sources(runnel_${name}_headers INTERFACE
    FILE_SET HEADERS BASE_DIRS "${RUNNEL_ROOT}" FILES ${headers})
  set_target_properties(runnel_${name}_headers PROPERTIES VERIFY_INTERFACE_HEADER_SETS ON)
endfunction()

