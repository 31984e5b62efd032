# No object of the library asks the C library for an elementary function whose last bits depend on the processor
# (docs/decisions/0007): what templates of others bring in is seen here and nowhere else.
execute_process(COMMAND ${NM} -A -u ${LIBRARIES} OUTPUT_VARIABLE symbols ERROR_QUIET RESULT_VARIABLE result)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "${NM} cannot read one of ${LIBRARIES}")
endif()
string(REGEX MATCHALL "[^\n]*Sleef_[^\n]*" wanted "${symbols}")
if(NOT wanted)
  message(FATAL_ERROR "${LIBRARIES} ask for no function of SLEEF: is this the library?")
endif()
string(REGEX MATCHALL
  "[^\n]* (a?sinh?|a?cosh?|a?tanh?|sincos|atan2|exp2?|expm1|log|log2|log10|log1p|pow|hypot|cbrt)[fl]?\n" found "${symbols}")
# How deep CGAL divides a box tree follows from a logarithm that is rounded up; the answer does not depend on it.
list(FILTER found EXCLUDE REGEX "self_intersections.*U log\n$")
# Boost.Math works out quantiles in extended precision, whose functions the C library has but once.
list(FILTER found EXCLUDE REGEX "distribution.cpp.*U (exp|log)l\n$")
if(found)
  string(JOIN "" found ${found})
  message(FATAL_ERROR "Elementary functions of the C library:\n${found}")
endif()
