# Fails, or is skipped where somebody has said that tests in a browser are optional.
if (DEFINED ENV{RELIEF_WEB_OPTIONAL})
  message(STATUS "skipped: node was not found")
else ()
  message(FATAL_ERROR "node was not found; set RELIEF_WEB_OPTIONAL to skip the tests in a browser")
endif ()
