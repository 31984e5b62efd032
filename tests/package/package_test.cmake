# Run by ctest, see CMakeLists.txt beside this file.
function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    list(JOIN ARGV " " command)
    message(FATAL_ERROR "${command}\nended with ${result}:\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

set(stage ${WORK_DIR}/stage)
set(build ${WORK_DIR}/consumer-build)
file(REMOVE_RECURSE ${stage} ${build})

run(${CMAKE_COMMAND} --install ${GLISSADE_BINARY_DIR} --prefix ${stage})
set(flags "")
if(SANITIZE)
  set(flags "-fsanitize=${SANITIZE}")
endif()
run(${CMAKE_COMMAND} -S ${CONSUMER_SOURCE_DIR} -B ${build} -G ${GENERATOR}
  -DCMAKE_PREFIX_PATH=${stage} -DCMAKE_CXX_COMPILER=${CXX_COMPILER} -DCMAKE_CXX_FLAGS=${flags})
run(${CMAKE_COMMAND} --build ${build})
run(${CMAKE_COMMAND} -E chdir ${build} ./consumer)
if(NOT output MATCHES "friction angle 17 deg, 2 files, 11 points")
  message(FATAL_ERROR "the consumer printed:\n${output}")
endif()

# Every public header is installed, and nothing else.
file(GLOB_RECURSE public_headers RELATIVE ${SOURCE_DIR}/lib/include ${SOURCE_DIR}/lib/include/*.hpp)
file(READ ${build}/headers.txt installed)
list(SORT public_headers)
list(SORT installed)
if(NOT public_headers STREQUAL installed)
  list(REMOVE_ITEM public_headers ${installed})
  message(FATAL_ERROR "public headers that no glissade_component() lists: ${public_headers}")
endif()

# The examples as the README has them built, each with the components that it asks for.
set(examples ${WORK_DIR}/examples-build)
file(REMOVE_RECURSE ${examples})
run(${CMAKE_COMMAND} -S ${SOURCE_DIR}/examples -B ${examples} -G ${GENERATOR}
  -DCMAKE_PREFIX_PATH=${stage} -DCMAKE_CXX_COMPILER=${CXX_COMPILER} -DCMAKE_CXX_FLAGS=${flags})
run(${CMAKE_COMMAND} --build ${examples})
foreach(example "fastest_track|length 3.82231 m, travel time 1.22658 s, exit speed 3.27015 m/s" "ramp_to_stl|litres of material" "within_limits|held back by"
    "many_frictions|21 points in frictions")
  string(REPLACE "|" ";" example "${example}")
  list(GET example 0 program)
  list(GET example 1 wanted)
  run(${CMAKE_COMMAND} -E chdir ${examples} ./${program})
  if(NOT output MATCHES "${wanted}")
    message(FATAL_ERROR "${program} printed:\n${output}")
  endif()
endforeach()
# A search for tracks needs no library that draws, no threads' library and no cryptography.
file(READ ${examples}/build.ninja ninja)
string(REGEX MATCH "build within_limits: [^\n]*\n([^\n]+\n)+" linking "${ninja}")
if(NOT linking MATCHES "glissade_optimize")
  message(FATAL_ERROR "how within_limits is linked is not where it was looked for: ${linking}")
endif()
if(linking MATCHES "rsvg|cairo|tbb|crypto|yaml|gmp")
  message(FATAL_ERROR "within_limits is linked with ${CMAKE_MATCH_0}: ${linking}")
endif()

# A component that there is not is a clear error.
file(WRITE ${WORK_DIR}/wrong/CMakeLists.txt
  "cmake_minimum_required(VERSION 3.25)\nproject(Wrong LANGUAGES CXX)\nfind_package(glissade REQUIRED COMPONENTS swim)\n")
execute_process(COMMAND ${CMAKE_COMMAND} -S ${WORK_DIR}/wrong -B ${WORK_DIR}/wrong/build -G ${GENERATOR}
  -DCMAKE_PREFIX_PATH=${stage} -DCMAKE_CXX_COMPILER=${CXX_COMPILER}
  RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
if(result EQUAL 0 OR NOT output MATCHES "no component .swim.")
  message(FATAL_ERROR "a component that does not exist: ${output}")
endif()

# Taken in by another project: nothing of ours is forced on it.
set(parent ${WORK_DIR}/parent)
file(REMOVE_RECURSE ${parent})
file(WRITE ${parent}/CMakeLists.txt
  "cmake_minimum_required(VERSION 3.25)\n"
  "project(Parent LANGUAGES CXX)\n"
  "add_subdirectory(${SOURCE_DIR} glissade)\n"
  "get_property(pic TARGET glissade_core PROPERTY POSITION_INDEPENDENT_CODE)\n"
  "foreach(target glissade_app test_core check_public_headers docs)\n"
  "  if(TARGET \${target})\n"
  "    message(FATAL_ERROR \"\${target} is forced on a parent\")\n"
  "  endif()\n"
  "endforeach()\n"
  "if(NOT pic OR CMAKE_BUILD_TYPE)\n"
  "  message(FATAL_ERROR \"position independence \${pic}, build type '\${CMAKE_BUILD_TYPE}'\")\n"
  "endif()\n"
  "add_executable(own own.cpp)\ntarget_link_libraries(own PRIVATE glissade::solve)\n")
file(WRITE ${parent}/own.cpp "int main() {}\n")
run(${CMAKE_COMMAND} -S ${parent} -B ${parent}/build -G ${GENERATOR} -DCMAKE_CXX_COMPILER=${CXX_COMPILER})
file(STRINGS ${parent}/build/cmake_install.cmake installs REGEX "file\\(INSTALL")
if(installs)
  message(FATAL_ERROR "a parent installs ${installs}")
endif()
# A package that says where it was made would not work anywhere else.
file(GLOB_RECURSE package_files ${stage}/*.cmake)
foreach(file IN LISTS package_files)
  file(STRINGS ${file} lines REGEX "${GLISSADE_BINARY_DIR}")
  if(lines)
    message(FATAL_ERROR "${file} names the build tree: ${lines}")
  endif()
endforeach()
