# A component that is not there says why, and stops nobody who did not require it.
function(component_is_missing component because)
  find_package(carom 0.1 QUIET CONFIG OPTIONAL_COMPONENTS ${component})
  if(NOT carom_FOUND OR carom_${component}_FOUND OR NOT TARGET carom::carom)
    message(FATAL_ERROR "without its component ${component}, which was optional, carom is not found")
  endif()
  find_package(carom 0.1 QUIET CONFIG COMPONENTS ${component})
  if(carom_FOUND OR NOT carom_NOT_FOUND_MESSAGE MATCHES "${because}")
    message(FATAL_ERROR "carom does not say that ${because}, but '${carom_NOT_FOUND_MESSAGE}'")
  endif()
endfunction()

component_is_missing(figures "no component figures")
unset(cairo_FOUND CACHE)  # of the last time that this project was configured
set(ENV{PKG_CONFIG_LIBDIR} ${CMAKE_CURRENT_BINARY_DIR})  # where it finds nothing
component_is_missing(lab "needs cairo and hdf5")
unset(ENV{PKG_CONFIG_LIBDIR})
