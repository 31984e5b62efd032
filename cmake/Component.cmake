# The library in components: one static or shared library a module, each with the headers that it installs, the
# components that it stands on and the packages that whoever links it needs. lib/CMakeLists.txt exports them.

# glissade_component(NAME [DEPENDS component...] [HEADERS header...] SOURCES source...)
#   The target glissade_NAME, glissade::NAME for users. Headers are given relative to lib/include/glissade.
#   Components are declared before those that stand on them.
function(glissade_component name)
  cmake_parse_arguments(PARSE_ARGV 1 given "" "" "DEPENDS;HEADERS;SOURCES")
  if(given_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "glissade_component(${name}): what is ${given_UNPARSED_ARGUMENTS}?")
  endif()
  set(target glissade_${name})
  set(include ${PROJECT_SOURCE_DIR}/lib/include)
  list(TRANSFORM given_HEADERS PREPEND ${include}/glissade/)
  list(TRANSFORM given_DEPENDS PREPEND glissade:: OUTPUT_VARIABLE below)

  add_library(${target} ${given_SOURCES})
  add_library(glissade::${name} ALIAS ${target})
  # The public contract: installed as it is, and each header compiles on its own (target check_public_headers).
  target_sources(${target} PUBLIC FILE_SET HEADERS BASE_DIRS ${include} FILES ${given_HEADERS})
  set_target_properties(${target} PROPERTIES
    EXPORT_NAME ${name}
    VERSION ${PROJECT_VERSION}
    # A module of another language takes it as it is.
    POSITION_INDEPENDENT_CODE ON
    # What a source keeps to itself must not be named as what another of its component does.
    UNITY_BUILD ${GLISSADE_JOIN_SOURCES}
    UNITY_BUILD_BATCH_SIZE 16
    VERIFY_INTERFACE_HEADER_SETS ON)
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR}/lib/src)
  target_link_libraries(${target} PUBLIC ${below} PRIVATE $<BUILD_INTERFACE:glissade_compile_settings>)

  set_property(GLOBAL APPEND PROPERTY GLISSADE_COMPONENTS ${name})
  set_property(GLOBAL PROPERTY GLISSADE_${name}_DEPENDS "${given_DEPENDS}")
endfunction()

# glissade_needs(NAME package [argument...]): finds the package, here and where the installed component is used.
macro(glissade_needs name)
  string(JOIN " " glissade_package ${ARGN})
  set_property(GLOBAL APPEND PROPERTY GLISSADE_${name}_PACKAGES "find_dependency(${glissade_package})")
  find_package(${ARGN} REQUIRED)
endmacro()

# glissade_needs_module(NAME prefix module...): the same of modules that pkg-config knows: PkgConfig::prefix.
macro(glissade_needs_module name prefix)
  string(JOIN " " glissade_modules ${ARGN})
  set_property(GLOBAL APPEND PROPERTY GLISSADE_${name}_PACKAGES "find_dependency(PkgConfig)"
    "pkg_check_modules(${prefix} REQUIRED QUIET IMPORTED_TARGET ${glissade_modules})")
  find_package(PkgConfig REQUIRED)
  pkg_check_modules(${prefix} REQUIRED IMPORTED_TARGET ${ARGN})
endmacro()

# glissade_install_components(DIRECTORY): each component with an export of its own, so that a project which asks for
# one needs the packages of no other. Sets glissade_component_finds for glissade-config.cmake.in.
function(glissade_install_components directory)
  get_property(components GLOBAL PROPERTY GLISSADE_COMPONENTS)
  set(finds "")
  foreach(component IN LISTS components)
    install(TARGETS glissade_${component} EXPORT glissade-${component}-targets FILE_SET HEADERS)
    install(EXPORT glissade-${component}-targets NAMESPACE glissade:: DESTINATION ${directory})
    get_property(packages GLOBAL PROPERTY GLISSADE_${component}_PACKAGES)
    string(APPEND finds "if(${component} IN_LIST glissade_wanted)\n")
    if(packages AND NOT BUILD_SHARED_LIBS)
      # A static library leaves its own libraries to be linked by whoever uses it.
      string(REPLACE ";" "\n  " packages "${packages}")
      string(APPEND finds "  ${packages}\n")
    endif()
    string(APPEND finds
      "  include(\"\${CMAKE_CURRENT_LIST_DIR}/glissade-${component}-targets.cmake\")\n"
      "  set(glissade_${component}_FOUND TRUE)\n"
      "endif()\n")
  endforeach()
  set(glissade_component_finds "${finds}" PARENT_SCOPE)
  set(depends "")
  foreach(component IN LISTS components)
    get_property(below GLOBAL PROPERTY GLISSADE_${component}_DEPENDS)
    string(APPEND depends "set(glissade_${component}_depends ${below})\n")
  endforeach()
  set(glissade_component_depends "${depends}" PARENT_SCOPE)
  list(REVERSE components)
  set(glissade_components_from_above "${components}" PARENT_SCOPE)
endfunction()
