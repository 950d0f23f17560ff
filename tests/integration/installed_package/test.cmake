# Installs the build tree BUILD, builds the project `outside` against it alone, and has the
# installed program load and run what came out. Everything happens below WORK.
function(run)
  cmake_parse_arguments(PARSE_ARGV 0 arg "" "EXPECT" "COMMAND")
  execute_process(COMMAND ${arg_COMMAND} RESULT_VARIABLE status OUTPUT_VARIABLE output
    ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${arg_COMMAND} ended with ${status}:\n${output}")
  endif()
  if(arg_EXPECT AND NOT output MATCHES "${arg_EXPECT}")
    message(FATAL_ERROR "${arg_COMMAND} does not say '${arg_EXPECT}':\n${output}")
  endif()
endfunction()

file(REMOVE_RECURSE "${WORK}")
run(COMMAND "${CMAKE_COMMAND}" --install "${BUILD}" --prefix "${WORK}/prefix")
include("${CMAKE_CURRENT_LIST_DIR}/headers.cmake")
run(COMMAND "${CMAKE_COMMAND}" -G Ninja -S "${SOURCE}" -B "${WORK}/outside"
  "-DCMAKE_PREFIX_PATH=${WORK}/prefix" "-DCMAKE_CXX_COMPILER=${COMPILER}"
  "-DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER}" "-DCMAKE_CXX_FLAGS=${FLAGS}"
  EXPECT "no CMAKE_BUILD_TYPE is set, so it is RelWithDebInfo")
# What is built here runs for seconds, and would be compiled for longer than that.
set(unoptimised -DCMAKE_BUILD_TYPE=None)
run(COMMAND "${CMAKE_COMMAND}" "${WORK}/outside" ${unoptimised})
run(COMMAND "${CMAKE_COMMAND}" --build "${WORK}/outside")
run(COMMAND "${CMAKE_CTEST_COMMAND}" --test-dir "${WORK}/outside" --no-tests=error --output-on-failure)

if(NOT EXISTS "${WORK}/outside/lib/runnel/plugins/outside.manifest.xml")
  message(FATAL_ERROR "the plugin has no manifest")
endif()
file(READ "${WORK}/prefix/share/man/man1/runnel.1" manual)
if(NOT manual MATCHES "SS runnel log.*SS runnel swap.*probation.*RUNNEL_PLUGIN_PATH")
  message(FATAL_ERROR "the manual page is not whole: ${manual}")
endif()
foreach(document LICENSE CHANGELOG.md pages/index.md)
  if(NOT EXISTS "${WORK}/prefix/share/doc/runnel/${document}")
    message(FATAL_ERROR "${document} is not installed")
  endif()
endforeach()
# Loaded from where it was built, and from where it was installed.
set(program "${WORK}/prefix/bin/runnel")
set(ENV{RUNNEL_PLUGIN_PATH} "${WORK}/outside/lib/runnel/plugins")
run(COMMAND "${program}" modules outside EXPECT "outside/wanderer.*drives ahead")
run(COMMAND "${program}" modules hop EXPECT "hop/hop.*A number that sinks")
unset(ENV{RUNNEL_PLUGIN_PATH})
run(COMMAND "${CMAKE_COMMAND}" --install "${WORK}/outside" --prefix "${WORK}/prefix")
run(COMMAND "${program}" modules outside EXPECT "outside/wanderer.*drives ahead")
run(COMMAND "${program}" modules simulation EXPECT "simulation/world")
set(world "world=rooms")
run(COMMAND "${program}" check "${SOURCE}/wander.xml" "${world}")
run(COMMAND "${program}" run --fast --duration 5 "${SOURCE}/wander.xml" "${world}"
  --trace "${WORK}/trace.json" EXPECT "traced [0-9]+ events")

# A program that has the application as an object.
run(COMMAND "${WORK}/outside/embedding" "${WORK}/prefix/share/runnel/xml/apps/bug_demo.xml"
  EXPECT "swapped at .*the robot is at ")
# It needs nothing of browsers and recordings.
run(COMMAND sh -c "if ldd '${WORK}/outside/embedding' | grep -E 'inspector|foxglove|web_server|recording|mcap|tracing'; then exit 1; fi")

include("${CMAKE_CURRENT_LIST_DIR}/new_projects.cmake")
include("${CMAKE_CURRENT_LIST_DIR}/component.cmake")
