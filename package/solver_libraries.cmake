# Imported targets for libraries that have no CMake package of their own in Debian. The build includes it, and the
# installed gspConfig.cmake of a static gsp, so that no path of this machine stands in the package.
function(gsp_import_library NAME)
  if(TARGET gsp_import::${NAME})
    return()
  endif()
  find_library(GSP_${NAME}_LIBRARY ${NAME} REQUIRED)
  add_library(gsp_import::${NAME} UNKNOWN IMPORTED GLOBAL)
  set_target_properties(gsp_import::${NAME} PROPERTIES IMPORTED_LOCATION ${GSP_${NAME}_LIBRARY})
endfunction()
