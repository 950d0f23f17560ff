# What `runnel new` writes, built against the installed package and tested. Included by test.cmake.
function(build_and_test folder)
  run(COMMAND "${CMAKE_COMMAND}" -G Ninja -S "${folder}" -B "${folder}/build"
    "-DCMAKE_PREFIX_PATH=${WORK}/prefix" "-DCMAKE_CXX_COMPILER=${COMPILER}"
    "-DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER}" "-DCMAKE_CXX_FLAGS=${FLAGS} -Wall -Wextra -Werror" ${unoptimised})
  run(COMMAND "${CMAKE_COMMAND}" --build "${folder}/build")
  run(COMMAND "${CMAKE_CTEST_COMMAND}" --test-dir "${folder}/build" --no-tests=error
    --output-on-failure EXPECT "tests passed")
endfunction()

set(new "${WORK}/new")
run(COMMAND "${program}" new plugin follower --in "${new}" EXPECT "ctest --test-dir build")
run(COMMAND "${program}" new module leader --in "${new}/follower" EXPECT "follower/leader")
file(REMOVE "${new}/follower/leader_test.cpp")
run(COMMAND "${program}" new test leader --in "${new}/follower" EXPECT "follower/leader")
build_and_test("${new}/follower")
set(ENV{RUNNEL_PLUGIN_PATH} "${new}/follower/build/lib/runnel/plugins")
run(COMMAND "${program}" modules follower EXPECT "follower/follower.*follower/leader")
run(COMMAND "${program}" run --fast --duration 5 "${new}/follower/follower.xml" EXPECT "time is up")
unset(ENV{RUNNEL_PLUGIN_PATH})

run(COMMAND "${program}" new application robot --in "${new}" EXPECT "runnel run")
build_and_test("${new}/robot")
run(COMMAND "${program}" run --fast "${new}/robot/robot.xml" EXPECT "reached")
