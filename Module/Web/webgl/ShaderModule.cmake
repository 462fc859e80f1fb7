# Writes the texts of the shading programs as one ES module, unchanged. Run as a script, with
#   TEXTS    their files, separated by |
#   OUTPUT   the module to write
set(module "// SPDX-License-Identifier: BSD-3-Clause\n")
string(APPEND module "// Made from the texts in Module/Model and Module/Shaders by ShaderModule.cmake.\n")
string(APPEND module "export const texts = {\n")
string(REPLACE "|" ";" files "${TEXTS}")
foreach (file IN LISTS files)
  get_filename_component(name "${file}" NAME_WE)
  file(READ "${file}" text)
  # What means something in a template string.
  string(REPLACE "\\" "\\\\" text "${text}")
  string(REPLACE "`" "\\`" text "${text}")
  string(REPLACE "\${" "\\\${" text "${text}")
  string(APPEND module "${name}: `${text}`,\n")
endforeach ()
string(APPEND module "};\n")
file(WRITE "${OUTPUT}" "${module}")
