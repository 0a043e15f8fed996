# SPDX-License-Identifier: Apache-2.0
# What every target of the project shares.
include(GNUInstallDirs)

if(PROJECT_IS_TOP_LEVEL AND NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()

# Gives a target the project's language level, warnings and floating-point rules.
function(umbrix_settings target)
  target_compile_features(${target} PUBLIC cxx_std_17)
  set_target_properties(${target} PROPERTIES
    CXX_EXTENSIONS OFF
    DEFINE_SYMBOL ""  # export.h needs none; so static and shared objects are the same to a compiler cache
    CXX_VISIBILITY_PRESET hidden
    VISIBILITY_INLINES_HIDDEN ON
    POSITION_INDEPENDENT_CODE ON)
  # One rounding per operation, on every machine: plane times, slow paths and ray origins depend on it. GCC 12's SLP
  # vectoriser loses the rounding of doubles that go to floats and back, three at a time.
  target_compile_options(${target} PRIVATE
    -ffp-contract=off $<$<CXX_COMPILER_ID:GNU>:-fno-tree-slp-vectorize> -Wall -Wextra -Wpedantic -Wconversion -Wshadow
    $<$<BOOL:${UMBRIX_WERROR}>:-Werror>)
  get_target_property(type ${target} TYPE)
  if(type STREQUAL "SHARED_LIBRARY" AND CMAKE_SYSTEM_NAME STREQUAL "Linux")
    target_link_options(${target} PRIVATE -Wl,--version-script=${CMAKE_CURRENT_FUNCTION_LIST_DIR}/exports.map)
    set_property(TARGET ${target} APPEND PROPERTY LINK_DEPENDS ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/exports.map)
  endif()
  if(UMBRIX_SANITIZE)
    target_compile_options(${target} PRIVATE -fsanitize=${UMBRIX_SANITIZE} -fno-omit-frame-pointer
      -fno-sanitize-recover=all)
    target_link_options(${target} PRIVATE -fsanitize=${UMBRIX_SANITIZE})
  endif()
endfunction()
