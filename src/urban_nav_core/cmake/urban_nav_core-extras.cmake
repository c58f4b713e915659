# SPDX-License-Identifier: BSD-3-Clause
# Build functions of all packages of the suite. Loaded by find_package(urban_nav_core) from the devel space or the
# install space. Targets, flags and include paths of other packages in the workspace are not modified.
#catkin_lint: ignore global_var_collision duplicate_find shadowed_find
include_guard(DIRECTORY)
include(CheckCXXCompilerFlag)

option(URBAN_NAV_WERROR "Warnings are errors" OFF)
option(URBAN_NAV_SANITIZE "Address and undefined-behaviour sanitizer" OFF)
option(URBAN_NAV_COVERAGE "Count which lines and branches run (gcov)" OFF)
option(URBAN_NAV_CORES_ONLY "Build only the libraries that do not depend on ROS" OFF)
option(URBAN_NAV_BENCH "Configure the programs in bench/ (target urban_nav_benches builds them)" OFF)
option(URBAN_NAV_PRECOMPILE "Precompile the most common headers, once per target" OFF)
option(URBAN_NAV_UNITY "Compile sources in batches, which parses common headers once per batch" OFF)
option(URBAN_NAV_UNITY_TESTS "URBAN_NAV_UNITY for tests, and for libraries used only by tests and benches" OFF)
set(URBAN_NAV_UNITY_BATCH 16 CACHE STRING "Sources in a batch")
option(URBAN_NAV_SANITIZED_READERS "Also run the tests of file and message readers under the sanitizers" OFF)
set(URBAN_NAV_TEST_SHARDS 1 CACHE STRING "Number of processes among which the cases of a gtest binary are divided")
set(URBAN_NAV_TEST_ROOMS "" CACHE STRING "Folders of test/ to compile into the tests; empty: all")

find_package(Eigen3 REQUIRED NO_MODULE)
find_package(Threads REQUIRED)

# Release flags unless the workspace sets a build type: a stage without optimisation is fifty times slower.
set(urban_nav_compile_options $<$<CONFIG:>:-O2> $<$<CONFIG:>:-DNDEBUG> -Wall -Wextra -Wshadow -Wconversion)
if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64|amd64)$")
  check_cxx_compiler_flag(-march=x86-64-v2 URBAN_NAV_HAS_X86_64_V2)
  if(URBAN_NAV_HAS_X86_64_V2)
    list(APPEND urban_nav_compile_options -march=x86-64-v2)
  else()  # GCC 9 has no name for this set of instructions
    list(APPEND urban_nav_compile_options -mcx16 -mpopcnt -msahf -mssse3 -msse4.1 -msse4.2)
  endif()
endif()
# The first two warn about names at file scope, which are irrelevant in unity builds. With inlining across files GCC 12
# reports false overflows in std::vector.
set(urban_nav_unity_options -Wno-shadow -Wshadow=local -Wno-subobject-linkage -Wno-array-bounds -Wno-stringop-overflow -Wno-stringop-overread)
if(URBAN_NAV_UNITY)
  list(APPEND urban_nav_compile_options ${urban_nav_unity_options})
endif()
# Debian's hardening flags, if the required optimisation is on. Position-independent code and linker flags are set by
# urban_nav_target.
list(APPEND urban_nav_compile_options -fstack-protector-strong -Wformat -Werror=format-security -U_FORTIFY_SOURCE
  $<$<NOT:$<CONFIG:Debug>>:-D_FORTIFY_SOURCE=2>)
# Contraction into fused multiply-add would make the bits depend on the machine.
list(APPEND urban_nav_compile_options -ffp-contract=off)
if(URBAN_NAV_WERROR)
  list(APPEND urban_nav_compile_options -Werror)
endif()
set(urban_nav_link_options "")
# Reduced set of checks: the omitted ones take two thirds of the compile time of an Eigen file.
set(urban_nav_sanitizers -fsanitize=address,undefined -fno-sanitize=null,alignment,object-size,pointer-overflow,vptr
    -fno-sanitize-recover=all -O1 -g1 -UNDEBUG -U_FORTIFY_SOURCE -fno-omit-frame-pointer
    -Wno-maybe-uninitialized)  # false positives of GCC in Eigen with sanitizers
if(URBAN_NAV_SANITIZE)
  list(APPEND urban_nav_compile_options ${urban_nav_sanitizers})
  list(APPEND urban_nav_link_options -fsanitize=address,undefined)
endif()

if(URBAN_NAV_COVERAGE)  # without inlining, so that each line is counted in its own file
  list(APPEND urban_nav_compile_options --coverage -fprofile-update=atomic -O1 -fno-inline -Wno-maybe-uninitialized)
  list(APPEND urban_nav_link_options --coverage)
endif()

# urban_nav_precompile(TARGET HEADER...): precompiles these headers for the target, if it has enough files to benefit.
function(urban_nav_precompile target)
  get_target_property(sources ${target} SOURCES)
  list(LENGTH sources files)
  if(URBAN_NAV_PRECOMPILE AND files GREATER 4)
    target_precompile_headers(${target} PRIVATE ${ARGN})
  endif()
endfunction()

# urban_nav_quick(TARGET): compiles a test target with -O1, which is a fifth faster than -O2; code under test is in the
# library. With -O1 GCC reports false uninitialised values in std::optional.
function(urban_nav_quick target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:>:-O1> -Wno-maybe-uninitialized)
endfunction()

# urban_nav_unite(TARGET): compiles a test target in batches if URBAN_NAV_UNITY_TESTS is set. Sources of installed
# targets are compiled separately, with all warnings.
function(urban_nav_unite target)
  if(URBAN_NAV_UNITY_TESTS)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON)
    target_compile_options(${target} PRIVATE ${urban_nav_unity_options})
  endif()
endfunction()

# urban_nav_target(TARGET [ROS]): sets the properties of a target of the suite. Without ROS the target has the include
# paths of urban_nav_core and of the other ROS-independent packages of src/ that the package has found, but not those of
# ROS, which keeps the cores independent of it.
function(urban_nav_target target)
  cmake_parse_arguments(arg "ROS" "" "" ${ARGN})
  set_target_properties(${target} PROPERTIES
    CXX_STANDARD 17 CXX_STANDARD_REQUIRED ON CXX_EXTENSIONS OFF POSITION_INDEPENDENT_CODE ON
    # Same RPATH in the build space: the list that CMake would replace at installation ends with a colon, which would add
    # the current folder.
    INSTALL_RPATH "$ORIGIN;$ORIGIN/..;$ORIGIN/../lib" BUILD_WITH_INSTALL_RPATH ON
    UNITY_BUILD ${URBAN_NAV_UNITY} UNITY_BUILD_BATCH_SIZE ${URBAN_NAV_UNITY_BATCH})
  target_compile_options(${target} PRIVATE ${urban_nav_compile_options})
  # Symbols are resolved at program start, after which the relocation table is read-only.
  target_link_options(${target} PRIVATE -Wl,-z,relro -Wl,-z,now)
  if(EXISTS ${PROJECT_SOURCE_DIR}/include)
    target_include_directories(${target} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>)
  endif()
  if(EXISTS ${PROJECT_SOURCE_DIR}/src)
    target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR}/src)
  endif()
  if(arg_ROS)
    target_include_directories(${target} SYSTEM PRIVATE ${catkin_INCLUDE_DIRS})
    target_link_libraries(${target} ${catkin_LIBRARIES})
    urban_nav_precompile(${target} <ros/ros.h>)
    if(catkin_EXPORTED_TARGETS)
      add_dependencies(${target} ${catkin_EXPORTED_TARGETS})
    endif()
  else()
    # ROS-independent packages of src/ that this package has found.
    foreach(package urban_nav_core urban_nav_store urban_nav_registration urban_nav_live)
      target_include_directories(${target} SYSTEM PRIVATE ${${package}_INCLUDE_DIRS})
      target_link_libraries(${target} ${${package}_LIBRARIES})
    endforeach()
  endif()
  target_link_libraries(${target} Eigen3::Eigen Threads::Threads ${urban_nav_link_options})
  urban_nav_precompile(${target} <algorithm> <array> <cmath> <cstdint> <filesystem> <fstream> <functional> <iostream> <limits> <map>
    <memory> <optional> <random> <set> <sstream> <string> <utility> <vector> <Eigen/Dense>)
endfunction()

macro(urban_nav_pass_ros target)
  if(arg_ROS)
    urban_nav_target(${target} ROS)
  else()
    urban_nav_target(${target})
  endif()
endmacro()

# urban_nav_library(TARGET SOURCE... [STATIC] [ROS]): adds an installed library of this package. Link further libraries
# by target_link_libraries.
function(urban_nav_library target)
  cmake_parse_arguments(arg "STATIC;ROS" "" "" ${ARGN})
  if(arg_STATIC)
    add_library(${target} STATIC ${arg_UNPARSED_ARGUMENTS})
  else()
    add_library(${target} SHARED ${arg_UNPARSED_ARGUMENTS})
  endif()
  urban_nav_pass_ros(${target})
  install(TARGETS ${target}
    ARCHIVE DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION}
    LIBRARY DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION}
    RUNTIME DESTINATION ${CATKIN_GLOBAL_BIN_DESTINATION})
endfunction()

# urban_nav_program(TARGET SOURCE... [ON_PATH] [ROS]): adds an installed program of this package. ON_PATH: available
# without rosrun.
function(urban_nav_program target)
  cmake_parse_arguments(arg "ON_PATH;ROS" "" "" ${ARGN})
  add_executable(${target} ${arg_UNPARSED_ARGUMENTS})
  urban_nav_pass_ros(${target})
  install(TARGETS ${target} RUNTIME DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
  if(arg_ON_PATH)
    install(TARGETS ${target} RUNTIME DESTINATION ${CATKIN_GLOBAL_BIN_DESTINATION})
    add_custom_command(TARGET ${target} POST_BUILD VERBATIM
      COMMAND ${CMAKE_COMMAND} -E make_directory ${CATKIN_DEVEL_PREFIX}/bin
      COMMAND ${CMAKE_COMMAND} -E create_symlink $<TARGET_FILE:${target}> ${CATKIN_DEVEL_PREFIX}/bin/$<TARGET_FILE_NAME:${target}>)
  endif()
endfunction()

# urban_nav_parameters(): adds PACKAGE_parameters, and the target PACKAGE_documents that runs it to write the documents
# generated from parameter tables: config/PACKAGE.yaml and two tables of PARAMETERS.md if it exists,
# otherwise of README.md.
function(urban_nav_parameters)
  set(sources tools/${PROJECT_NAME}_parameters.cpp)
  if(EXISTS ${PROJECT_SOURCE_DIR}/nodelet/nodelet_parameters.cpp)
    list(APPEND sources nodelet/nodelet_parameters.cpp)
  endif()
  urban_nav_program(${PROJECT_NAME}_parameters ${sources})
  target_include_directories(${PROJECT_NAME}_parameters PRIVATE nodelet)
  target_link_libraries(${PROJECT_NAME}_parameters ${PROJECT_NAME})
  add_custom_target(${PROJECT_NAME}_documents COMMAND ${PROJECT_NAME}_parameters --write ${PROJECT_SOURCE_DIR} VERBATIM)
endfunction()

# Library of testing/ for tests, benches and the demo: a target within one workspace, a file if packages are built
# separately.
#catkin_lint: ignore literal_project_name
if(TARGET urban_nav_core_testing OR PROJECT_NAME STREQUAL "urban_nav_core")
  set(urban_nav_testing_library urban_nav_core_testing)
else()
  find_package(OpenCV REQUIRED COMPONENTS calib3d core imgcodecs imgproc)
  set(urban_nav_testing_library
    ${urban_nav_core_DIR}/../../../lib/${CMAKE_STATIC_LIBRARY_PREFIX}urban_nav_core_testing${CMAKE_STATIC_LIBRARY_SUFFIX}
    urban_nav_core opencv_core opencv_imgcodecs opencv_imgproc)
endif()

# urban_nav_run_gtest(TARGET TYPE): adds run_tests_PACKAGE_TYPE_TARGET-N, which run shards of a gtest binary in the
# package's folder. Each shard has its own folder for temporary files.
function(urban_nav_run_gtest target type)
  get_target_property(folder ${target} RUNTIME_OUTPUT_DIRECTORY)
  math(EXPR last "${URBAN_NAV_TEST_SHARDS} - 1")
  foreach(shard RANGE ${last})
    set(results ${type}-${target}-${shard}.xml)
    set(temporary ${CMAKE_CURRENT_BINARY_DIR}/${target}-${shard}.tmp)
    catkin_run_tests_target(${type} ${target}-${shard} ${results} DEPENDENCIES ${target} WORKING_DIRECTORY ${PROJECT_SOURCE_DIR}
      COMMAND "mkdir -p ${temporary} && TEST_TMPDIR=${temporary} GTEST_TOTAL_SHARDS=${URBAN_NAV_TEST_SHARDS} GTEST_SHARD_INDEX=${shard} \
${folder}/${target} --gtest_output=xml:${CATKIN_TEST_RESULTS_DIR}/${PROJECT_NAME}/${results}")
  endforeach()
endfunction()

# urban_nav_gtest(TARGET TYPE SOURCE... LIBRARIES LIBRARY... [ROS]): adds a gtest binary of these sources to catkin's
# target run_tests.
function(urban_nav_gtest target type)
  cmake_parse_arguments(arg "ROS" "" "LIBRARIES" ${ARGN})
  catkin_add_executable_with_gtest(${target} ${arg_UNPARSED_ARGUMENTS} EXCLUDE_FROM_ALL)
  if(NOT TARGET ${target})
    return()
  endif()
  add_dependencies(tests ${target})
  urban_nav_pass_ros(${target})
  urban_nav_quick(${target})
  urban_nav_unite(${target})
  urban_nav_precompile(${target} <gtest/gtest.h>)
  target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR}/test)
  target_link_libraries(${target} ${arg_LIBRARIES} ${urban_nav_testing_library})
  if(TARGET GTest::gtest_main)
    target_link_libraries(${target} GTest::gtest_main)
  else()
    target_link_libraries(${target} ${GTEST_MAIN_LIBRARIES})
  endif()
  urban_nav_run_gtest(${target} ${type})
endfunction()

# urban_nav_test(LIBRARY... [ROS] [ONLY SOURCE...]): adds PACKAGE-test, one gtest binary of test/**/*.cpp except
# test/ros, linked with the libraries.
function(urban_nav_test)
  if(NOT CATKIN_ENABLE_TESTING)
    return()
  endif()
  cmake_parse_arguments(arg "ROS" "" "ONLY" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/test/*.cpp)
  list(FILTER sources EXCLUDE REGEX "^${PROJECT_SOURCE_DIR}/test/ros/")
  if(arg_ONLY)
    set(sources ${arg_ONLY})
  elseif(URBAN_NAV_TEST_ROOMS)
    string(REPLACE ";" "|" rooms "${URBAN_NAV_TEST_ROOMS}")
    list(FILTER sources INCLUDE REGEX "^${PROJECT_SOURCE_DIR}/test/(${rooms})/")
  endif()
  if(NOT sources)
    return()
  endif()
  if(EXISTS ${PROJECT_SOURCE_DIR}/nodelet/nodelet_parameters.cpp)
    list(APPEND sources nodelet/nodelet_parameters.cpp)
  endif()
  if(arg_ROS)
    list(APPEND sources ROS)
  endif()
  urban_nav_gtest(${PROJECT_NAME}-test gtest ${sources} LIBRARIES ${arg_UNPARSED_ARGUMENTS})
endfunction()

# urban_nav_sanitized_test(LIBRARY... ROOMS ROOM... [TESTS SOURCE...] [WITHOUT SOURCE...]): adds PACKAGE-sanitized-test,
# a gtest binary of src/ROOM, reference/ROOM and test/ROOM compiled with sanitizers; the rest of the package is linked
# from the regular libraries. Symbols of the binary take precedence over those of the libraries.
function(urban_nav_sanitized_test)
  if(NOT CATKIN_ENABLE_TESTING OR NOT URBAN_NAV_SANITIZED_READERS)
    return()
  endif()
  cmake_parse_arguments(arg "" "" "ROOMS;TESTS;WITHOUT" ${ARGN})
  set(sources ${arg_TESTS})
  foreach(room ${arg_ROOMS})
    file(GLOB_RECURSE room_sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/${room}/*.cpp ${PROJECT_SOURCE_DIR}/reference/${room}/*.cpp
      ${PROJECT_SOURCE_DIR}/test/${room}/*.cpp)
    list(APPEND sources ${room_sources})
  endforeach()
  foreach(source ${arg_WITHOUT})
    list(REMOVE_ITEM sources ${PROJECT_SOURCE_DIR}/${source})
  endforeach()
  if(TARGET urban_nav_core_testing)  # its malloc, compiled without sanitizers, would replace theirs
    get_target_property(core urban_nav_core_testing SOURCE_DIR)
    list(APPEND sources ${core}/testing/allocations.cpp)
  endif()
  set(target ${PROJECT_NAME}-sanitized-test)
  urban_nav_gtest(${target} sanitized ${sources} LIBRARIES ${arg_UNPARSED_ARGUMENTS})
  if(TARGET ${target})
    target_compile_options(${target} PRIVATE ${urban_nav_sanitizers})
    target_link_libraries(${target} -fsanitize=address,undefined)
    if(CMAKE_SIZEOF_VOID_P EQUAL 8)
      # Eigen allocates differently under the address sanitizer; matrices here come from libraries without it too.
      target_compile_definitions(${target} PRIVATE EIGEN_MALLOC_ALREADY_ALIGNED=1)
    endif()
  endif()
endfunction()

# urban_nav_nodelet(): adds PACKAGE_nodelet from nodelet/*.cpp, the ROS interface of the package's library, and
# PACKAGE-rostest from test/ros/*.cpp, which test/ros/nodelet.test runs with it. No effect if only the cores are built.
function(urban_nav_nodelet)
  if(URBAN_NAV_CORES_ONLY)
    return()
  endif()
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/nodelet/*.cpp)
  urban_nav_library(${PROJECT_NAME}_nodelet ${sources} ROS)
  target_link_libraries(${PROJECT_NAME}_nodelet ${PROJECT_NAME})
  if(NOT CATKIN_ENABLE_TESTING)
    return()
  endif()
  find_package(rostest REQUIRED)
  file(GLOB test_sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/test/ros/*.cpp)
  add_rostest_gtest(${PROJECT_NAME}-rostest test/ros/nodelet.test ${test_sources})
  urban_nav_target(${PROJECT_NAME}-rostest ROS)
  urban_nav_quick(${PROJECT_NAME}-rostest)
  urban_nav_unite(${PROJECT_NAME}-rostest)
  urban_nav_precompile(${PROJECT_NAME}-rostest <gtest/gtest.h>)
  target_include_directories(${PROJECT_NAME}-rostest PRIVATE ${PROJECT_SOURCE_DIR}/nodelet)
  target_link_libraries(${PROJECT_NAME}-rostest ${PROJECT_NAME}_nodelet ${PROJECT_NAME} ${urban_nav_testing_library} ${GTEST_LIBRARIES})
endfunction()

# urban_nav_python_tests(): adds each test/FOLDER/NAME_test.py of this package, run by the python3 of the workspace.
# Tests end with rosunit.unitrun, which writes the same XML as gtest.
function(urban_nav_python_tests)
  if(NOT CATKIN_ENABLE_TESTING)
    return()
  endif()
  file(GLOB tests CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR}/test ${PROJECT_SOURCE_DIR}/test/*/*_test.py)
  foreach(test ${tests})
    string(REGEX REPLACE "_test\\.py$" "" name ${test})
    string(REPLACE "/" "_" name ${name})
    set(results ${CATKIN_TEST_RESULTS_DIR}/${PROJECT_NAME}/python-${name}.xml)
    # As in rostest: catkin's function for Python requires nose, which is unmaintained.
    catkin_run_tests_target(python ${name} python-${name}.xml
      COMMAND "${PYTHON_EXECUTABLE} ${PROJECT_SOURCE_DIR}/test/${test} --gtest_output=xml:${results}")
  endforeach()
endfunction()

# urban_nav_bench(LIBRARY...): adds PACKAGE-bench-NAME for each bench/NAME.cpp, all with bench/support/*.cpp.
function(urban_nav_bench)
  if(NOT URBAN_NAV_BENCH)
    return()
  endif()
  find_package(benchmark REQUIRED)
  if(NOT TARGET urban_nav_benches)
    add_custom_target(urban_nav_benches)
  endif()
  file(GLOB programs CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/bench/*.cpp)
  file(GLOB support CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/bench/support/*.cpp)
  set(libraries ${ARGN} ${urban_nav_testing_library} benchmark::benchmark)
  if(support)
    add_library(${PROJECT_NAME}-bench-support STATIC EXCLUDE_FROM_ALL ${support})
    urban_nav_target(${PROJECT_NAME}-bench-support)
    urban_nav_unite(${PROJECT_NAME}-bench-support)
    target_link_libraries(${PROJECT_NAME}-bench-support ${libraries})
    list(INSERT libraries 0 ${PROJECT_NAME}-bench-support)
  endif()
  foreach(program ${programs})
    get_filename_component(name ${program} NAME_WE)
    set(target ${PROJECT_NAME}-bench-${name})
    add_executable(${target} EXCLUDE_FROM_ALL ${program})
    urban_nav_target(${target})
    target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR}/bench)
    target_link_libraries(${target} ${libraries})
    add_dependencies(urban_nav_benches ${target})
  endforeach()
endfunction()

# urban_nav_stage([LIBRARIES LIBRARY...] [TEST_LIBRARIES LIBRARY...] [SANITIZED ROOM...] [SANITIZED_WITHOUT SOURCE...]):
# adds all targets of a stage, after catkin_package(): the library PACKAGE from src/, linked with LIBRARIES; nodelet/,
# tools/, test/, test/ros/ and bench/ by the functions above, tests and benches linked with TEST_LIBRARIES. Other files
# are installed by the stage itself, as catkin_lint requires.
function(urban_nav_stage)
  cmake_parse_arguments(arg "" "" "LIBRARIES;TEST_LIBRARIES;SANITIZED;SANITIZED_WITHOUT" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/*.cpp)
  urban_nav_library(${PROJECT_NAME} ${sources})
  target_link_libraries(${PROJECT_NAME} ${arg_LIBRARIES})
  urban_nav_nodelet()
  urban_nav_parameters()
  urban_nav_test(${PROJECT_NAME} ${arg_TEST_LIBRARIES})
  if(arg_SANITIZED)
    urban_nav_sanitized_test(${PROJECT_NAME} ${arg_LIBRARIES} ROOMS ${arg_SANITIZED} WITHOUT ${arg_SANITIZED_WITHOUT})
  endif()
  urban_nav_bench(${PROJECT_NAME} ${arg_TEST_LIBRARIES})
endfunction()
