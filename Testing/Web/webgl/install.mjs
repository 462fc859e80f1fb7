// SPDX-License-Identifier: BSD-3-Clause
//
// Puts playwright-core, which drives the browser, into a folder of the build.
//
//     node install.mjs FOLDER NPM

import { spawnSync } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';

import { giveUp } from './browser.mjs';

// Of those that run in Node.js 18, which Debian 12 has.
const VERSION = '1.60.0';
const [folder, npm] = process.argv.slice(2);
if (!npm || !fs.existsSync(npm))
{
  giveUp('npm was not found');
}
const installed = path.join(folder, 'node_modules', 'playwright-core', 'package.json');
if (fs.existsSync(installed) && JSON.parse(fs.readFileSync(installed, 'utf8')).version === VERSION)
{
  console.log('playwright-core is there');
  process.exit(0);
}
fs.mkdirSync(folder, { recursive: true });
fs.writeFileSync(path.join(folder, 'package.json'), '{ "private": true }\n');
const result = spawnSync(npm,
  ['install', '--no-audit', '--no-fund', '--ignore-scripts', '--prefix', folder, `playwright-core@${VERSION}`],
  { encoding: 'utf8' });
if (result.status !== 0)
{
  giveUp(`playwright-core could not be fetched: ${result.stderr.slice(0, 200)}`);
}
console.log(`playwright-core ${VERSION} is in ${folder}`);
