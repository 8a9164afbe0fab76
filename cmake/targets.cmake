# SPDX-FileCopyrightText: 2026 The vantage authors
# SPDX-License-Identifier: MIT

# The library's targets. All headers lie in one tree; a target adds what the headers of its room need.
# vantageConfig.cmake.in finds the same packages again for those who install.
find_package(Eigen3 3.4 REQUIRED)
find_package(TBB REQUIRED)

set(vantage_targets "")
function(vantage_target name) # name libraries...
  add_library(${name} INTERFACE)
  target_link_libraries(${name} INTERFACE ${ARGN})
  string(REPLACE "vantage_" "" short ${name})
  add_library(vantage::${short} ALIAS ${name})
  set_target_properties(${name} PROPERTIES EXPORT_NAME ${short})
  set(vantage_targets ${vantage_targets} ${name} PARENT_SCOPE)
endfunction()

vantage_target(vantage Eigen3::Eigen TBB::tbb)
target_compile_features(vantage INTERFACE cxx_std_20)
target_include_directories(vantage INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>)

# For those who ask, and for our own programs. In no other target: it changes Eigen's alignment, hence the ABI.
vantage_target(vantage_native)
target_compile_options(vantage_native INTERFACE -march=native -O3)

if(VANTAGE_WITH_IO)
  find_package(PNG REQUIRED)
  find_package(ZLIB REQUIRED)
  find_package(nlohmann_json 3.10 REQUIRED)
  find_package(TinyGLTF REQUIRED)
  find_path(VANTAGE_STB stb/stb_image.h REQUIRED) # header-only, and no package of CMake's
  vantage_target(vantage_io vantage PNG::PNG ZLIB::ZLIB nlohmann_json::nlohmann_json TinyGLTF::TinyGLTF)
endif()

if(VANTAGE_WITH_SIM)
  find_package(Qhull CONFIG REQUIRED)
  find_package(embree 3.12 REQUIRED)
  vantage_target(vantage_sim vantage Qhull::qhull_r embree)
endif()

if(VANTAGE_WITH_COLLISION)
  find_package(Qhull CONFIG REQUIRED)
  find_package(ccd REQUIRED)
  find_package(fcl 0.7 REQUIRED)
  vantage_target(vantage_collision vantage fcl ccd Qhull::qhull_r)
endif()

if(VANTAGE_WITH_EVAL)
  find_package(nanoflann 1.4 REQUIRED)
  vantage_target(vantage_eval vantage nanoflann::nanoflann)
endif()

if(VANTAGE_WITH_MISSION)
  if(NOT VANTAGE_WITH_IO)
    message(FATAL_ERROR "VANTAGE_WITH_MISSION writes pictures: it needs VANTAGE_WITH_IO=ON")
  endif()
  find_package(CLI11 2 REQUIRED)
  vantage_target(vantage_mission vantage_io CLI11::CLI11)
endif()
