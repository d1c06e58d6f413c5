# Writes a header that says which sources these are, if git knows; only when that has changed.
cmake_minimum_required(VERSION 3.22)
find_package(Git QUIET)
set(sources "")
if(GIT_FOUND)
  execute_process(COMMAND ${GIT_EXECUTABLE} describe --always --dirty --tags WORKING_DIRECTORY ${SOURCE}
                  OUTPUT_VARIABLE sources OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
endif()
file(CONFIGURE OUTPUT ${HEADER} CONTENT "#pragma once\n#define CAROM_SOURCES \"@sources@\"\n" @ONLY)
