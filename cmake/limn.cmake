# One room = one folder = one static library. Headers are included by their path from the root.

add_library(limn_options INTERFACE)
target_include_directories(limn_options INTERFACE ${CMAKE_SOURCE_DIR})
target_compile_definitions(limn_options INTERFACE GLM_FORCE_DEPTH_ZERO_TO_ONE GLM_ENABLE_EXPERIMENTAL)
target_compile_options(limn_options INTERFACE -Wall -Wextra -Wshadow -Wconversion -Wno-sign-conversion
                       -Wno-missing-field-initializers) # designated initialisers name what differs from the default
# Results must not depend on whether the compiler found a fused multiply-add.
target_compile_options(limn_options INTERFACE -ffp-contract=off)
# Some sixty programs are linked in every build of everything; mold takes a third of the time of GNU ld.
find_program(MOLD mold)
if(MOLD)
  target_link_options(limn_options INTERFACE -fuse-ld=mold)
endif()
if(LIMN_WERROR)
  target_compile_options(limn_options INTERFACE -Werror)
endif()
if(LIMN_SANITIZE)
  target_compile_options(limn_options INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=undefined
                         -fno-omit-frame-pointer)
  # AddressSanitizer reports a null pointer, or one out of its object, where it is read. Checking each pointer before that takes
  # two fifths of the compiler's time. The fuzz targets do, so that they alone report misaligned reads, and overflows of
  # pointers that are not read.
  if(NOT LIMN_FUZZ)
    target_compile_options(limn_options INTERFACE -fno-sanitize=null,alignment,pointer-overflow,object-size)
  endif()
  # GCC warns falsely of strings and optionals in instrumented code. Release builds keep these warnings.
  foreach(warning maybe-uninitialized array-bounds stringop-overflow restrict)
    target_compile_options(limn_options INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-${warning}>)
  endforeach()
  target_link_options(limn_options INTERFACE -fsanitize=address,undefined)
endif()

# Options of sources whose small loops GCC unrolls or vectorises at -O3 only. With AddressSanitizer, unrolled loops and checks for
# use after scope of each vector in them would take GCC minutes for each source.
set(LIMN_KERNEL_OPTIONS -O3)
if(LIMN_SANITIZE)
  set(LIMN_KERNEL_OPTIONS -O1 -fno-sanitize-address-use-after-scope)
endif()

if(LIMN_THREAD_SANITIZER)
  target_compile_options(limn_options INTERFACE -fsanitize=thread -fno-omit-frame-pointer)
  target_link_options(limn_options INTERFACE -fsanitize=thread)
endif()

if(LIMN_FUZZ)
  target_compile_options(limn_options INTERFACE -fsanitize=fuzzer-no-link)
  # AddressSanitizer misses an index that leads into another array, or into memory that was never used; this does not.
  target_compile_definitions(limn_options INTERFACE _GLIBCXX_ASSERTIONS)
endif()

# Headers that most sources include, precompiled once for all rooms. Where each source is compiled by itself there are none, so that
# the preset each-file finds sources that lack an include.
set(LIMN_HEADERS <algorithm> <array> <cmath> <cstdint> <filesystem> <functional> <map> <memory> <numeric> <optional> <span> <string>
    <string_view> <utility> <variant> <vector> <fmt/format.h> <fmt/ranges.h> <glm/glm.hpp> <glm/gtc/constants.hpp>
    <glm/gtc/matrix_transform.hpp> <glm/gtc/quaternion.hpp> <tl/expected.hpp>)
function(limn_shared_headers)
  find_package(fmt REQUIRED)
  find_package(glm REQUIRED)
  file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/generated/headers.cpp CONTENT "")
  add_library(limn_headers OBJECT EXCLUDE_FROM_ALL ${CMAKE_BINARY_DIR}/generated/headers.cpp)
  target_link_libraries(limn_headers PRIVATE limn_options fmt::fmt glm::glm)
  target_precompile_headers(limn_headers PRIVATE ${LIMN_HEADERS})
endfunction()
function(limn_precompile target)
  if(LIMN_UNITY GREATER 1)
    target_precompile_headers(${target} REUSE_FROM limn_headers)
  endif()
endfunction()

# limn_room(limn_render SOURCES a.cpp passes/b.cpp PRIVATE_FOLDERS passes DEPENDS limn_core TBB::tbb)
# Headers in PRIVATE_FOLDERS are for this room alone, or for the other rooms of its technique.
function(limn_room name)
  cmake_parse_arguments(ROOM "" "" "SOURCES;PRIVATE_FOLDERS;DEPENDS" ${ARGN})
  add_library(${name} STATIC ${ROOM_SOURCES})
  target_link_libraries(${name} PUBLIC limn_options ${ROOM_DEPENDS})
  limn_precompile(${name})
  set_property(GLOBAL APPEND PROPERTY LIMN_ROOMS ${name})
  set_property(GLOBAL APPEND PROPERTY LIMN_JOINED ${name})
endfunction()

# Tests start programs with a cache folder of their own, in which Lavapipe would compile the same shaders again, for five seconds and
# more. They share one cache, with the other presets and checkouts too, as these share the compiler's.
set(LIMN_SHADER_CACHE $ENV{XDG_CACHE_HOME})
if(NOT LIMN_SHADER_CACHE)
  set(LIMN_SHADER_CACHE $ENV{HOME}/.cache)
endif()
string(APPEND LIMN_SHADER_CACHE /limn-test-shaders)
# Mesa makes the folder anew, but none above it.
execute_process(COMMAND ${CMAKE_COMMAND} -E make_directory ${LIMN_SHADER_CACHE} RESULT_VARIABLE failed ERROR_QUIET)
if(failed)
  set(LIMN_SHADER_CACHE ${CMAKE_BINARY_DIR})
endif()
set(LIMN_TEST_ENVIRONMENT LSAN_OPTIONS=suppressions=${CMAKE_SOURCE_DIR}/tests/lsan.supp:print_suppressions=0
    TSAN_OPTIONS=suppressions=${CMAKE_SOURCE_DIR}/tests/tsan.supp MESA_SHADER_CACHE_DIR=${LIMN_SHADER_CACHE})

# limn_test(scene_light_test SOURCES light_test.cpp DEPENDS limn_scene)
# The tests of a folder become one program, and each test a ctest entry that runs the tests of its first source.
# Arguments that follow LABELS are ctest labels. RUNS: a program that the test starts. ALONE: a program of its own, for what changes
# the whole program.
function(limn_test name)
  cmake_parse_arguments(TEST "ALONE" "RUNS" "SOURCES;DEPENDS;LABELS" ${ARGN})
  if(TEST_ALONE)
    set(program ${name})
  else()
    limn_test_program(program)
  endif()
  if(NOT TARGET ${program})
    add_executable(${program})
    target_link_libraries(${program} PRIVATE limn_test_main)
    target_precompile_headers(${program} REUSE_FROM limn_test_headers)
    set_property(GLOBAL APPEND PROPERTY LIMN_JOINED ${program})
  endif()
  target_sources(${program} PRIVATE ${TEST_SOURCES})
  target_link_libraries(${program} PRIVATE ${TEST_DEPENDS})
  list(GET TEST_SOURCES 0 file)
  cmake_path(ABSOLUTE_PATH file NORMALIZE)
  cmake_path(RELATIVE_PATH file BASE_DIRECTORY ${CMAKE_SOURCE_DIR})
  add_test(NAME ${name} COMMAND ${program} ${file})
  set_tests_properties(${name} PROPERTIES LABELS "${TEST_LABELS}" TIMEOUT 600 ENVIRONMENT "${LIMN_TEST_ENVIRONMENT}")
  if(TEST_RUNS)
    add_dependencies(${program} ${TEST_RUNS})
    list(APPEND TEST_DEPENDS limn_app)
  endif()
  limn_list_test(${name} ${program} ${TEST_DEPENDS})
endfunction()

# Lists a test with the program that must be built for it and the libraries that it tests, for tests/repo/select_tests.py.
function(limn_list_test name program)
  set_property(GLOBAL APPEND PROPERTY LIMN_TESTED ${ARGN})
  list(JOIN ARGN " " libraries)
  set_property(GLOBAL APPEND_STRING PROPERTY LIMN_TESTS "${name} ${program} ${libraries}\n")
endfunction()

# The name of the program that limn_test makes of this folder: tests/techniques/lpv is techniques_lpv_tests.
function(limn_test_program variable)
  cmake_path(RELATIVE_PATH CMAKE_CURRENT_SOURCE_DIR BASE_DIRECTORY ${CMAKE_SOURCE_DIR}/tests OUTPUT_VARIABLE folder)
  string(REPLACE / _ folder ${folder})
  set(${variable} ${folder}_tests PARENT_SCOPE)
endfunction()

# Most of a compiler's time goes to headers, the same for each file of a room. limn_join_sources(TARGET) lets the compiler see
# up to LIMN_UNITY sources of a target as one. Those with options of their own, or with SKIP_UNITY_BUILD_INCLUSION, stay alone.
# CMake's UNITY_BUILD does this too, but names sources by their absolute paths, so that two checkouts would share no object.
function(limn_join_sources target)
  get_target_property(sources ${target} SOURCES)
  get_target_property(folder ${target} SOURCE_DIR)
  get_target_property(output ${target} BINARY_DIR)
  set(kept)
  set(lines)
  foreach(source ${sources})
    cmake_path(ABSOLUTE_PATH source BASE_DIRECTORY ${folder} NORMALIZE)
    get_source_file_property(options ${source} TARGET_DIRECTORY ${target} COMPILE_OPTIONS)
    get_source_file_property(definitions ${source} TARGET_DIRECTORY ${target} COMPILE_DEFINITIONS)
    get_source_file_property(skip ${source} TARGET_DIRECTORY ${target} SKIP_UNITY_BUILD_INCLUSION)
    if(options OR definitions OR skip OR NOT source MATCHES "\\.cpp$")
      list(APPEND kept ${source})
    else()
      cmake_path(RELATIVE_PATH source BASE_DIRECTORY ${CMAKE_SOURCE_DIR})
      list(APPEND lines "#include \"${source}\"\n")
    endif()
  endforeach()
  list(LENGTH lines count)
  if(count LESS 2)
    return()
  endif()
  math(EXPR batches "(${count} + ${LIMN_UNITY} - 1) / ${LIMN_UNITY}")
  set(begin 0)
  foreach(batch RANGE 1 ${batches})
    math(EXPR end "${count} * ${batch} / ${batches}") # batches of equal size
    math(EXPR length "${end} - ${begin}")
    list(SUBLIST lines ${begin} ${length} content)
    list(JOIN content "" content)
    file(CONFIGURE OUTPUT ${output}/joined/${target}_${batch}.cpp CONTENT "${content}")
    list(APPEND kept ${output}/joined/${target}_${batch}.cpp)
    set(begin ${end})
  endforeach()
  set_target_properties(${target} PROPERTIES SOURCES "${kept}")
  # GCC takes every source that is included for a header, whose types must not have members of unnamed namespaces.
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
endfunction()

# limn_shaders(limn_render viewport/surface.frag): compiles shaders/viewport/surface.frag to SPIR-V and embeds it, as
# `const std::uint32_t kSurfaceFrag[]` of the generated header "shaders/viewport/surface.frag.h".
# Each is compiled again when any file of shaders/shared changes.
find_program(GLSLANG_VALIDATOR glslangValidator)
function(limn_shaders target)
  if(NOT GLSLANG_VALIDATOR)
    message(FATAL_ERROR "glslangValidator is missing (Debian: glslang-tools)")
  endif()
  file(GLOB shared CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/shaders/shared/*.h ${CMAKE_SOURCE_DIR}/shaders/shared/*.glsl)
  set(folder ${CMAKE_BINARY_DIR}/generated/shaders)
  file(MAKE_DIRECTORY ${folder})
  foreach(path ${ARGN})
    get_filename_component(shader ${path} NAME)
    get_filename_component(parent ${path} DIRECTORY)
    file(MAKE_DIRECTORY ${folder}/${parent})
    string(REGEX REPLACE "[._]" ";" words ${shader})
    set(variable k)
    foreach(word ${words})
      string(SUBSTRING ${word} 0 1 head)
      string(SUBSTRING ${word} 1 -1 tail)
      string(TOUPPER ${head} head)
      string(APPEND variable ${head}${tail})
    endforeach()
    add_custom_command(
      OUTPUT ${folder}/${path}.h
      COMMAND ${GLSLANG_VALIDATOR} -V --quiet --target-env vulkan1.3 -I${CMAKE_SOURCE_DIR} --vn ${variable}
              -o ${folder}/${path}.h ${CMAKE_SOURCE_DIR}/shaders/${path}
      DEPENDS ${CMAKE_SOURCE_DIR}/shaders/${path} ${shared}
      VERBATIM)
    target_sources(${target} PRIVATE ${folder}/${path}.h)
  endforeach()
  target_include_directories(${target} PRIVATE ${CMAKE_BINARY_DIR}/generated)
endfunction()
