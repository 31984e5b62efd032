# One interface target carries how every Glissade target is compiled; it is not installed.
add_library(glissade_compile_settings INTERFACE)
target_compile_features(glissade_compile_settings INTERFACE cxx_std_20)
target_compile_options(glissade_compile_settings INTERFACE
  # Same input, same bytes: no fused multiply-add that one machine has and the next has not.
  -ffp-contract=off
  # Nobody replaces single functions of ours when the program starts: they are inlined in a library's own code.
  -fno-semantic-interposition
  # GCC's own collecting of garbage takes a twentieth of its time; half a gigabyte holds all of most sources.
  $<$<CXX_COMPILER_ID:GNU>:--param=ggc-min-heapsize=500000>
  -Wall -Wextra -Wpedantic -Wconversion -Wnon-virtual-dtor -Wold-style-cast -Woverloaded-virtual
  # GCC before 13 sees overlapping copies in "text" + std::string where there are none (its bug 105651).
  $<$<AND:$<CXX_COMPILER_ID:GNU>,$<VERSION_LESS:$<CXX_COMPILER_VERSION>,13>>:-Wno-restrict>)
# Where sources are joined, names of one are no globals of the next, nor is a source a header: the preset dev looks.
set(joined $<BOOL:$<TARGET_PROPERTY:UNITY_BUILD>>)
target_compile_options(glissade_compile_settings INTERFACE
  $<$<NOT:${joined}>:-Wshadow>
  $<$<AND:${joined},$<CXX_COMPILER_ID:GNU>>:-Wshadow=local>
  $<$<AND:${joined},$<CXX_COMPILER_ID:GNU>>:-Wno-subobject-linkage>
  # Where much is inlined GCC 12 takes an empty std::optional's inside for something that is read.
  $<$<AND:${joined},$<CXX_COMPILER_ID:GNU>>:-Wno-maybe-uninitialized>)
if(GLISSADE_WARNINGS_AS_ERRORS)
  target_compile_options(glissade_compile_settings INTERFACE -Werror)
endif()
if(GLISSADE_SANITIZE)
  target_compile_options(glissade_compile_settings INTERFACE
    -fsanitize=${GLISSADE_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_link_options(glissade_compile_settings INTERFACE -fsanitize=${GLISSADE_SANITIZE})
endif()
if(GLISSADE_BUILD_FUZZERS)
  # Coverage that libFuzzer steers by, without its main().
  target_compile_options(glissade_compile_settings INTERFACE -fsanitize=fuzzer-no-link)
  target_link_options(glissade_compile_settings INTERFACE -fsanitize=fuzzer-no-link)
endif()
