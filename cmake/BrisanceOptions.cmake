# Flags shared by every target. The same bits in any block and on any rank need -ffp-contract=off and no fast-math.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR})
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release)
endif()
set(CMAKE_CXX_FLAGS_RELEASE "-O3")

option(BRISANCE_NATIVE "Compile for the processor of this machine" ON)
option(BRISANCE_WERROR "Treat warnings as errors" OFF)

add_library(brisance_flags INTERFACE)
target_compile_options(brisance_flags INTERFACE -fno-math-errno -ffp-contract=off -Wall -Wextra -Wconversion
                       $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>)  # GCC 12 raises it for std::string + (PR 105329)
target_compile_options(brisance_flags INTERFACE $<$<CXX_COMPILER_ID:Clang>:-Wno-sign-conversion>)  # not in GCC's -Wconversion
if(BRISANCE_NATIVE)
  target_compile_options(brisance_flags INTERFACE -march=native)
else()
  target_compile_options(brisance_flags INTERFACE -march=x86-64-v3)
endif()
if(BRISANCE_WERROR)
  target_compile_options(brisance_flags INTERFACE -Werror)
endif()
target_include_directories(brisance_flags INTERFACE ${PROJECT_SOURCE_DIR})

# brisance_layer(name SOURCES ... LINKS ...): one folder, one target; LINKS states what it may depend on.
function(brisance_layer name)
  cmake_parse_arguments(LAYER "" "" "SOURCES;LINKS" ${ARGN})
  add_library(brisance_${name} STATIC ${LAYER_SOURCES})
  target_link_libraries(brisance_${name} PUBLIC brisance_flags ${LAYER_LINKS})
  add_library(brisance::${name} ALIAS brisance_${name})
endfunction()
