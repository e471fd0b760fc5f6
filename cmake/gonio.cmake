# SPDX-License-Identifier: BSD-3-Clause
# One warnings target and the two ways to add something: a library per folder and a test program per folder.
include_guard()
find_package(PkgConfig REQUIRED)
find_package(fmt REQUIRED)
find_package(Threads REQUIRED)

add_library(gonio_options INTERFACE)
target_include_directories(gonio_options INTERFACE ${CMAKE_CURRENT_SOURCE_DIR})
target_compile_options(gonio_options INTERFACE -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wnon-virtual-dtor
                       $<$<BOOL:${GONIO_WERROR}>:-Werror>)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # g++ 12 warns falsely of "x" + std::string (GCC bug 105651).
  target_compile_options(gonio_options INTERFACE -Wno-restrict)
endif()
if(GONIO_SANITIZE)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # Instrumented code confuses the warnings that follow the flow, inside the standard library and Catch2 too.
    target_compile_options(gonio_options INTERFACE -Wno-maybe-uninitialized -Wno-array-bounds -Wno-stringop-overflow)
  endif()
  target_compile_options(gonio_options INTERFACE -fsanitize=${GONIO_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_link_options(gonio_options INTERFACE -fsanitize=${GONIO_SANITIZE})
endif()

if(GONIO_FUZZ)
  target_compile_options(gonio_options INTERFACE -fsanitize=fuzzer-no-link)
endif()

# gonio_library(<folder-name> SOURCES ... DEPENDS <gonio libraries> PRIVATE <third parties>)
function(gonio_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPENDS;PRIVATE" ${ARGN})
  add_library(gonio_${name} STATIC ${ARG_SOURCES})
  target_link_libraries(gonio_${name} PUBLIC gonio_options ${ARG_DEPENDS} PRIVATE fmt::fmt Threads::Threads ${ARG_PRIVATE})
endfunction()

# gonio_test(<name> SOURCES ... DEPENDS ... [LABEL unit|property|contract|golden|end_to_end|cli|slow])
function(gonio_test name)
  cmake_parse_arguments(ARG "" "LABEL;TIMEOUT" "SOURCES;DEPENDS" ${ARGN})
  if(NOT ARG_LABEL)
    set(ARG_LABEL unit)
  endif()
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 300)
  endif()
  add_executable(test_${name} ${ARG_SOURCES})
  target_link_libraries(test_${name} PRIVATE gonio_test_main fmt::fmt Threads::Threads ${ARG_DEPENDS})
  add_test(NAME ${name} COMMAND test_${name} -w NoAssertions --rng-seed 20260701)
  # What may take longest starts first, so that no processor waits for it at the end.
  set_tests_properties(${name} PROPERTIES LABELS ${ARG_LABEL} TIMEOUT ${ARG_TIMEOUT} COST ${ARG_TIMEOUT})
endfunction()
