// SPDX-License-Identifier: BSD-3-Clause
//
// The parameters of scene.js are those of the table, with its defaults and ranges.
//
//     node parameters.mjs --data FOLDER --modules FOLDER

import assert from 'node:assert/strict';
import fs from 'node:fs';
import path from 'node:path';
import { pathToFileURL } from 'node:url';
import { parseArgs } from 'node:util';

const { values } = parseArgs({ options: { data: { type: 'string' }, modules: { type: 'string' } } });
// As a page finds it: modules by their suffix, without a package's say.
fs.writeFileSync(path.join(values.modules, 'package.json'), '{ "type": "module" }\n');
const { TABLES } = await import(new URL('scene.js', pathToFileURL(`${path.resolve(values.modules)}/`)));
const rows = JSON.parse(fs.readFileSync(path.join(values.data, 'parameters.json'), 'utf8'));

const infinite = (value, otherwise) => value ?? otherwise;
let compared = 0;
for (const row of rows.filter(({ owner }) => owner in TABLES))
{
  const here = TABLES[row.owner][row.key];
  const name = `${row.owner}.${row.key}`;
  assert.ok(here, `${name} is missing in scene.js`);
  assert.equal(here.kind, row.kind, name);
  if (row.kind === 'choice')
  {
    assert.deepEqual(here.names, row.choices, name);
    assert.equal(here.names[here.usual], row.default, name);
  }
  else
  {
    assert.deepEqual(here.usual, row.default, name);
  }
  if (['number', 'count'].includes(row.kind))
  {
    assert.equal(here.least, infinite(row.minimum, -Infinity), name);
    assert.equal(here.most, infinite(row.maximum, Infinity), name);
  }
  if (row.kind === 'color')
  {
    assert.equal(here.least, infinite(row.minimum, -Infinity), name);
  }
  ++compared;
}
const known = Object.values(TABLES).reduce((sum, table) => sum + Object.keys(table).length, 0);
assert.equal(known, compared, 'scene.js knows parameters that the table does not');
console.log(`${compared} parameters are the table's`);
