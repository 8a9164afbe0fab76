# SPDX-FileCopyrightText: 2026 The vantage authors
# SPDX-License-Identifier: MIT

# What our own programs (tests, benchmarks, examples) share: strict warnings, every component, and where data lies.
if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release)
endif()
foreach(component IO SIM EVAL MISSION)
  if(NOT VANTAGE_WITH_${component})
    message(FATAL_ERROR "Tests, benchmarks and examples need VANTAGE_WITH_${component}=ON")
  endif()
endforeach()

option(VANTAGE_NATIVE "Build our programs for this machine (vantage::native)" OFF)
option(VANTAGE_REQUIRE_GOLDEN "Refuse to configure without the golden numbers" OFF)
foreach(kind golden data) # beside the checkout, where they exist
  string(TOUPPER ${kind} upper)
  set(beside "")
  if(EXISTS "${PROJECT_SOURCE_DIR}/../shared/${kind}")
    get_filename_component(beside "${PROJECT_SOURCE_DIR}/../shared/${kind}" ABSOLUTE)
  endif()
  set(VANTAGE_${upper}_DIR "${beside}" CACHE PATH "Folder of the shared ${kind}; empty: do without")
endforeach()
if(VANTAGE_REQUIRE_GOLDEN) # a test without its numbers is skipped: they must be there
  foreach(part field surfel/case_A surfel/case_B surfel/confidence surfel/voxel)
    if(NOT IS_DIRECTORY "${VANTAGE_GOLDEN_DIR}/${part}")
      message(FATAL_ERROR "VANTAGE_REQUIRE_GOLDEN: VANTAGE_GOLDEN_DIR is '${VANTAGE_GOLDEN_DIR}', which has no ${part}/")
    endif()
  endforeach()
endif()

set(CMAKE_CXX_EXTENSIONS OFF)

# vantage::collision alone can be done without: what of our sources and headers needs it is then left out.
function(vantage_leave_out files) # name of a list
  if(NOT VANTAGE_WITH_COLLISION)
    set(left_out ${${files}})
    list(FILTER left_out INCLUDE REGEX "(/|planning_)(collision|collision_hazard|frustum_overlap|convex_hull)(_test)?\\.[ch]pp$")
    foreach(file IN LISTS left_out)
      message(STATUS "Left out, as VANTAGE_WITH_COLLISION=OFF: ${file}")
      list(REMOVE_ITEM ${files} ${file})
    endforeach()
    set(${files} ${${files}} PARENT_SCOPE)
  endif()
endfunction()

add_library(vantage_strict INTERFACE)
target_link_libraries(vantage_strict INTERFACE vantage::vantage vantage::io vantage::sim vantage::eval vantage::mission
  $<TARGET_NAME_IF_EXISTS:vantage::collision>)
target_compile_options(vantage_strict INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror
  $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized;-Wno-uninitialized>) # g++ 12 finds some in its own AVX-512 header
target_compile_definitions(vantage_strict INTERFACE
  VANTAGE_GOLDEN_DIR="${VANTAGE_GOLDEN_DIR}" VANTAGE_DATA_DIR="${VANTAGE_DATA_DIR}")

add_library(vantage_programs INTERFACE)
target_link_libraries(vantage_programs INTERFACE vantage_strict $<$<BOOL:${VANTAGE_NATIVE}>:vantage::native>)

# Tests take longer to compile than to run: the machine's instructions, but not all of the optimiser.
add_library(vantage_quick INTERFACE)
target_link_libraries(vantage_quick INTERFACE vantage_strict)
target_compile_options(vantage_quick INTERFACE $<$<CONFIG:Release>:-O1> $<$<BOOL:${VANTAGE_NATIVE}>:-march=native>)

# One program a source file of this folder: NAME from NAME.cpp, under PREFIX in the list of targets.
function(vantage_programs_from prefix pattern) # libraries...
  file(GLOB sources CONFIGURE_DEPENDS "${pattern}")
  vantage_leave_out(sources)
  set(targets "")
  foreach(source IN LISTS sources)
    cmake_path(GET source STEM name)
    set(parts "")
    if(name STREQUAL "main") # NAME/main.cpp, and what stands beside it, which other programs may link
      cmake_path(GET source PARENT_PATH folder)
      cmake_path(GET folder FILENAME name)
      file(GLOB beside CONFIGURE_DEPENDS "${folder}/*.cpp")
      list(REMOVE_ITEM beside "${source}")
      set(parts ${prefix}_${name}_parts)
      add_library(${parts} OBJECT ${beside})
      target_link_libraries(${parts} PUBLIC vantage_programs ${ARGN})
    endif()
    add_executable(${prefix}_${name} ${source})
    set_target_properties(${prefix}_${name} PROPERTIES OUTPUT_NAME ${name})
    target_link_libraries(${prefix}_${name} PRIVATE ${parts} vantage_programs ${ARGN})
    list(APPEND targets ${prefix}_${name})
  endforeach()
  set(${prefix}_targets ${targets} PARENT_SCOPE)
endfunction()
