# Run at every build: writes OUTPUT from TEMPLATE where the version or the commit has changed.
execute_process(COMMAND git describe --always --dirty --exclude * --abbrev=9 WORKING_DIRECTORY ${SOURCE}
                OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE status)
set(GSP_VERSION_STRING ${VERSION})
if(status EQUAL 0)
  string(APPEND GSP_VERSION_STRING "+${commit}")
endif()
configure_file(${TEMPLATE} ${OUTPUT} @ONLY)
