# Run while building: the folder FROM with its packages into TO. Where npm cannot get them, the tests that
# need them say so; everything else is built.
#   cmake -D NPM= -D FROM= -D TO= -P install_npm_packages.cmake
include("${CMAKE_CURRENT_LIST_DIR}/../../core/cmake/NpmPackages.cmake")

file(GLOB files "${FROM}/*")
file(COPY ${files} DESTINATION "${TO}")
install_npm_packages("${NPM}" "${FROM}" "${TO}" problem)
if(problem)
  message("Tests will be skipped: ${problem}")
endif()
file(TOUCH "${TO}/installed")
