# A build in which operations in single precision round up or down at random (tests/rounding).
if(NOT CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64" OR
    NOT CMAKE_CXX_COMPILER_ID STREQUAL "GNU" OR NOT EXPHOTON_STATIC)
  message(FATAL_ERROR "EXPHOTON_STOCHASTIC needs x86-64, GCC and EXPHOTON_STATIC")
endif()
target_compile_definitions(exphoton_flags INTERFACE EXPHOTON_STOCHASTIC)
set(rounding_assembler ${CMAKE_CURRENT_LIST_DIR}/)
if(EXPHOTON_DOUBLE)
  set(rounding_assembler ${CMAKE_CURRENT_LIST_DIR}/double/)
endif()
# One lane for each instruction, so that each rounds by itself; lines for the census.
target_compile_options(exphoton_flags INTERFACE -B${rounding_assembler} -mno-red-zone
  -fno-tree-vectorize -g1)
set(rounding_sources ${CMAKE_CURRENT_LIST_DIR}/rounding.cpp
  ${CMAKE_CURRENT_LIST_DIR}/math_functions.cpp)
target_sources(exphoton_core PRIVATE ${rounding_sources})
set_source_files_properties(${rounding_sources} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
foreach(name sin cos sincos tan asin acos atan sinh cosh tanh atanh exp exp2 expm1 log log2 log10
    log1p cbrt erf atan2 pow hypot)
  target_link_options(exphoton_flags INTERFACE -Wl,--wrap=${name}f)
endforeach()
