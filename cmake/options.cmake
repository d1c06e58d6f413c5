# How every Carom target is built, and where its libraries come from.
if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release)
endif()

set(least_GNU 12)
set(least_Clang 14)
if(CMAKE_CXX_COMPILER_VERSION VERSION_LESS "${least_${CMAKE_CXX_COMPILER_ID}}")
  message(FATAL_ERROR "Carom needs g++ 12 or clang++ 14, or a later one; ${CMAKE_CXX_COMPILER} is "
                      "${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION}.")
endif()

function(carom_options target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF POSITION_INDEPENDENT_CODE ON)
  # The same bits everywhere: no fused multiply-add, neither by contraction nor by the SLP vectoriser (g++ 12 fuses
  # there in spite of -ffp-contract=off when the target has FMA). sqrt becomes an instruction.
  # A function of ours is the one that is called, whatever a program that is linked with us defines (as clang++ has it):
  # else code that may become part of a shared library inlines no function that others might see.
  target_compile_options(${target} PRIVATE -ffp-contract=off -fno-math-errno
    $<$<CXX_COMPILER_ID:GNU>:-fno-tree-slp-vectorize> $<$<CXX_COMPILER_ID:GNU>:-fno-semantic-interposition>
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
    # g++ 12 warns falsely of std::string's own memcpy (GCC bug 105651).
    $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict> $<$<BOOL:${CAROM_WERROR}>:-Werror>)
  if(EMSCRIPTEN)
    # Without it no Error can be caught. Both sides must agree, so the user's does it too.
    target_compile_options(${target} PUBLIC -fwasm-exceptions)
    target_link_options(${target} PUBLIC -fwasm-exceptions)
  endif()
endfunction()

# Files named *_avx2.cpp and *_avx512.cpp hold kernels for processors that have these instructions: src/simd/isa.hpp.
# None of them may fuse, which -ffp-contract=off above sees to; -mavx2 does not even bring in FMA.
function(carom_kernels target)
  if(EMSCRIPTEN)
    target_compile_options(${target} PRIVATE -msimd128)
  elseif(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
    target_compile_definitions(${target} PRIVATE CAROM_X86_KERNELS)
    file(GLOB avx2 src/*/*_avx2.cpp src/*/*/*_avx2.cpp)
    file(GLOB avx512 src/*/*_avx512.cpp src/*/*/*_avx512.cpp)
    set_source_files_properties(${avx2} PROPERTIES COMPILE_OPTIONS -mavx2)
    set_source_files_properties(${avx512} PROPERTIES COMPILE_OPTIONS "-mavx2;-mavx512f;-mprefer-vector-width=512")
  endif()
endfunction()

# With CAROM_UNITY up to sixteen files of a folder are one file to the compiler: headers are most of a file's time, but a
# large folder as one file is what all wait for. Files with options of their own stay alone (CMake sees to that), and so
# do the kernels, which are one text compiled three times.
function(carom_unity target)
  if(NOT CAROM_UNITY)
    return()
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  get_target_property(sources ${target} SOURCES)
  list(FILTER sources EXCLUDE REGEX "_(baseline|avx2|avx512)\\.cpp$")
  foreach(source IN LISTS sources)
    get_filename_component(folder ${source} DIRECTORY)
    file(RELATIVE_PATH folder ${PROJECT_SOURCE_DIR}/src ${folder})
    string(REPLACE "/" "_" group ${folder})
    math(EXPR part "${files_of_${group}} + 0")  # none yet is nothing
    math(EXPR files_of_${group} "${part} + 1")
    math(EXPR part "${part} / 16")
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${group}_${part})
  endforeach()
  # A local name hides one of another file, and what is in an anonymous namespace looks as if it were in a header: no
  # faults. Of the true ones the release build warns, whose files are alone.
  target_compile_options(${target} PRIVATE -Wno-shadow $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
endfunction()

# What nearly every file of a target reads takes a second of each, and so is read once. Kernels and files with options of
# their own read what they need themselves; a folder that is one file needs none of it.
function(carom_precompiled target)
  if(CAROM_UNITY)
    return()
  endif()
  target_precompile_headers(${target} PRIVATE ${ARGN})
  # ccache knows a precompiled header by its text, not by its time.
  target_compile_options(${target} PRIVATE
                         $<IF:$<CXX_COMPILER_ID:GNU>,-fpch-preprocess,SHELL:-Xclang -fno-pch-timestamp>)
  get_target_property(sources ${target} SOURCES)
  foreach(source IN LISTS sources)
    get_source_file_property(options ${source} COMPILE_OPTIONS)
    get_source_file_property(definitions ${source} COMPILE_DEFINITIONS)
    if(options OR definitions OR source MATCHES "_(baseline|avx2|avx512)\\.cpp$")
      set_source_files_properties(${source} PROPERTIES SKIP_PRECOMPILE_HEADERS ON)
    endif()
  endforeach()
endfunction()

# The libraries tell a fuzzer where its inputs lead them; the tests, which ask nobody, run faster without.
function(carom_fuzzed target)
  if(CAROM_FUZZ)
    target_compile_options(${target} PRIVATE -fsanitize=fuzzer-no-link)
  endif()
endfunction()

# Header-only libraries, needed to build Carom and not to use it. As headers fmt costs three seconds a file: of the version
# that src/text/fmt.cpp knows its code is compiled there, once.
if(EMSCRIPTEN)
  # The system's headers, one by one: all of /usr/include would bring in glibc's.
  set(CAROM_HEADERS /usr/include CACHE PATH "For WebAssembly: the folder in which fmt and eigen3/Eigen lie")
  file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/headers)
  foreach(library fmt eigen3/Eigen)
    if(NOT EXISTS ${CAROM_HEADERS}/${library})
      message(FATAL_ERROR "There is no ${CAROM_HEADERS}/${library}: set CAROM_HEADERS to a folder with fmt and "
                          "eigen3/Eigen.")
    endif()
    get_filename_component(name ${library} NAME)
    file(CREATE_LINK ${CAROM_HEADERS}/${library} ${CMAKE_BINARY_DIR}/headers/${name} SYMBOLIC)
  endforeach()
  file(STRINGS ${CAROM_HEADERS}/fmt/core.h fmt_VERSION REGEX "define FMT_VERSION 901..$")
else()
  find_package(fmt REQUIRED)
endif()
string(REGEX MATCH "901..$|^9\\.1\\." carom_fmt_compiled "${fmt_VERSION}")

# What is compiled of them goes by a name of our own (rules/foreign). A user's program may have the same library,
# compiled with options of its own: under one name the linker takes one of the two for both, and our bits are others.
set(carom_Eigen3 Eigen3::Eigen)
set(carom_nlohmann_json nlohmann_json::nlohmann_json)
set(carom_namespace_fmt fmt)
set(carom_namespace_Eigen3 Eigen)
set(carom_namespace_nlohmann_json nlohmann)
function(carom_headers_only target)
  foreach(library IN LISTS ARGN)
    set(namespace ${carom_namespace_${library}})
    target_compile_definitions(${target} PRIVATE ${namespace}=carom_${namespace})
    if(library STREQUAL "fmt" AND NOT carom_fmt_compiled)
      target_compile_definitions(${target} PRIVATE FMT_HEADER_ONLY=1)
    endif()
    if(EMSCRIPTEN)
      target_include_directories(${target} SYSTEM PRIVATE ${CMAKE_BINARY_DIR}/headers)
    elseif(library STREQUAL "fmt")
      get_target_property(headers fmt::fmt-header-only INTERFACE_INCLUDE_DIRECTORIES)
      target_include_directories(${target} SYSTEM PRIVATE ${headers})
    else()
      find_package(${library} REQUIRED)
      target_link_libraries(${target} PRIVATE $<BUILD_INTERFACE:${carom_${library}}>)
    endif()
  endforeach()
endfunction()

# What the laboratory links: frames (Cairo), data (HDF5).
function(carom_lab_libraries target)
  find_package(PkgConfig REQUIRED)
  pkg_check_modules(cairo REQUIRED IMPORTED_TARGET cairo)
  pkg_check_modules(hdf5 REQUIRED IMPORTED_TARGET hdf5)
  target_link_libraries(${target} PRIVATE PkgConfig::cairo PkgConfig::hdf5)
endfunction()
