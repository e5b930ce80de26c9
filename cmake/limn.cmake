# One room = one folder = one static library. Headers are included by their path from the root.

add_library(limn_options INTERFACE)
target_include_directories(limn_options INTERFACE ${CMAKE_SOURCE_DIR})
target_compile_definitions(limn_options INTERFACE GLM_FORCE_DEPTH_ZERO_TO_ONE GLM_ENABLE_EXPERIMENTAL)
target_compile_options(limn_options INTERFACE -Wall -Wextra -Wshadow -Wconversion -Wno-sign-conversion
                       -Wno-missing-field-initializers) # designated initialisers name what differs from the default
# Results must not depend on whether the compiler found a fused multiply-add.
target_compile_options(limn_options INTERFACE -ffp-contract=off)
# Two hundred test programs are linked in every build of everything; mold takes a third of the time of GNU ld.
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
  target_link_options(limn_options INTERFACE -fsanitize=address,undefined)
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

# limn_room(limn_render SOURCES a.cpp passes/b.cpp PRIVATE_FOLDERS passes DEPENDS limn_core TBB::tbb)
# Headers in PRIVATE_FOLDERS are for this room alone, or for the other rooms of its technique.
function(limn_room name)
  cmake_parse_arguments(ROOM "" "" "SOURCES;PRIVATE_FOLDERS;DEPENDS" ${ARGN})
  add_library(${name} STATIC ${ROOM_SOURCES})
  target_link_libraries(${name} PUBLIC limn_options ${ROOM_DEPENDS})
  set_property(GLOBAL APPEND PROPERTY LIMN_ROOMS ${name})
endfunction()

# limn_test(scene_gltf_import_test SOURCES scene/gltf_import_test.cpp DEPENDS limn_scene)
# Arguments that follow LABELS are ctest labels.
function(limn_test name)
  cmake_parse_arguments(TEST "" "TIMEOUT" "SOURCES;DEPENDS;LABELS" ${ARGN})
  add_executable(${name} ${TEST_SOURCES})
  target_link_libraries(${name} PRIVATE ${TEST_DEPENDS} limn_test_paths GTest::gtest_main)
  target_precompile_headers(${name} REUSE_FROM limn_test_headers)
  add_test(NAME ${name} COMMAND ${name})
  set_tests_properties(${name} PROPERTIES LABELS "${TEST_LABELS}" TIMEOUT 600
    ENVIRONMENT "LSAN_OPTIONS=suppressions=${CMAKE_SOURCE_DIR}/tests/lsan.supp:print_suppressions=0;TSAN_OPTIONS=suppressions=${CMAKE_SOURCE_DIR}/tests/tsan.supp")
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
