// SPDX-License-Identifier: BSD-3-Clause
//
// Tests of the WebGL host in a headless browser.
//
//     node run.mjs TEST --modules FOLDER --package FOLDER --data FOLDER --browser FOLDER --chromium FILE

import assert from 'node:assert/strict';
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import { parseArgs } from 'node:util';

import { launch, openPage, serve } from './browser.mjs';

// Runs a function of in_page.js, which returns what is wrong.
function inPage(name)
{
  return async (page) =>
  {
    const wrong = await page.evaluate(async (f) => (await import('/tests/in_page.js'))[f](), name);
    assert.deepEqual(wrong, []);
  };
}

const tests = {
  // 99.9 % of the samples of each scene are what the filter makes of them.
  async Agreement(page)
  {
    const results = await page.evaluate(async () => (await import('/tests/in_page.js')).agreement());
    for (const result of results)
    {
      console.log(`${result.name}: ${result.wrong} of ${result.samples} differ, at most by ` +
        `${result.worst.toPrecision(2)}; ${result.milliseconds.toFixed(0)} ms`);
    }
    for (const result of results)
    {
      assert.ok(result.wrong <= 1e-3 * result.samples, `${result.name} does not agree`);
      assert.equal(result.alpha, 0, `${result.name} has other holes`);
      assert.ok(result.converged && result.detail === 1, `${result.name} has not converged`);
      assert.ok(!result.picture || result.picture.worst === 0, `${result.name} is shown otherwise`);
    }
    assert.ok(results.length >= 20);
  },
  Numbers: inPage('numbers'),
  Context: inPage('context'),
  KeptWork: inPage('keptWork'),
  Errors: inPage('errors'),
  Progress: inPage('progress'),
};

const { values, positionals } = parseArgs({
  allowPositionals: true,
  options: {
    modules: { type: 'string' }, package: { type: 'string' }, data: { type: 'string' }, browser: { type: 'string' },
    chromium: { type: 'string' },
  },
});
const browser = await launch(values.browser, values.chromium);
const folder = path.dirname(fileURLToPath(import.meta.url));
const server = await serve({ modules: values.modules, package: values.package, data: values.data, tests: folder });
let failed = false;
try
{
  const { page, complaints } = await openPage(browser, server.url);
  const late = new Promise((_, fail) =>
  {
    setTimeout(() => fail(new Error('the page takes too long')), 240000).unref();
  });
  await Promise.race([tests[positionals[0]](page), late]);
  assert.deepEqual(complaints, [], 'the page complains');
}
catch (error)
{
  console.error(error);
  failed = true;
}
await browser.close();
server.close();
process.exit(failed ? 1 : 0);
