// SPDX-License-Identifier: BSD-3-Clause
//
// Tests of the page of Examples/Web in a headless browser.
//
//     node run.mjs TEST --page FOLDER --package FOLDER --browser FOLDER --chromium FILE --libraries FOLDER --output FOLDER
//       [--reliefshade FILE]

import { tests as controls } from './control-tests.mjs';
import { tests as files } from './file-tests.mjs';
import { browser, positionals, server } from './harness.mjs';
import { tests as pictures } from './picture-tests.mjs';
import { tests as sources } from './source-tests.mjs';

const tests = { ...controls, ...files, ...pictures, ...sources };
let failed = false;
try
{
  const late = new Promise((_, fail) =>
  {
    setTimeout(() => fail(new Error('the page takes too long')), 280000).unref();
  });
  await Promise.race([tests[positionals[0]](), late]);
}
catch (error)
{
  console.error(error);
  failed = true;
}
await browser.close();
server.close();
process.exit(failed ? 1 : 0);
