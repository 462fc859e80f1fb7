# Makes the manual page OUTPUT of a program from what it says of itself with --help-all, so that the two
# cannot differ.
execute_process(COMMAND "${PROGRAM}" --help-all OUTPUT_VARIABLE help RESULT_VARIABLE result)
if (NOT result EQUAL 0)
  message(FATAL_ERROR "${PROGRAM} --help-all failed: ${result}")
endif ()
string(REGEX REPLACE "^Usage:[^\n]*\n+" "" help "${help}")
# The memory of the machine that builds is nobody's concern.
string(REGEX REPLACE "machine,[ \n]+[0-9]+" "machine" help "${help}")
string(REPLACE "\\" "\\e" help "${help}")
string(REPLACE "-" "\\-" help "${help}")
# A point or an apostrophe at a line's beginning would be a command.
string(REGEX REPLACE "\n([.'])" "\n\\\\&\\1" help "${help}")
file(WRITE "${OUTPUT}" ".TH RELIEFSHADE 1 \"\" \"reliefshade ${VERSION}\" \"ReliefShading\"
.SH NAME
reliefshade \\- shade a height field: light, soft shadows, translucency and highlights
.SH SYNOPSIS
.B reliefshade
.I INPUT OUTPUT
.RI [ OPTION ...]
.SH DESCRIPTION
.nf
${help}
.fi
.SH SEE ALSO
.BR reliefviewer (1),
.BR gdaldem (1)
")
