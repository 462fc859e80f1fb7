// SPDX-License-Identifier: BSD-3-Clause
//
// The programs of the browser are those of the desktop, text by text, and all of these are GLSL ES 3.00.
//
//     node programs.mjs --programs FILE --modules FOLDER --output FOLDER [--validator FILE]
//
// FILE is what reliefWritePrograms has written; without glslangValidator the texts are compared only.

import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';
import { pathToFileURL } from 'node:url';
import { parseArgs } from 'node:util';

const { values } = parseArgs({
  options: {
    programs: { type: 'string' }, modules: { type: 'string' }, output: { type: 'string' },
    validator: { type: 'string' },
  },
});
const folder = pathToFileURL(`${path.resolve(values.modules)}/`);
// As a page finds it: modules by their suffix, without a package's say.
fs.writeFileSync(path.join(values.modules, 'package.json'), '{ "type": "module" }\n');
const {
  composeText, displayText, gatherText, probeText, selectLines, sumText, traceText, webProgram,
} = await import(new URL('programs.js', folder));

const HEADER = '//VTK::System::Dec\n//VTK::Output::Dec\n';

function textOf(program)
{
  switch (program.kind)
  {
    case 'trace':
      return traceText(program.light);
    case 'gather':
      return gatherText(program.light, program.sums, program.lights);
    default:
      return composeText({ ...program.compose, sums: program.sums });
  }
}

assert.throws(() => selectLines('//RELIEF::If A\n', new Set()), /End is missing/);
assert.throws(() => selectLines('//RELIEF::Else\n', new Set()), /Else/);
assert.equal(selectLines('a\n//RELIEF::If A\nb\n//RELIEF::Else\nc\n//RELIEF::End\n', new Set(['A'])), 'a\nb\n');

const programs = JSON.parse(fs.readFileSync(values.programs, 'utf8'));
const texts = new Set([displayText(), probeText(), sumText()].map((text) => webProgram(text)));
texts.add(webProgram(probeText(), { nanByBits: true }));
texts.add(webProgram(traceText({}), { nanByBits: true }));
let compared = 0;
for (const program of programs)
{
  assert.ok(program.text.startsWith(HEADER));
  const text = program.text.slice(HEADER.length);
  // Fields larger than a texture are refused in browsers, but their programs are to stay GLSL ES.
  if (!program.tiled)
  {
    assert.equal(textOf(program), text, `${JSON.stringify({ ...program, text: 0 })} differs`);
    ++compared;
  }
  texts.add(webProgram(text));
}
assert.ok(compared > 100);
console.log(`${compared} programs are the desktop's; ${texts.size} texts are different from one another`);

if (values.validator)
{
  fs.rmSync(values.output, { recursive: true, force: true });
  fs.mkdirSync(values.output, { recursive: true });
  const files = [...texts].map((text, k) =>
  {
    const file = path.join(values.output, `${k}.frag`);
    fs.writeFileSync(file, text);
    return file;
  });
  for (let k = 0; k < files.length; k += 100)
  {
    const result = spawnSync(values.validator, files.slice(k, k + 100), { encoding: 'utf8' });
    assert.equal(result.status, 0, result.stdout.split('\n').filter((l) => /ERROR/.test(l)).slice(0, 5).join('\n'));
    assert.ok(!/ERROR/.test(result.stdout));
  }
  console.log('and all are GLSL ES 3.00');
}
