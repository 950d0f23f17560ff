# The verbs that every CMakeLists.txt of the tree is written in. Each makes ordinary targets, so
# that target_* commands can still be added by hand.

include(GNUInstallDirs)  # outside of this tree nobody else has

get_filename_component(RUNNEL_ROOT "${CMAKE_CURRENT_LIST_DIR}/../.." ABSOLUTE)

# runnel_compile_together(<target> <count> [<source of its own> ...])
# Compiles <count> sources of the target at a time, as one, so that the headers they share are read once;
# those named are compiled each for itself. Two that are compiled together cannot have the same name in
# their anonymous namespaces.
function(runnel_compile_together target count)
  set_target_properties(${target} PROPERTIES
    UNITY_BUILD "${RUNNEL_COMPILE_TOGETHER}" UNITY_BUILD_BATCH_SIZE ${count})
  set_source_files_properties(${ARGN} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  # GCC then has much to look after; that it looks for what it needs no more only once it holds 500 MB saves a seventh
  # of its time for a fifth more memory.
  target_compile_options(${target} PRIVATE $<$<COMPILE_LANG_AND_ID:CXX,GNU>:--param=ggc-min-heapsize=500000>)
endfunction()

# runnel_library(<name> [STATIC] [SOURCES ...] [APART ...] HEADERS ... [DEPENDS ...] [PRIVATE_DEPENDS ...])
# A library runnel_<name>, known to others as runnel::<name>. Without SOURCES it is header-only.
# APART are sources, too, that cannot be compiled together with the others.
# STATIC is what belongs to one plugin, and comes and goes with it when that is loaded anew.
# Its headers are installed as <runnel/path from the root of the tree>, and each must compile alone
# (target all_verify_interface_header_sets).
function(runnel_library name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "STATIC" "" "SOURCES;APART;HEADERS;DEPENDS;PRIVATE_DEPENDS")
  if(arg_STATIC)
    # Hidden: what two versions of a plugin have in common would be one for both.
    add_library(runnel_${name} STATIC)
    set_target_properties(runnel_${name} PROPERTIES
      CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
  elseif(arg_SOURCES)
    add_library(runnel_${name})
  endif()
  if(arg_SOURCES)
    target_sources(runnel_${name} PRIVATE ${arg_SOURCES} ${arg_APART})
    runnel_compile_together(runnel_${name} 8 ${arg_APART})
    set(scope PUBLIC)
    target_link_libraries(runnel_${name} PRIVATE $<BUILD_INTERFACE:runnel_warnings> ${arg_PRIVATE_DEPENDS})
  else()
    add_library(runnel_${name} INTERFACE)
    set(scope INTERFACE)
  endif()
  add_library(runnel::${name} ALIAS runnel_${name})
  target_include_directories(runnel_${name} ${scope}
    "$<BUILD_INTERFACE:${RUNNEL_ROOT}>" "$<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>")
  target_compile_features(runnel_${name} ${scope} cxx_std_20)
  target_link_libraries(runnel_${name} ${scope} ${arg_DEPENDS})
  set_target_properties(runnel_${name} PROPERTIES EXPORT_NAME ${name})
  if(arg_SOURCES)
    # Before 1.0 a new minor version may break, and has names of its own for its libraries.
    set_target_properties(runnel_${name} PROPERTIES VERSION ${PROJECT_VERSION}
      SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
  endif()
  install(TARGETS runnel_${name} EXPORT runnelTargets
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} NAMELINK_COMPONENT librunnel-dev
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT librunnel-dev)
  runnel_public_headers(${name} ${arg_HEADERS})
endfunction()

# runnel_public_headers(<library> <header> ...): what InstallHeaders.cmake is to install. A set of their own, since
# a library's set would be installed as it is, and told to those who use the package.
function(runnel_public_headers name)
  list(TRANSFORM ARGN PREPEND "${CMAKE_CURRENT_SOURCE_DIR}/" OUTPUT_VARIABLE headers)
  set_property(GLOBAL APPEND PROPERTY RUNNEL_PUBLIC_HEADERS ${headers})
  add_library(runnel_${name}_headers INTERFACE)
  target_link_libraries(runnel_${name}_headers INTERFACE runnel_${name})
  target_sources(runnel_${name}_headers INTERFACE
    FILE_SET HEADERS BASE_DIRS "${RUNNEL_ROOT}" FILES ${headers})
  set_target_properties(runnel_${name}_headers PROPERTIES VERIFY_INTERFACE_HEADER_SETS ON)
endfunction()

# runnel_write_manifest(<plugin>)
# Has what the plugin's modules look like written beside its library each time that is linked. Where its code cannot
# be run, that is left out.
function(runnel_write_manifest name)
  if(CMAKE_CROSSCOMPILING AND NOT CMAKE_CROSSCOMPILING_EMULATOR)
    return()
  endif()
  set(program runnel::manifest_program)
  if(TARGET runnel_warnings)
    set(program runnel_manifest_program)
    add_dependencies(runnel_plugin_${name} ${program})
  endif()
  target_link_options(runnel_plugin_${name} PRIVATE LINKER:--build-id)
  add_custom_command(TARGET runnel_plugin_${name} POST_BUILD
    COMMAND ${program} "$<TARGET_FILE:runnel_plugin_${name}>" VERBATIM)
  install(FILES "${CMAKE_BINARY_DIR}/lib/runnel/plugins/${name}.manifest.xml"
    DESTINATION ${CMAKE_INSTALL_LIBDIR}/runnel/plugins)
endfunction()

# runnel_plugin(<name> SOURCES ... [DEPENDS ...])
# A loadable library lib/runnel/plugins/<name>.so, which the runtime finds by <name>, with its manifest. Works in this
# tree and, after find_package(runnel), in any other. The target runnel_plugins builds all of them.
function(runnel_plugin name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "SOURCES;DEPENDS")
  add_library(runnel_plugin_${name} MODULE ${arg_SOURCES})
  runnel_compile_together(runnel_plugin_${name} 6)
  target_compile_features(runnel_plugin_${name} PRIVATE cxx_std_20)
  target_link_libraries(runnel_plugin_${name} PRIVATE ${arg_DEPENDS})
  if(TARGET runnel_warnings)
    target_link_libraries(runnel_plugin_${name} PRIVATE runnel_warnings)
  endif()
  set_target_properties(runnel_plugin_${name} PROPERTIES
    PREFIX "" OUTPUT_NAME "${name}" CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON
    LIBRARY_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/lib/runnel/plugins"
    # Installed, it finds Runnel's libraries two folders up, or where it was linked with them.
    INSTALL_RPATH "$ORIGIN/../.." INSTALL_RPATH_USE_LINK_PATH ON)
  if(NOT TARGET runnel_plugins)
    add_custom_target(runnel_plugins)
  endif()
  add_dependencies(runnel_plugins runnel_plugin_${name})
  install(TARGETS runnel_plugin_${name}
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/runnel/plugins)
  runnel_write_manifest(${name})
endfunction()

# runnel_extension(<name> SOURCES ... [DEPENDS ...])
# A plugin that adds to applications what extension.xml beside the CMakeLists.txt says (plugins/application).
# That is found by the runtime without loading the library, and may be installed without it.
function(runnel_extension name)
  runnel_plugin(${name} ${ARGN})
  configure_file(extension.xml "${CMAKE_BINARY_DIR}/lib/runnel/plugins/${name}.extension.xml" COPYONLY)
  install(FILES extension.xml RENAME "${name}.extension.xml"
    DESTINATION ${CMAKE_INSTALL_LIBDIR}/runnel/plugins)
endfunction()

# runnel_test(<name> [OPTIMISED] SOURCES ... [DEPENDS ...] [PLUGINS ...] [LABELS ...] [TIMEOUT seconds] [APART ...])
# A GoogleTest program with runnel::testing; each of its test cases becomes a CTest test called <name>/<Suite>.<Case>.
# Works in this tree and, after find_package(runnel) and enable_testing(), in any other.
# PLUGINS are those of the tree that its rigs load; they are built before, and found.
# OPTIMISED is one whose own code, and not only the library's, computes for many seconds.
function(runnel_test name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "OPTIMISED" "TIMEOUT"
    "SOURCES;DEPENDS;PLUGINS;LABELS;APART")
  if(NOT arg_TIMEOUT)
    set(arg_TIMEOUT 120)
  endif()
  if(NOT arg_LABELS)
    set(arg_LABELS unit)
  endif()
  add_executable(test_${name} ${arg_SOURCES} ${arg_APART})
  runnel_compile_together(test_${name} 8 ${arg_APART})
  target_link_libraries(test_${name} PRIVATE ${arg_DEPENDS} GTest::gmock GTest::gtest_main)
  if(TARGET runnel_test_headers)
    target_include_directories(test_${name} PRIVATE "${RUNNEL_ROOT}")
    target_link_libraries(test_${name} PRIVATE runnel_warnings runnel_test_warnings fmt::fmt)
    if(NOT arg_OPTIMISED)
      target_compile_options(test_${name} PRIVATE ${RUNNEL_TEST_OPTIMISATION})
      target_precompile_headers(test_${name} REUSE_FROM runnel_test_headers)
    endif()
  else()
    if(NOT TARGET GTest::gmock)
      message(FATAL_ERROR "runnel_test() needs GoogleTest: install libgtest-dev and libgmock-dev")
    endif()
    include(GoogleTest)
    target_compile_features(test_${name} PRIVATE cxx_std_20)
    target_link_libraries(test_${name} PRIVATE runnel::testing)
  endif()
  foreach(plugin IN LISTS arg_PLUGINS)
    add_dependencies(test_${name} runnel_plugin_${plugin})
    target_compile_definitions(test_${name} PRIVATE
      RUNNEL_TEST_PLUGIN_FOLDER="${CMAKE_BINARY_DIR}/lib/runnel/plugins")
  endforeach()
  gtest_discover_tests(test_${name} TEST_PREFIX "${name}/" DISCOVERY_TIMEOUT 60
    PROPERTIES LABELS "${arg_LABELS}" TIMEOUT ${arg_TIMEOUT})
endfunction()

# runnel_bench(<name> SOURCES ... [DEPENDS ...]): a Google Benchmark program bin/bench_<name>.
function(runnel_bench name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "SOURCES;DEPENDS")
  add_executable(bench_${name} ${arg_SOURCES})
  target_include_directories(bench_${name} PRIVATE "${RUNNEL_ROOT}")
  target_link_libraries(bench_${name} PRIVATE
    runnel_warnings ${arg_DEPENDS} benchmark::benchmark benchmark::benchmark_main)
endfunction()

include("${CMAKE_CURRENT_LIST_DIR}/RunnelComponents.cmake")
