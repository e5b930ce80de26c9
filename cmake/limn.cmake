# One room = one folder = one static library. Headers are included by their path from the root.

add_library(limn_options INTERFACE)
target_include_directories(limn_options INTERFACE ${CMAKE_SOURCE_DIR})
target_compile_definitions(limn_options INTERFACE GLM_FORCE_DEPTH_ZERO_TO_ONE GLM_ENABLE_EXPERIMENTAL)
target_compile_options(limn_options INTERFACE -Wall -Wextra -Wshadow -Wconversion -Wno-sign-conversion)
# Results must not depend on whether the compiler found a fused multiply-add.
target_compile_options(limn_options INTERFACE -ffp-contract=off)
if(LIMN_WERROR)
  target_compile_options(limn_options INTERFACE -Werror)
endif()
if(LIMN_SANITIZE)
  target_compile_options(limn_options INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=undefined
                         -fno-omit-frame-pointer)
  target_link_options(limn_options INTERFACE -fsanitize=address,undefined)
endif()

# limn_room(limn_scene SOURCES a.cpp b.cpp DEPENDS limn_core TBB::tbb)
function(limn_room name)
  cmake_parse_arguments(ROOM "" "" "SOURCES;DEPENDS" ${ARGN})
  add_library(${name} STATIC ${ROOM_SOURCES})
  target_link_libraries(${name} PUBLIC limn_options ${ROOM_DEPENDS})
endfunction()

# limn_test(scene_gltf_import_test SOURCES scene/gltf_import_test.cpp DEPENDS limn_scene)
# Arguments that follow LABELS are ctest labels.
function(limn_test name)
  cmake_parse_arguments(TEST "" "TIMEOUT" "SOURCES;DEPENDS;LABELS" ${ARGN})
  add_executable(${name} ${TEST_SOURCES})
  target_link_libraries(${name} PRIVATE ${TEST_DEPENDS} GTest::gtest_main)
  target_compile_definitions(${name} PRIVATE LIMN_SOURCE_DIR="${CMAKE_SOURCE_DIR}")
  add_test(NAME ${name} COMMAND ${name})
  set_tests_properties(${name} PROPERTIES LABELS "${TEST_LABELS}" TIMEOUT 600)
endfunction()
