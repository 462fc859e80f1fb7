# Fetches the page's libraries, or says what to do. Run as a script, with
#   NPM      npm
#   FOLDER   where package.json and package-lock.json are
execute_process(
  COMMAND "${NPM}" ci --omit=dev --ignore-scripts --no-audit --no-fund
  WORKING_DIRECTORY "${FOLDER}"
  RESULT_VARIABLE result
  OUTPUT_QUIET
  ERROR_VARIABLE wrong)
if (NOT result EQUAL 0)
  string(SUBSTRING "${wrong}" 0 300 wrong)
  message(FATAL_ERROR
    "npm cannot fetch the libraries of the page (it needs its registry, or its cache): ${wrong}\n"
    "Build without the target ReliefWebPage, or hide npm by -DNPM=NPM-NOTFOUND.")
endif ()
file(WRITE "${FOLDER}/installed" "")
