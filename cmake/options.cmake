# Flags that every Carom target is built with, and where its libraries come from.
if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release)
endif()

function(carom_options target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF POSITION_INDEPENDENT_CODE ON)
  # The same bits everywhere: no fused multiply-add, neither by contraction nor by the SLP vectoriser (g++ 12 fuses
  # there in spite of -ffp-contract=off when the target has FMA).
  target_compile_options(${target} PRIVATE -ffp-contract=off -fno-math-errno
    $<$<CXX_COMPILER_ID:GNU>:-fno-tree-slp-vectorize>
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
    # g++ 12 warns falsely of std::string's own memcpy (GCC bug 105651).
    $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict> $<$<BOOL:${CAROM_WERROR}>:-Werror>)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O3>)
endfunction()

# Header-only libraries, needed to build Carom and not to use it.
function(carom_headers_only target)
  foreach(library IN LISTS ARGN)
    if(EMSCRIPTEN)
      # Debian's headers, one by one: all of /usr/include would bring in glibc's.
      set(root ${CMAKE_BINARY_DIR}/headers)
      file(MAKE_DIRECTORY ${root})
      set(from_fmt fmt)
      set(from_Eigen3 eigen3/Eigen)
      set(from_nlohmann_json nlohmann)
      get_filename_component(name ${from_${library}} NAME)
      file(CREATE_LINK /usr/include/${from_${library}} ${root}/${name} SYMBOLIC)
      target_include_directories(${target} SYSTEM PRIVATE ${root})
      target_compile_definitions(${target} PRIVATE FMT_HEADER_ONLY=1)
    else()
      set(target_of_fmt fmt::fmt-header-only)
      set(target_of_Eigen3 Eigen3::Eigen)
      set(target_of_nlohmann_json nlohmann_json::nlohmann_json)
      find_package(${library} REQUIRED)
      target_link_libraries(${target} PRIVATE $<BUILD_INTERFACE:${target_of_${library}}>)
    endif()
  endforeach()
endfunction()

# What the laboratory links: frames (Cairo, MPL).
function(carom_lab_libraries target)
  if(NOT EMSCRIPTEN)
    find_package(PkgConfig REQUIRED)
    pkg_check_modules(cairo REQUIRED IMPORTED_TARGET cairo)
    target_link_libraries(${target} PRIVATE PkgConfig::cairo)
  endif()
endfunction()
