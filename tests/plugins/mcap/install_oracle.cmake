# What the oracle needs, into the build tree. Where npm cannot get it (no network), the tests that need it
# say so; everything else is built.
file(MAKE_DIRECTORY "${TO}")
foreach(file package.json package-lock.json read.mjs write.mjs)
  file(COPY "${FROM}/${file}" DESTINATION "${TO}")
endforeach()
execute_process(COMMAND "${NPM}" ci --no-audit --no-fund --ignore-scripts WORKING_DIRECTORY "${TO}"
  RESULT_VARIABLE failed OUTPUT_VARIABLE said ERROR_VARIABLE said)
if(failed)
  file(REMOVE_RECURSE "${TO}/node_modules")
  message("npm could not install @mcap/core; its tests will be skipped:\n${said}")
endif()
file(TOUCH "${TO}/installed")
