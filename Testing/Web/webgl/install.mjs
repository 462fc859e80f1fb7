// SPDX-License-Identifier: BSD-3-Clause
//
// Puts playwright-core, which drives the browser, and TypeScript into a folder of the build.
//
//     node install.mjs FOLDER NPM

import { spawnSync } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';

import { giveUp } from './browser.mjs';

// Of those that run in Node.js 18, which Debian 12 has.
const VERSIONS = { 'playwright-core': '1.60.0', typescript: '5.9.3' };
const [folder, npm] = process.argv.slice(2);
if (!npm || !fs.existsSync(npm))
{
  giveUp('npm was not found');
}
const isThere = ([name, version]) =>
{
  const file = path.join(folder, 'node_modules', name, 'package.json');
  return fs.existsSync(file) && JSON.parse(fs.readFileSync(file, 'utf8')).version === version;
};
const wanted = Object.entries(VERSIONS);
const names = wanted.map((one) => one.join('@'));
if (wanted.every(isThere))
{
  console.log(`${names.join(' and ')} are there`);
  process.exit(0);
}
fs.mkdirSync(folder, { recursive: true });
fs.writeFileSync(path.join(folder, 'package.json'), '{ "private": true }\n');
const result = spawnSync(npm,
  ['install', '--no-audit', '--no-fund', '--ignore-scripts', '--prefix', folder, ...names], { encoding: 'utf8' });
if (result.status !== 0)
{
  giveUp(`${names.join(' and ')} could not be fetched: ${result.stderr.slice(0, 200)}`);
}
console.log(`${names.join(' and ')} are in ${folder}`);
