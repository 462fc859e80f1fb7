// SPDX-License-Identifier: BSD-3-Clause
//
// How long a field of 512 x 512 takes in a headless browser whose graphics processor is software. No test:
//
//     node measure.mjs --modules FOLDER --package FOLDER --browser FOLDER --chromium FILE

import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import { parseArgs } from 'node:util';

import { launch, openPage, serve } from './browser.mjs';

const { values } = parseArgs({
  options: Object.fromEntries(
    ['modules', 'package', 'browser', 'chromium'].map((name) => [name, { type: 'string' }])),
});
const SIZE = 512;

// Hills of all sizes.
function makeHeights()
{
  const heights = new Float32Array(SIZE * SIZE);
  for (let j = 0; j < SIZE; ++j)
  {
    for (let i = 0; i < SIZE; ++i)
    {
      for (let octave = 0, a = 40, f = 0.01; octave < 6; ++octave, a /= 2, f *= 2)
      {
        heights[j * SIZE + i] += a * Math.sin(i * f + 1.3 * octave + 2 * Math.sin(j * f * 0.7 + octave)) *
          Math.cos(j * f * 1.1 - octave);
      }
    }
  }
  return heights;
}

const data = fs.mkdtempSync(path.join(os.tmpdir(), 'relief-measure-'));
fs.writeFileSync(path.join(data, 'heights.raw'), makeHeights());
const browser = await launch(values.browser, values.chromium);
const server = await serve({
  modules: values.modules, package: values.package, data, tests: path.dirname(fileURLToPath(import.meta.url)),
});
// The browser is warm, as it is when somebody opens a page.
await openPage(browser, server.url);
const { page, complaints } = await openPage(browser, `${server.url}tests/measure.html`);
await page.waitForFunction('window.found', null, { timeout: 120000 });
const found = await page.evaluate('window.found');
for (const [name, value] of Object.entries(found))
{
  console.log(`${name}: ${value.toPrecision(4)}`);
}
console.log(`load: ${os.loadavg()[0].toFixed(1)} on ${os.cpus().length} processors`, ...complaints);
await browser.close();
server.close();
fs.rmSync(data, { recursive: true });
