# How every target of etalon is made: strict floating point, one static library per folder, includes written from the root.

include(GNUInstallDirs)

# The determinism contract (docs/contract.md): the compiler may neither contract a*b+c into an FMA nor re-associate.
# Exported, so that the inline code of our headers computes the same in a user's program.
add_library(etalon_strict INTERFACE)
target_compile_options(etalon_strict INTERFACE -ffp-contract=off -fno-fast-math -fno-math-errno)
# gcc 12.2 drops the rounding of (double)(float)x where its SLP vectorizer pairs two of them, at plain -O2 (tests/math/compiler_test.cpp).
target_compile_options(etalon_strict INTERFACE $<$<CXX_COMPILER_ID:GNU>:-fno-tree-slp-vectorize>)
target_compile_features(etalon_strict INTERFACE cxx_std_20)
set_target_properties(etalon_strict PROPERTIES EXPORT_NAME strict)
install(TARGETS etalon_strict EXPORT etalon)

# Warnings are a developer's matter and stay out of the exported targets.
set(ETALON_WARNINGS -Wall -Wextra -Wshadow -Wno-missing-field-initializers)
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  list(APPEND ETALON_WARNINGS -Wno-restrict)  # gcc 12 sees overlap in "text" + std::string (gcc bug 105651)
endif()
if(ETALON_WERROR)
  list(APPEND ETALON_WARNINGS -Werror)
endif()

# etalon_add_library(NAME SOURCES … [LINKS …] [PRIVATE_LINKS …]): the folder's library `etalon_NAME`, alias `etalon::NAME`.
function(etalon_add_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINKS;PRIVATE_LINKS" ${ARGN})
  add_library(etalon_${name} STATIC ${ARG_SOURCES})
  add_library(etalon::${name} ALIAS etalon_${name})
  target_include_directories(etalon_${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/etalon>)
  target_link_libraries(etalon_${name} PUBLIC etalon_strict ${ARG_LINKS})
  foreach(lib IN LISTS ARG_PRIVATE_LINKS)
    target_link_libraries(etalon_${name} PRIVATE ${lib})
  endforeach()
  target_compile_options(etalon_${name} PRIVATE ${ETALON_WARNINGS})
  set_target_properties(etalon_${name} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
  install(TARGETS etalon_${name} EXPORT etalon ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
endfunction()

# etalon_add_test_suite(NAME SOURCES … [LINKS …]): the doctest program `etalon_NAME_tests` and its CTest entry.
function(etalon_add_test_suite name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINKS" ${ARGN})
  add_executable(etalon_${name}_tests ${ARG_SOURCES})
  target_link_libraries(etalon_${name}_tests PRIVATE etalon_test_support ${ARG_LINKS})
  target_compile_options(etalon_${name}_tests PRIVATE ${ETALON_WARNINGS})
  add_test(NAME ${name} COMMAND etalon_${name}_tests)
endfunction()
