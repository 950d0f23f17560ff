# The component that plugins/genom_templates/README.md walks through, as it is written there: its codels are made, built
# against the installed package, run as a module and as a process. Included by test.cmake.
function(take_from_readme before behind to)
  file(READ "${CMAKE_CURRENT_LIST_DIR}/../../../plugins/genom_templates/README.md" text)
  string(FIND "${text}" "${before}" begin)
  string(SUBSTRING "${text}" ${begin} -1 text)
  string(FIND "${text}" "${behind}" end)
  if(begin EQUAL -1 OR end EQUAL -1)
    message(FATAL_ERROR "the walk-through has no '${before}' any more")
  endif()
  string(SUBSTRING "${text}" 0 ${end} text)
  file(WRITE "${to}" "${text}")
endfunction()

set(lamp "${WORK}/lamp")
take_from_readme("struct light {" "```" "${lamp}/lamp.gen")
take_from_readme("<application name=\"house\"" "' > house.xml" "${lamp}/house.xml")
run(COMMAND "${program}" check "${lamp}/lamp.gen")
run(COMMAND "${program}" generate skeleton "${lamp}/lamp.gen" -o "${lamp}" EXPECT "lamp_shine_codels.c")
run(COMMAND "${CMAKE_COMMAND}" -G Ninja -S "${lamp}" -B "${lamp}/build" "-DCMAKE_PREFIX_PATH=${WORK}/prefix"
  "-DCMAKE_CXX_COMPILER=${COMPILER}" "-DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER}" "-DCMAKE_C_COMPILER_LAUNCHER=${LAUNCHER}"
  "-DCMAKE_CXX_FLAGS=${FLAGS}" "-DCMAKE_C_FLAGS=${FLAGS}" ${unoptimised})
run(COMMAND "${CMAKE_COMMAND}" --build "${lamp}/build")
set(ENV{RUNNEL_PLUGIN_PATH} "${lamp}/build/lib/runnel/plugins")
run(COMMAND "${program}" modules lamp EXPECT "lamp/lamp.*A lamp that can blink")
run(COMMAND "${program}" run --duration 1 "${lamp}/house.xml" EXPECT "time is up")
unset(ENV{RUNNEL_PLUGIN_PATH})
# It comes to a clean end once it listens.
run(COMMAND sh -c "cd '${lamp}'; build/lamp-standalone & lamp=$!
while [ ! -S lamp.socket ]; do kill -0 $lamp || exit 1; sleep 0.05; done; kill -TERM $lamp; wait $lamp")
